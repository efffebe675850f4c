#include "app/validate/validation_files.hpp"

#include <unistd.h>
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace validation_files_test {

using namespace holdfast::internal;

namespace {

ValidationRow row(const std::string& metric, double error, ToleranceClass tolerance = ToleranceClass::fine) {
  return {"slide", "a_case", "bullet", "240 Hz, 50 it", {metric, 1.0 + error, 1.0, error, tolerance}, 0.5};
}

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("holdfast_" + std::to_string(::getpid()) + "_" + name)).string();
}

}  // namespace

TEST_CASE("validation_files: recorded bounds leave room for rounding and for nothing more", "[app][validation_files]") {
  const std::string path = temporary("bounds.tsv");
  const std::vector<ValidationRow> today = {row("path (m)", 1e-3), row("rest (m)", 0.0),
                                            row("falls", 1.0, ToleranceClass::verdict),
                                            row("stands", 0.0, ToleranceClass::verdict)};
  REQUIRE_FALSE(write_bounds(path, today).has_value());
  const Result<Bounds> bounds = read_bounds(path);
  REQUIRE(bounds);
  CHECK(bounds->size() == 4);
  CHECK(missed(today, *bounds).empty());
  CHECK(missed(std::vector{row("path (m)", 1.9e-3)}, *bounds).empty());
  CHECK(missed(std::vector{row("path (m)", 2.1e-3)}, *bounds).size() == 1);
  CHECK(missed(std::vector{row("rest (m)", 1e-8)}, *bounds).size() == 1);
  CHECK(missed(std::vector{row("stands", 1.0, ToleranceClass::verdict)}, *bounds).size() == 1);
  CHECK(missed(std::vector{row("a new one", 0.0)}, *bounds).size() == 1);
  // Other settings of Bullet are points of the plot.
  ValidationRow other = row("path (m)", 1.0);
  other.setting = "60 Hz, 10 it";
  CHECK(missed(std::vector{other}, *bounds).empty());
  REQUIRE_FALSE(write_bounds(path, std::vector{other}).has_value());
  CHECK(read_bounds(path)->empty());
  std::filesystem::remove(path);
}

TEST_CASE("validation_files: infinite errors are bounds that are kept", "[app][validation_files]") {
  const std::string path = temporary("lost.tsv");
  const double infinity = std::numeric_limits<double>::infinity();
  REQUIRE_FALSE(write_bounds(path, std::vector{row("path (m)", infinity)}).has_value());
  const Result<Bounds> bounds = read_bounds(path);
  REQUIRE(bounds);
  CHECK(missed(std::vector{row("path (m)", infinity)}, *bounds).empty());
  std::filesystem::remove(path);
}

TEST_CASE("validation_files: a line that is no bound is named", "[app][validation_files]") {
  const std::string path = temporary("bad.tsv");
  std::ofstream(path) << "# comment\nbullet\tcoarse\ta_case\tpath\tmuch\n";
  const Result<Bounds> bounds = read_bounds(path);
  REQUIRE_FALSE(bounds);
  CHECK(bounds.error().line == 2);
  std::filesystem::remove(path);
}

TEST_CASE("validation_files: JSON has the documented members", "[app][validation_files]") {
  const auto json = nlohmann::json::parse(validation_json(std::vector{row("path (m)", 1e-3)}));
  REQUIRE(json.size() == 1);
  for (const char* name :
       {"case", "engine", "setting", "metric", "value", "expected", "error", "tolerance", "pass", "cpu_seconds"})
    CHECK(json[0].contains(name));
  CHECK(json[0]["pass"] == false);
}

}  // namespace validation_files_test
