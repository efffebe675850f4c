#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz/fuzz_targets.hpp"

namespace corpus_test {

namespace {

/// The seeds of a target, and what fuzzing once found, in the order of their names.
std::vector<std::string> corpus(const std::string& target) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(HOLDFAST_SOURCE_DIR "/tests/fuzz/corpus/" + target))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return texts;
}

/// Changes bytes, repeats, drops and mixes pieces: what libFuzzer does, without its eye for new paths.
std::string mutated(const std::vector<std::string>& texts, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count)(random); };
  const std::vector<std::string> words = {"-0", "1e308", "nan",          "1e999", "\n", "[",
                                          "=",  "#",     "\xEF\xBB\xBF", "\x80",  "\t"};
  std::string text = texts[below(texts.size() - 1)];
  for (std::size_t change = below(6); change > 0; --change) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(below(20), text.size() - at);
    const std::string& other = texts[below(texts.size() - 1)];
    switch (below(4)) {
      case 0:
        if (!text.empty()) text[std::min(at, text.size() - 1)] = static_cast<char>(below(255));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, words[below(words.size() - 1)]);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.replace(at, length, other.substr(std::min(at, other.size()), 40));
    }
  }
  return text;
}

void check_target(const std::string& target, void (*read)(std::string_view)) {
  const std::vector<std::string> texts = corpus(target);
  REQUIRE(texts.size() >= 5);
  for (const std::string& text : texts) CHECK_NOTHROW(read(text));
  std::mt19937 random(2024);
  for (int i = 0; i < 3000; ++i) {
    const std::string text = mutated(texts, random);
    CAPTURE(text);
    REQUIRE_NOTHROW(read(text));
  }
}

}  // namespace

TEST_CASE("fuzz: layouts are read or refused, the corpus and what becomes of it", "[fuzz]") {
  check_target("layout", fuzz::read_layout);
}

TEST_CASE("fuzz: tables are read or refused, the corpus and what becomes of it", "[fuzz]") {
  check_target("table", fuzz::read_load_file);
}

TEST_CASE("fuzz: JSON of loads is read or refused, the corpus and what becomes of it", "[fuzz]") {
  check_target("json", fuzz::read_load_file);
}

TEST_CASE("fuzz: accelerations are read or refused, the corpus and what becomes of it", "[fuzz]") {
  check_target("acceleration", fuzz::read_acceleration);
}

TEST_CASE("fuzz: configs are read or refused, the corpus and what becomes of it", "[fuzz]") {
  check_target("config", fuzz::read_config);
}

TEST_CASE("fuzz: requests are read or refused, the corpus and what becomes of it", "[fuzz]") {
  check_target("request", fuzz::read_requests);
}

}  // namespace corpus_test
