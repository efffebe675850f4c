#include "io/input/config_reader.hpp"

#include <catch2/catch.hpp>

#include "io/input/memory_file.hpp"

namespace config_reader_test {

using namespace holdfast::internal;
using namespace holdfast::internal::test;

namespace {

Result<Config> parse(const std::string& text) {
  std::vector<Error> warnings;
  return parse_config(memory_file(text, "in/c.ini"), warnings);
}

Messages errors_of(const std::string& text) { return messages_of(parse(text)); }

Messages warnings_of(const std::string& text) {
  std::vector<Error> warnings;
  REQUIRE(parse_config(memory_file(text, "in/c.ini"), warnings));
  return messages_of(warnings);
}

}  // namespace

TEST_CASE("config_reader: a config of StableCargo", "[io][config_reader]") {
  const Result<Config> config = parse(
      "[Physics Engine]\nDensityValue=200\nConstantDensity=TRUE\nSimulationStepsPerSecond=120\n"
      "[Export Settings]\nResultsIntervallInSeconds=0.5\nSavePath=./out\n"
      "[Simulation Settings]\nStoppingCondition=sleeping\nTimeoutInSeconds=20\nSleepingThreshold=0.8\n"
      "BatchSimulation=yes\nBatchPath=./batch\nDropThreshold=0.1\nContainerFriction=0.7\nGroundFriction=0.5\n"
      "BoxFriction=0.4\n");
  REQUIRE(config);
  const Settings& s = config->settings;
  CHECK(s.density_value == 200.0);
  CHECK(s.steps_per_second == 120.0);
  CHECK(s.results_interval == 0.5);
  CHECK(s.save_path == "./out");
  CHECK(s.stopping_condition == StoppingCondition::sleeping);
  CHECK(s.timeout == 20.0);
  CHECK(s.batch_simulation);
  CHECK(s.batch_path == "./batch");
  CHECK(s.screening.drop_threshold == 0.1);
  CHECK(s.box_friction == 0.4);
  CHECK(config->path == "in/c.ini");
  CHECK(config->sha256.size() == 64);
  CHECK(config->text.starts_with("[Physics Engine]"));
  CHECK(config->given.size() == 14);
  CHECK(config->given.contains({"Simulation Settings", "BatchPath"}));
}

TEST_CASE("config_reader: white space, comments, colons and repeated sections are accepted", "[io][config_reader]") {
  const Result<Config> config = parse(
      "\xEF\xBB\xBF; a comment\r\n\r\n  [ Contact ] ; another\r\n\tRestitution : 0.25 ; a third\r\n"
      "# " +
      std::string(500, 'x') + "\n    FrictionModel=pairs\n[Container]\nMass = 1e3\n[Contact]\nBoxBox = +0.4");
  REQUIRE(config);
  CHECK(config->settings.contact.restitution == 0.25);
  CHECK(config->settings.contact.friction_model == FrictionModel::pairs);
  CHECK(config->settings.container.mass == 1000.0);
  CHECK(config->settings.contact.box_box == 0.4);
}

TEST_CASE("config_reader: both spellings of the results interval are one key", "[io][config_reader]") {
  const Result<Config> config = parse("[Export Settings]\nResultsIntervalInSeconds = 0.2\n");
  REQUIRE(config);
  CHECK(config->settings.results_interval == 0.2);
  CHECK(config->given.contains({"Export Settings", "ResultsIntervallInSeconds"}));
  CHECK(errors_of("[Export Settings]\nResultsIntervalInSeconds = 0.2\nResultsIntervallInSeconds = 0.3\n") ==
        Messages{"in/c.ini:3:1: the key is given twice: ResultsIntervallInSeconds; its first value is on line 2"});
}

TEST_CASE("config_reader: materials", "[io][config_reader]") {
  const Result<Config> config =
      parse("[Material 3]\nDensity = 300\nCentreOfMass = 1 -2 0.5\n[Material  07]\nMass = 5\n");
  REQUIRE(config);
  CHECK(config->settings.materials.at(3).density == 300.0);
  CHECK(config->settings.materials.at(3).centre_of_mass == Vec3(0.01, -0.02, 0.005));
  CHECK(config->settings.materials.at(7).mass == 5.0);
  CHECK(config->given.contains({"Material 7", "Mass"}));
  CHECK(errors_of("[Material 3]\nMass = 5\n[Material 03]\n Mass = 6\n") ==
        Messages{"in/c.ini:4:2: the key is given twice: Mass; its first value is on line 2"});
  for (const std::string bad :
       {"[Material]", "[Material any]", "[Material -1]", "[Material 1.5]", "[Material 2147483648]", "[Material a, b]"})
    CHECK(errors_of(bad + "\nMass = 5\n") ==
          Messages{
              "in/c.ini:1:1: a material section without the name of a material: " + bad +
              "; [Material N], where N is a whole number from 0, or a name that is not any, floor or wall and has no "
              "comma"});
  const Result<Config> named = parse("[Material  Euro pallet]\nMass = 25\n[Friction]\nfloor , Euro pallet = 0.45\n");
  REQUIRE(named);
  CHECK(named->settings.materials.at(MaterialName("Euro pallet")).mass == 25.0);
  CHECK(named->given.contains({"Material Euro pallet", "Mass"}));
  CHECK(named->given.contains({"Friction", "Euro pallet, floor"}));
  CHECK(errors_of("[Friction]\nfloor, wall = 0.3\n") ==
        Messages{
            "in/c.ini:2:1: unknown key in [Friction]: floor, wall; two names with a comma between them: materials, or "
            "`any`, and at most one of `floor` and `wall`"});
}

TEST_CASE("config_reader: a wrong value names its column and what is accepted", "[io][config_reader]") {
  CHECK(
      errors_of("[Simulation Settings]\n  SleepingThreshold =  1,5 ; comma\n") ==
      Messages{"in/c.ini:2:24: SleepingThreshold has a wrong value: 1,5; a number from 0 to 1000000 (m/s and rad/s)"});
  CHECK(errors_of("[Simulation Settings]\nBoxFriction = cardboard-pallet\n") ==
        Messages{"in/c.ini:2:15: BoxFriction has a wrong value: cardboard-pallet; a number from 0 to 10, or a pair of "
                 "one material with itself, such as cardboard-cardboard; other pairs are for BoxBox, BoxFloor and "
                 "BoxWall with FrictionModel = pairs"});
  CHECK(errors_of("[Simulation Settings]\nTimeoutInSeconds=nan\n") ==
        Messages{"in/c.ini:2:18: TimeoutInSeconds has a wrong value: nan; a number from 1e-12 to 1000000 (s)"});
  CHECK(errors_of("[Container]\nLength = 0x10\nWidth = inf\nHeight=-1\n") ==
        Messages{"in/c.ini:2:10: Length has a wrong value: 0x10; a number from 1e-12 to 1000000 (cm)",
                 "in/c.ini:3:9: Width has a wrong value: inf; a number from 1e-12 to 1000000 (cm)",
                 "in/c.ini:4:8: Height has a wrong value: -1; a number from 1e-12 to 1000000 (cm)"});
  CHECK(errors_of("[Container]\nMass =\nUpAxis = x\nOpenSides = rear, top\n") ==
        Messages{"in/c.ini:2:7: Mass has no value; a number from 1e-12 to 1000000 (kg)",
                 "in/c.ini:3:10: UpAxis has a wrong value: x; z or y",
                 "in/c.ini:4:13: OpenSides has a wrong value: rear, top; any of front, rear, left, right, roof, "
                 "separated by spaces or commas"});
  CHECK(errors_of("[Physics Engine]\nConstantDensity = maybe\n") ==
        Messages{"in/c.ini:2:19: ConstantDensity has a wrong value: maybe; true or false (also yes, no, 1, 0)"});
}

TEST_CASE("config_reader: a misspelt key or section is named with a suggestion", "[io][config_reader]") {
  CHECK(errors_of("[Simulation Settings]\nBoxFricton = 0.5\n") ==
        Messages{"in/c.ini:2:1: unknown key in [Simulation Settings]: BoxFricton; did you mean BoxFriction?"});
  CHECK(errors_of("[Contact]\nBoxFriction = 0.5\n") ==
        Messages{"in/c.ini:2:1: unknown key in [Contact]: BoxFriction; it belongs to [Simulation Settings]"});
  CHECK(errors_of("[Contact]\nColour = red\n") ==
        Messages{"in/c.ini:2:1: unknown key in [Contact]: Colour; one of Restitution, FrictionModel, BoxBox, BoxFloor, "
                 "BoxWall, KineticFriction"});
  CHECK(errors_of(" [Contacts]\nBoxBox = 0.5\nanything = 0\n") ==
        Messages{"in/c.ini:1:2: unknown section: [Contacts]; did you mean [Contact]?"});
  CHECK(errors_of("[material 3]\nMass = 1\n") ==
        Messages{"in/c.ini:1:1: unknown section: [material 3]; did you mean [Material N]?"});
  CHECK(errors_of("[X]\n").front().starts_with("in/c.ini:1:1: unknown section: [X]; one of [Physics Engine], "));
}

TEST_CASE("config_reader: of many unknown keys and sections the first are named, the others counted",
          "[io][config_reader]") {
  std::string text = "[Contact]\n";
  for (int i = 0; i < 19; ++i) text += "BoxBox" + std::to_string(i) + " = 1\n";
  for (int i = 0; i < 30; ++i) text += "[Containers " + std::to_string(i) + "]\n";
  text += "[Contact]\n";
  for (int i = 0; i < 40; ++i) text += "BoxWall" + std::to_string(i) + " = 1\n";
  const Messages errors = errors_of(text);
  REQUIRE(errors.size() == 21);
  CHECK(errors[18] == "in/c.ini:20:1: unknown key in [Contact]: BoxBox18; did you mean BoxBox?");
  CHECK(errors[19].starts_with("in/c.ini:21:1: unknown section: [Containers 0]"));
  CHECK(errors[20] == "in/c.ini: further errors: 69");
}

TEST_CASE("config_reader: a key given twice names the first line", "[io][config_reader]") {
  CHECK(errors_of("[Contact]\nBoxBox = 0.5\n[Container]\n[Contact]\nBoxBox = 0.5\n") ==
        Messages{"in/c.ini:5:1: the key is given twice: BoxBox; its first value is on line 2"});
}

TEST_CASE("config_reader: lines without a key are errors", "[io][config_reader]") {
  const std::string accepted = "; [section] or key = value";
  CHECK(errors_of("[Contact]\n BoxBox 0.5\n") ==
        Messages{"in/c.ini:2:2: neither a section nor a key with a value: BoxBox 0.5" + accepted});
  CHECK(errors_of("[Contact]\nRestitution = 0.5\n    0.7\n[Container]\nlast") ==
        Messages{"in/c.ini:3:5: neither a section nor a key with a value: 0.7" + accepted,
                 "in/c.ini:5:1: neither a section nor a key with a value: last" + accepted});
  CHECK(errors_of("BoxBox = 0.5\n[Contact]\n") ==
        Messages{"in/c.ini:1:1: a key before any section: BoxBox; a line [section] before it"});
  CHECK(errors_of("[Contact\nBoxBox = 0.5\n") ==
        Messages{"in/c.ini:1:1: not a section: [Contact; a name in brackets, alone in its line"});
  CHECK(errors_of("[Contact] BoxBox = 0.5\n") ==
        Messages{"in/c.ini:1:1: not a section: [Contact] BoxBox = 0.5; a name in brackets, alone in its line"});
  CHECK(errors_of("[Contact]\n = 0.5\n") == Messages{"in/c.ini:2:2: a value without a key: 0.5; key = value"});
}

TEST_CASE("config_reader: a line too long for the parser is an error, and is not truncated", "[io][config_reader]") {
  const std::string start = "[Export Settings]\nSavePath = ";
  const Result<Config> longest = parse(start + std::string(187, 'p') + "\n");
  REQUIRE(longest);
  CHECK(longest->settings.save_path == std::string(187, 'p'));
  CHECK(errors_of(start + std::string(188, 'p') + "\n[Contact]\nRestitution = x\n") ==
        Messages{"in/c.ini:2:1: the line is too long: 199 bytes; at most 198",
                 "in/c.ini:4:15: Restitution has a wrong value: x; a number from 0 to 1"});
}

TEST_CASE("config_reader: a zero byte does not hide the rest of a line", "[io][config_reader]") {
  CHECK(errors_of(std::string("[Contact]\nBoxBox = 0.5\0junk\n", 28)) ==
        Messages{"in/c.ini:2:1: the line has a zero byte: BoxBox = 0.5?junk; text"});
}

TEST_CASE("config_reader: keys without effect give a warning", "[io][config_reader]") {
  CHECK(warnings_of("[Renderer Engine]\nDrawAxis=true\nTexturePack =\nUseRenderer=0\n") ==
        Messages{"in/c.ini:2:1: DrawAxis has no effect yet: true", "in/c.ini:3:1: TexturePack has no effect yet",
                 "in/c.ini:4:1: UseRenderer has no effect yet: 0"});
  CHECK(warnings_of("[Contact]\nFrictionModel=pairs\n[Simulation Settings]\nBoxFriction = 0.5\n") ==
        Messages{"in/c.ini:4:1: BoxFriction has no effect while FrictionModel is pairs"});
  const std::string open = "[Container]\nOpenSides = rear\nBedHeight = ";
  const std::string low =
      "BedHeight is not above DropThreshold, so that a box on the ground may be moved and not fallen";
  CHECK(warnings_of(open + "5\n") == Messages{"in/c.ini:3:1: " + low});
  CHECK(warnings_of(open + "6\n").empty());
  CHECK(warnings_of(open + "0\n").empty());
  CHECK(warnings_of("[Container]\nBedHeight = 5\n").empty());
  CHECK(warnings_of("[Container]\nDropSides = left 60\n[Simulation Settings]\nDropThreshold = 1.5\n") ==
        Messages{"in/c.ini:4:1: " + low});
  CHECK(warnings_of("[Container]\nWidth = 233\n[Screening]\nMoveThreshold = 10\n") ==
        Messages{"in/c.ini:4:1: MoveThreshold, which is in m, is more than the width or length of the container"});
  CHECK(warnings_of("[Screening]\nMoveThreshold = 2\n").empty());
  CHECK(warnings_of("[Simulation Settings]\nDropThreshold = 5\n") ==
        Messages{"in/c.ini:2:1: DropThreshold, which is in m, is more than the height of the container"});
  CHECK(warnings_of("[Container]\nDropSides = left 220 right 221\n") ==
        Messages{"in/c.ini:2:1: a drop side is higher than the container"});
  CHECK(warnings_of("; nothing\n") == Messages{"in/c.ini: sets no key, so that all keys have their defaults"});
}

TEST_CASE("config_reader: the friction model follows from the keys, and keys without effect are errors",
          "[io][config_reader]") {
  CHECK(parse("[Contact]\nBoxFloor = 0.3\n")->settings.contact.friction_model == FrictionModel::pairs);
  CHECK(parse("[Simulation Settings]\nBoxFriction = 0.5\n")->settings.contact.friction_model == FrictionModel::product);
  CHECK(errors_of("[Contact]\nFrictionModel = product\nBoxFloor = 0.3\n") ==
        Messages{
            "in/c.ini:3:1: a key has no effect while FrictionModel is product: [Contact] BoxFloor; remove it, or set "
            "FrictionModel = pairs"});
  CHECK(errors_of("[Contact]\nBoxFloor = 0.3\n[Simulation Settings]\nBoxFriction = 0.5\n") ==
        Messages{"in/c.ini:2:1: a coefficient of a pair is given beside BoxFriction or ContainerFriction, which are "
                 "factors of a product: [Contact] BoxFloor; set FrictionModel, or give the keys of one model"});
}

TEST_CASE("config_reader: contradictions name the key to change", "[io][config_reader]") {
  CHECK(errors_of("[Material 4]\nDensity = 100\nMass = 3\n") ==
        Messages{"in/c.ini:3:1: a material has both a mass and a density: [Material 4] Mass; give only one of them"});
  CHECK(errors_of("[Simulation Settings]\nBatchSimulation = true\nBatchPath =\n") ==
        Messages{"in/c.ini:2:1: a batch has no folder to read from: [Simulation Settings] BatchSimulation; "
                 "give BatchPath, or set BatchSimulation = false"});
  CHECK(errors_of("[Contact]\nFrictionModel = pairs\n[Material 1]\nFriction = 1\n") ==
        Messages{"in/c.ini:4:1: a material has its own friction while FrictionModel is pairs: [Material 1] "
                 "Friction; remove it, or set FrictionModel = product"});
}

}  // namespace config_reader_test
