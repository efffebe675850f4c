#include "core/model/setting_table.hpp"

#include <catch2/catch.hpp>
#include <set>

namespace setting_table_test {

using namespace holdfast::internal;

namespace {

/// Whether the key accepts the text, in new settings with material 1.
bool takes(const char* section, const char* name, const char* text) {
  Settings settings;
  const SettingKey* key = find_setting(section, name);
  REQUIRE(key != nullptr);
  return key->set(settings, "1", text);
}

/// Sets the value from a text and returns its text.
std::string round_trip(const char* section, const char* name, const char* text) {
  Settings settings;
  const SettingKey* key = find_setting(section, name);
  REQUIRE(key != nullptr);
  REQUIRE(key->set(settings, "1", text));
  return key->get(settings, "1");
}

}  // namespace

TEST_CASE("setting_table: every key is declared once and completely", "[core][setting_table]") {
  std::set<std::pair<std::string_view, std::string_view>> seen;
  for (const SettingKey& key : setting_table()) {
    INFO(key.section << " " << key.name);
    CHECK(seen.emplace(key.section, key.name).second);
    CHECK_FALSE(key.accepted.empty());
    CHECK(key.sentence.ends_with('.'));
    CHECK(find_setting(key.section, key.name) == &key);
    CHECK(key.set != nullptr);
    CHECK(key.get != nullptr);
  }
}

TEST_CASE("setting_table: the declared default is the default of the member", "[core][setting_table]") {
  Settings defaults;
  defaults.materials[1] = {};
  for (const SettingKey& key : setting_table()) {
    INFO(key.section << " " << key.name);
    Settings set = defaults;
    if (!key.default_value.empty()) REQUIRE(key.set(set, "1", key.default_value));
    CHECK(key.get(defaults, "1") == key.get(set, "1"));
    CHECK(key.get(defaults, "1").empty() == key.default_value.empty());
  }
}

TEST_CASE("setting_table: a key reads what it writes", "[core][setting_table]") {
  for (const SettingKey& key : setting_table()) {
    INFO(key.section << " " << key.name);
    for (const char* text : {"1", "0.3333333333333333", "1e-3", "true", "settled", "pairs", "free", "y", "sleeping",
                             "wake_on_change", "native", "serial", "left, roof", "1 2.5 -3", "a path"}) {
      Settings settings;
      if (!key.set(settings, "1", text)) continue;
      Settings again;
      REQUIRE(key.set(again, "1", key.get(settings, "1")));
      CHECK(key.get(again, "1") == key.get(settings, "1"));
    }
  }
}

TEST_CASE("setting_table: a refused text changes nothing", "[core][setting_table]") {
  for (const SettingKey& key : setting_table()) {
    INFO(key.section << " " << key.name);
    Settings settings;
    if (key.set(settings, "7", "\x01 no value")) continue;
    CHECK(settings.materials.empty());
    CHECK(key.get(settings, "1") == key.get(Settings{}, "1"));
  }
}

TEST_CASE("setting_table: keys set the member they name, in SI units", "[core][setting_table]") {
  Settings s;
  const auto set = [&](const char* section, const char* name, const char* text) {
    REQUIRE(find_setting(section, name)->set(s, "3", text));
  };
  set("Container", "Length", "1203.5");
  set("Container", "OpenSides", "rear,roof  rear");
  set("Container", "DropSides", "left 60, right 62.5");
  set("Material N", "Fixed", "yes");
  set("Physics Engine", "SimulationStepsPerSecond", "480");
  set("Export Settings", "ResultsIntervalInSeconds", "0.25");
  set("Material N", "CentreOfMass", "1 -2.5\t0");
  set("Material N", "Mass", "12");
  set("Bullet", "Sleeping", "wake_on_change");
  set("Screening", "TiltThreshold", "5");
  CHECK(s.container.size.x() == 12.035);
  CHECK(s.container.open_sides == std::vector<std::string>{"rear", "roof"});
  CHECK(s.container.drop_sides == std::vector<DropSide>{{"left", 0.6}, {"right", 0.625}});
  CHECK(s.materials.at(3).fixed);
  CHECK(s.steps_per_second == 480.0);
  CHECK(s.results_interval == 0.25);
  CHECK(s.materials.at(3).centre_of_mass == Vec3(0.01, -0.025, 0.0));
  CHECK(s.materials.at(3).mass == 12.0);
  CHECK(s.bullet.sleeping == BulletSleeping::wake_on_change);
  CHECK(s.screening.tilt_threshold == 5.0);
  CHECK(find_setting("Container", "Length")->get(s, "") == "1203.5");
  CHECK(find_setting("Material N", "CentreOfMass")->get(s, "3") == "1 -2.5 0");
  CHECK(find_setting("Material N", "Mass")->get(s, "4").empty());
}

TEST_CASE("setting_table: numbers are read whole, finite and in range", "[core][setting_table]") {
  CHECK(takes("Simulation Settings", "BoxFriction", "1e-3"));
  CHECK(takes("Simulation Settings", "BoxFriction", "+0.5"));
  for (const char* bad : {"", "nan", "inf", "0x10", "1,5", "0.5 m", "-0.1", "half"}) {
    INFO(bad);
    CHECK_FALSE(takes("Simulation Settings", "BoxFriction", bad));
  }
  CHECK_FALSE(takes("Physics Engine", "DensityValue", "0"));
  CHECK_FALSE(takes("Physics Engine", "SimulationStepsPerSecond", "1e9"));
  CHECK_FALSE(takes("Export Settings", "ResultsIntervallInSeconds", "1e-12"));
  CHECK_FALSE(takes("Contact", "Restitution", "1.01"));
  CHECK_FALSE(takes("Screening", "TiltThreshold", "181"));
  CHECK_FALSE(takes("Screening", "Threads", "1.5"));
  CHECK_FALSE(takes("Screening", "Threads", "-1"));
  CHECK_FALSE(takes("Bullet", "FrictionDirections", "3"));
  CHECK(takes("Bullet", "SplitImpulseThreshold", "-0.04"));
}

TEST_CASE("setting_table: no number is so large or so small that a run cannot compute with it",
          "[core][setting_table]") {
  int numbers = 0;
  for (const SettingKey& key : setting_table()) {
    INFO(key.section << " " << key.name);
    Settings settings;
    if (key.accepted.starts_with("a number")) {
      ++numbers;
      CHECK_FALSE(key.set(settings, "1", "1e300"));
      CHECK_FALSE(key.set(settings, "1", "-1e300"));
    }
  }
  CHECK(numbers > 30);
  for (const char* length : {"Length", "Width", "Height", "Mass"}) CHECK_FALSE(takes("Container", length, "1e-300"));
  CHECK_FALSE(takes("Physics Engine", "DensityValue", "1e-300"));
}

TEST_CASE("setting_table: booleans, words and lists", "[core][setting_table]") {
  for (const char* yes : {"true", "TRUE", "Yes", "1"}) CHECK(round_trip("Bullet", "RandomOrder", yes) == "true");
  for (const char* no : {"false", "False", "NO", "0"}) CHECK(round_trip("Bullet", "RandomOrder", no) == "false");
  CHECK_FALSE(takes("Bullet", "RandomOrder", "on"));
  CHECK_FALSE(takes("Container", "UpAxis", "x"));
  CHECK_FALSE(takes("Screening", "Engine", "Bullet"));
  CHECK_FALSE(takes("Screening", "Scheduler", "pthread"));
  CHECK_FALSE(takes("Container", "OpenSides", "rear; roof"));
  CHECK(round_trip("Container", "OpenSides", "").empty());
  CHECK(round_trip("Container", "DropSides", "rear 40 left 60.5") == "rear 40 left 60.5");
  for (const char* wrong : {"left", "60", "left 60 left 50", "roof 60", "left -1", "left 0", "left 60 right"})
    CHECK_FALSE(takes("Container", "DropSides", wrong));
  CHECK_FALSE(takes("Material N", "CentreOfMass", "1,5 0 0"));
  CHECK_FALSE(takes("Material N", "CentreOfMass", "1,2,3"));
  CHECK_FALSE(takes("Material N", "CentreOfMass", "1 2"));
  CHECK_FALSE(takes("Export Settings", "SavePath", ""));
}

TEST_CASE("setting_table: keys are found only by exact section and name or alias", "[core][setting_table]") {
  CHECK(find_setting("Export Settings", "ResultsIntervalInSeconds") ==
        find_setting("Export Settings", "ResultsIntervallInSeconds"));
  CHECK(find_setting("Contact", "BoxFriction") == nullptr);
  CHECK(find_setting("Contact", "") == nullptr);
  CHECK(find_setting("Contact", "restitution") == nullptr);
}

TEST_CASE("setting_table: contradictions between keys", "[core][setting_table]") {
  CHECK(check_settings(Settings{}).empty());

  Settings s;
  s.materials[3].density = 200.0;
  s.materials[3].mass = 10.0;
  s.materials[3].friction = 0.4;
  s.contact.friction_model = FrictionModel::pairs;
  s.batch_simulation = true;
  const std::vector<SettingConflict> conflicts = check_settings(s);
  REQUIRE(conflicts.size() == 3);
  CHECK(conflicts[0].section == "Material 3");
  CHECK(conflicts[0].name == "Mass");
  CHECK(conflicts[0].error.message() ==
        "a material has both a mass and a density: [Material 3] Mass; give only one of them");
  CHECK(conflicts[1].error.message() ==
        "a material has its own friction while FrictionModel is pairs: [Material 3] Friction; "
        "remove it, or set FrictionModel = product");
  CHECK(conflicts[2].error.message() ==
        "a batch has no folder to read from: [Simulation Settings] BatchSimulation; "
        "give BatchPath, or set BatchSimulation = false");
}

}  // namespace setting_table_test
