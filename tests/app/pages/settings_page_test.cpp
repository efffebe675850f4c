#include "app/pages/settings_page.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/pages/accuracy_defaults.hpp"
#include "core/model/setting_table.hpp"

namespace settings_page_test {

using namespace holdfast::internal;

TEST_CASE("settings_page: docs/reference/config.md is up to date", "[app][settings_page]") {
  std::ifstream file(HOLDFAST_SOURCE_DIR "/docs/reference/config.md", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  INFO(
      "docs/reference/config.md differs from the table of keys; run: holdfast --config-page > "
      "docs/reference/config.md");
  CHECK((page == settings_page()));
}

TEST_CASE("settings_page: page and help have every key and section", "[app][settings_page]") {
  const std::string page = settings_page(), help = settings_help();
  for (const SettingKey& key : setting_table()) {
    INFO(key.section << " " << key.name);
    CHECK(page.find("## [" + std::string(key.section) + "]\n") != std::string::npos);
    const std::string name(key.name);
    // Keys without effect are in one line.
    CHECK(page.find(key.without_effect ? '`' + name + '`' : "| `" + name + "` |") != std::string::npos);
    CHECK(key.accepted.find('|') == std::string_view::npos);
    CHECK(key.sentence.find('|') == std::string_view::npos);
    CHECK(help.find("\n[" + std::string(key.section) + "]\n") != std::string::npos);
    CHECK(help.find(key.without_effect ? name : "\n  " + name) != std::string::npos);
  }
}

TEST_CASE("settings_page: help fits a terminal", "[app][settings_page]") {
  std::istringstream help(settings_help());
  for (std::string line; std::getline(help, line);) {
    INFO(line);
    CHECK(line.size() <= 100);
  }
}

}  // namespace settings_page_test
