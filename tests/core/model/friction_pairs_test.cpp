#include "core/model/friction_pairs.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "core/model/contact_law.hpp"
#include "core/model/setting_table.hpp"

namespace friction_pairs_test {

using namespace holdfast::internal;

namespace {

bool set(Settings& settings, const char* section, const char* key, const char* value) {
  return find_setting(section, key)->set(settings, "1", value);
}

}  // namespace

TEST_CASE("friction_pairs: a name is the coefficient of its pair, dry or wet", "[core][friction_pairs]") {
  CHECK(friction_of_pair_name("cardboard-cardboard") == 0.5);
  CHECK(friction_of_pair_name("timber-plywood") == 0.45);
  CHECK(friction_of_pair_name("timber-plywood-wet") == 0.45);
  CHECK_FALSE(friction_of_pair_name("cardboard-cardboard-wet"));
  CHECK_FALSE(friction_of_pair_name("cardboard"));
  CHECK_FALSE(friction_of_pair_name(""));
  std::set<std::string_view> names;
  for (const FrictionPair& pair : friction_pairs()) CHECK(names.insert(pair.name).second);
}

TEST_CASE("friction_pairs: two boxes whose material is named have the coefficient of the pair",
          "[core][friction_pairs]") {
  for (const FrictionPair& pair : friction_pairs()) {
    INFO(pair.name);
    Settings settings;
    REQUIRE(set(settings, "Material N", "Friction", std::string(pair.name).c_str()) == pair.same);
    if (!pair.same) continue;
    const Surface box{SurfaceKind::box, friction_of(settings, 1), 0.0};
    CHECK(friction_of_pair(settings.contact, box, box, 1.0) == Approx(pair.dry).epsilon(1e-15));
  }
  Settings settings;
  REQUIRE(set(settings, "Simulation Settings", "BoxFriction", "cardboard-cardboard"));
  CHECK(settings.box_friction == Settings{}.box_friction);
}

TEST_CASE("friction_pairs: the keys of pairs take every name, those of the container take none",
          "[core][friction_pairs]") {
  for (const FrictionPair& pair : friction_pairs()) {
    const std::string name(pair.name);
    Settings settings;
    for (const char* key : {"BoxBox", "BoxFloor", "BoxWall"}) CHECK(set(settings, "Contact", key, name.c_str()));
    CHECK(settings.contact.box_floor == pair.dry);
    for (const char* key : {"ContainerFriction", "GroundFriction"})
      CHECK_FALSE(set(settings, "Simulation Settings", key, name.c_str()));
  }
  // What is accepted says where a name belongs.
  CHECK_THAT(std::string(find_setting("Simulation Settings", "ContainerFriction")->accepted),
             Catch::Contains("FrictionModel = pairs"));
  CHECK_THAT(std::string(find_setting("Simulation Settings", "BoxFriction")->accepted),
             Catch::Contains("FrictionModel = pairs"));
}

}  // namespace friction_pairs_test
