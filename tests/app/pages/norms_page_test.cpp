#include "app/pages/norms_page.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/model/friction_pairs.hpp"
#include "core/model/norms.hpp"

namespace norms_page_test {

using namespace holdfast::internal;

TEST_CASE("norms_page: docs/reference/norms.md is up to date", "[app][norms_page]") {
  std::ifstream file(HOLDFAST_SOURCE_DIR "/docs/reference/norms.md", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  INFO("docs/reference/norms.md differs from the tables; run: holdfast --norms-page > docs/reference/norms.md");
  CHECK((page == norms_page()));
}

TEST_CASE("norms_page: page and terminal have every norm and every pair", "[app][norms_page]") {
  const std::string page = norms_page(), help = norms_help();
  for (const Norm& norm : norms()) {
    INFO(norm.name);
    CHECK(page.find("| `" + std::string(norm.name)) != std::string::npos);
    CHECK(page.find(numbers_of(norm)) != std::string::npos);
    CHECK(help.find('\n' + std::string(norm.name)) != std::string::npos);
    CHECK(help.find(norm.source) != std::string::npos);
  }
  for (const FrictionPair& pair : friction_pairs()) {
    INFO(pair.name);
    CHECK(page.find("| `" + std::string(pair.name) + "` |") != std::string::npos);
    CHECK(help.find(std::string(pair.name) + '=') != std::string::npos);
  }
}

}  // namespace norms_page_test
