#include "core/model/container_catalogue.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "core/model/setting_table.hpp"

namespace container_catalogue_test {

using namespace holdfast::internal;

TEST_CASE("container_catalogue: names are found in every spelling, and mean one type", "[core][containers]") {
  for (const char* const spelling : {"40hc", "40HC", "40' HC", "40-hq", "45G1", "40 High Cube"})
    CHECK(find_container(spelling)->name == "40hc");
  CHECK(find_container("Euro pallet")->name == "pallet-1200x800");
  for (const char* const none : {"", "-", "39", "40hx"}) CHECK(find_container(none) == nullptr);
  for (const ContainerType& type : container_catalogue()) {
    INFO(type.name);
    CHECK(find_container(type.name) == &type);
    std::string aliases(type.aliases);
    for (std::size_t begin = 0; begin < aliases.size();) {
      const std::size_t end = std::min(aliases.find(' ', begin), aliases.size());
      CHECK(find_container(aliases.substr(begin, end - begin)) == &type);
      begin = end + 1;
    }
    CHECK(type.payload > 1000);
    CHECK_FALSE(type.source.empty());
  }
}

TEST_CASE("container_catalogue: a type gives what the keys beside it do not", "[core][containers]") {
  Settings settings;
  REQUIRE(find_setting("Container", "Type")->set(settings, "", "tautliner"));
  settings.container.size.z() = 3.0;
  settings.container.open_sides = {"rear"};
  std::set<std::string_view> given = {"Height"};
  const auto is_given = [&](std::string_view, std::string_view key) { return given.contains(key); };
  apply_container_type(settings, is_given);
  CHECK(settings.container.type == "trailer-curtain");
  CHECK(settings.container.size == Vec3(13.6, 2.48, 3.0));
  CHECK(settings.container.open_sides == std::vector<std::string>{"left", "right"});

  // A side that is low is not open, and the others are.
  given.insert("DropSides");
  settings.container.drop_sides = {{"left", 0.6}};
  apply_container_type(settings, is_given);
  CHECK(settings.container.open_sides == std::vector<std::string>{"right"});
}

}  // namespace container_catalogue_test
