#include "io/results/run_description.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "io/input/text_file.hpp"

namespace holdfast::internal {

namespace {

/// Each text is preceded by its length, so that different lists of texts give different bytes.
void append(std::string& bytes, const std::string& text) { bytes += std::to_string(text.size()) + ':' + text; }

/// Settings that affect how a run is executed and where it is stored, but not its results: they may differ in a resume.
constexpr std::array<std::string_view, 3> kWithoutInfluence = {"Screening/Threads", "Screening/Scheduler",
                                                               "Export Settings/SavePath"};

bool has_influence(const std::string& key) {
  return std::find(kWithoutInfluence.begin(), kWithoutInfluence.end(), key) == kWithoutInfluence.end();
}

}  // namespace

std::string fingerprint(const RunDescription& run) {
  std::string settings;
  for (const auto& [key, value] : run.settings) {
    if (!has_influence(key)) continue;
    append(settings, key);
    append(settings, value);
  }
  std::string layouts;
  for (const std::string& name : run.layout_names) append(layouts, name);
  std::string accelerations;
  for (const Acceleration& acceleration : run.accelerations) {
    append(accelerations, acceleration.name);
    append(accelerations, acceleration.sha256);
  }
  std::string software;
  append(software, run.software);
  append(software, run.git_commit);
  return "software=" + sha256_of(software) + " settings=" + sha256_of(settings) + " engine=" + run.engine +
         " layouts=" + sha256_of(layouts) + " accelerations=" + sha256_of(accelerations) +
         " series=" + (run.record_series ? "1" : "0");
}

std::string fingerprint_with_contents(const RunDescription& run) {
  std::string contents;
  for (const std::string& hash : run.layout_hashes) append(contents, hash);
  return fingerprint(run) + " layout_contents=" + sha256_of(contents);
}

std::string fingerprint_difference(const std::string& a, const std::string& b) {
  std::istringstream a_words(a);
  std::istringstream b_words(b);
  std::string difference;
  std::string a_word;
  std::string b_word;
  while ((a_words >> a_word) && (b_words >> b_word)) {
    if (a_word == b_word) continue;
    difference += (difference.empty() ? "" : ", ") + a_word.substr(0, a_word.find('='));
  }
  if (difference.empty() && a != b) difference = "fingerprint";
  return difference;
}

}  // namespace holdfast::internal
