#include "app/pages/results_page.hpp"

#include "core/model/outcome.hpp"
#include "io/results/results_fixture.hpp"

namespace results_page_test {

using namespace results_fixture;

TEST_CASE("results_page: docs/reference/results_file.md is up to date", "[io][results]") {
  INFO("regenerate it: holdfast --results-page > docs/reference/results_file.md");
  const bool up_to_date = file_bytes(HOLDFAST_SOURCE_DIR "/docs/reference/results_file.md") == results_page();
  CHECK(up_to_date);
}

TEST_CASE("results_page: names every status bit", "[io][results]") {
  for (std::uint32_t bit = 1; to_string(static_cast<Status>(bit)) != "ok"; bit <<= 1U)
    CHECK(results_page().find("`" + to_string(static_cast<Status>(bit)) + "`") != std::string::npos);
}

}  // namespace results_page_test
