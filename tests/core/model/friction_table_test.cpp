#include "core/model/friction_table.hpp"

#include <catch2/catch.hpp>

#include "core/model/contact_law.hpp"
#include "core/model/setting_table.hpp"

namespace friction_table_test {

using namespace holdfast::internal;

namespace {

Settings with_pairs(std::initializer_list<std::pair<const char*, const char*>> rows) {
  Settings settings;
  for (const auto& [pair, value] : rows) {
    const auto placed = place_setting("Friction", pair);
    REQUIRE(placed);
    REQUIRE(placed->key->set(settings, placed->of, value));
  }
  const auto given = [&](std::string_view section, std::string_view key) {
    for (const auto& row : rows)
      if (section == "Friction" && place_setting("Friction", row.first)->name == key) return true;
    return false;
  };
  REQUIRE(choose_friction_model(settings, given).empty());
  return settings;
}

double between(const Settings& settings, std::string_view below, std::string_view above) {
  const FrictionTable& table = settings.contact.materials;
  const auto surface = [&](std::string_view name) {
    if (name == "floor") return Surface{.kind = SurfaceKind::floor};
    if (name == "wall") return Surface{.kind = SurfaceKind::wall};
    return Surface{.kind = SurfaceKind::box, .material = table.index_of(name)};
  };
  return friction_of_pair(settings.contact, surface(below), surface(above), 1.0);
}

}  // namespace

TEST_CASE("friction_table: names in any order, the more general one second", "[core][friction_table]") {
  CHECK(parse_partners(" pallet ,carton")->text() == "carton, pallet");
  CHECK(parse_partners("floor, 3")->text() == "3, floor");
  CHECK(parse_partners("any, zinc")->text() == "zinc, any");
  CHECK(parse_partners("wall, any")->text() == "any, wall");
  CHECK(parse_partners("any, any")->text() == "any, any");
  for (const char* const wrong : {"", "carton", "carton,", ", carton", "a, b, c", "floor, wall", "floor, floor"})
    CHECK_FALSE(parse_partners(wrong));
}

TEST_CASE("friction_table: the most specific row holds", "[core][friction_table]") {
  const Settings settings = with_pairs({{"any, any", "0.1"},
                                        {"any, floor", "0.2"},
                                        {"carton, any", "0.3"},
                                        {"carton, floor", "0.4"},
                                        {"carton, pallet", "0.5"},
                                        {"steel, wall", "0.05"}});
  CHECK(settings.contact.friction_model == FrictionModel::pairs);
  CHECK(between(settings, "carton", "pallet") == 0.5);
  CHECK(between(settings, "pallet", "carton") == 0.5);
  CHECK(between(settings, "carton", "carton") == 0.3);
  CHECK(between(settings, "carton", "glass") == 0.3);
  CHECK(between(settings, "floor", "carton") == 0.4);
  CHECK(between(settings, "wall", "carton") == 0.3);
  CHECK(between(settings, "wall", "steel") == 0.05);
  CHECK(between(settings, "floor", "steel") == 0.2);
  CHECK(between(settings, "pallet", "glass") == 0.1);
  // What is said of any two holds for walls, of which nothing is said.
  CHECK(between(settings, "wall", "pallet") == 0.1);
}

TEST_CASE("friction_table: two rows of one rank that differ are a conflict", "[core][friction_table]") {
  const auto conflicts = check_settings(with_pairs({{"carton, any", "0.3"}, {"steel, any", "0.2"}}));
  REQUIRE(conflicts.size() == 1);
  CHECK(conflicts[0].error.accepted == "give that of `carton, steel`");
  CHECK(check_settings(with_pairs({{"carton, any", "0.3"}, {"steel, any", "0.3"}})).empty());
  CHECK(check_settings(with_pairs({{"carton, any", "0.3"}, {"steel, any", "0.2"}, {"steel, carton", "0.2"}})).empty());
}

TEST_CASE("friction_table: a mat acts where its box stands on another body", "[core][friction_table]") {
  Settings settings = with_pairs({{"any, any", "0.2"}});
  settings.contact.friction_model = GENERATE(FrictionModel::product, FrictionModel::pairs);
  settings.contact.mat_factor = 0.5;
  const Surface floor{.kind = SurfaceKind::floor, .friction = 1.0};
  const Surface plain{.friction = 0.2};
  const Surface on_mat{.friction = 0.2, .mat = 0.6};
  const auto product = [&](double factors) {
    return settings.contact.friction_model == FrictionModel::product ? factors : 0.2;
  };
  CHECK(friction_of_pair(settings.contact, floor, on_mat, 1.0) == 0.3);
  CHECK(friction_of_pair(settings.contact, plain, on_mat, 0.8) == 0.3);
  CHECK(friction_of_pair(settings.contact, on_mat, plain, -0.8) == 0.3);
  // Beneath another box, and beside one, it has no effect.
  CHECK(friction_of_pair(settings.contact, on_mat, plain, 1.0) == product(0.2 * 0.2));
  CHECK(friction_of_pair(settings.contact, on_mat, plain, 0.5) == product(0.2 * 0.2));
}

}  // namespace friction_table_test
