#pragma once

#include <catch2/catch.hpp>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "analyses/analysis.hpp"
#include "analyses/damage/damage.hpp"
#include "analyses/indicators/indicators.hpp"
#include "analyses/margins/margins.hpp"
#include "analyses/replicas/replica_verdict.hpp"
#include "analyses/walls/wall_forces.hpp"
#include "io/results/results_assembler.hpp"
#include "io/results/results_reader.hpp"
#include "io/results/results_resume.hpp"
#include "io/results/results_writer.hpp"

/// Generated runs for the tests of the results file.
namespace results_fixture {

using namespace holdfast::internal;

/// A folder that is removed when the test ends.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "holdfast_test_XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// Numbers of boxes and samples of a layout's worlds.
struct Shape {
  std::size_t boxes = 0;
  std::size_t samples = 0;
};

/// A run with the records of all its worlds.
struct Run {
  RunDescription description;
  std::vector<UnitRecord> units;  ///< one unit per layout
};

inline WorldRecord make_world(std::mt19937& random, std::uint64_t layout, std::uint64_t acceleration, Shape shape) {
  std::uniform_real_distribution<float> uniform(-0.2F, 0.2F);
  const auto number = [&] { return uniform(random); };
  const auto vector = [&] { return Float3{number(), number(), number()}; };
  WorldRecord world;
  world.row.layout = layout;
  world.row.acceleration = acceleration;
  world.row.stop_reason = StopReason::timeout;
  world.row.end_time = 0.1 * static_cast<double>(shape.samples);
  world.row.boxes = static_cast<std::uint32_t>(shape.boxes);
  world.row.steps = 1000 + layout;
  world.row.steps_skipped = 10;
  world.row.solve_iterations = 10000;
  world.row.max_residual = 0.001;
  world.row.residual_scale = 0.04;
  world.row.max_penetration = 1e-6 * static_cast<double>(layout);
  world.row.cpu_seconds = 0.25;
  world.row.peak_total_kinetic_energy = 5.0 + static_cast<double>(number());
  world.row.state_hash = random() * 0x100000001ULL;
  if (shape.boxes == 0) {
    world.row.status = Status::bad_layout;
    world.row.stop_reason = StopReason::not_run;
    world.row.message = "überlappt: box 3 and box 7";
  }
  for (std::size_t box = 0; box < shape.boxes; ++box) {
    world.boxes.id.push_back(static_cast<std::uint32_t>(box + 1));
    world.boxes.material.push_back(-1);
    world.boxes.mass.push_back(12.5F);
    world.boxes.size.push_back({0.8F, 0.6F, 0.4F});
    world.boxes.initial_position.push_back(vector());
    world.end.end_displacement.push_back(vector());
    world.end.end_tilt.push_back(100 * number());
    world.end.end_kinetic_energy.push_back(number() + 1);
    world.end.peak_displacement.push_back(length(world.end.end_displacement.back()) + 0.01F);
    world.end.peak_drop.push_back(std::max(0.0F, -world.end.end_displacement.back().z) + 0.01F);
    world.end.peak_tilt.push_back(world.end.end_tilt.back() + 1);
    world.end.first_beyond.push_back(0.1F * static_cast<float>(box));
    world.end.settling_peak_displacement.push_back(0.05F * number());
    world.end.settling_peak_drop.push_back(0.01F * number());
    world.end.settling_peak_tilt.push_back(number());
    world.end.peak_kinetic_energy.push_back(2);
    world.end.peak_speed.push_back(number() + 3);
    world.end.settling_displacement.push_back(vector());
  }
  ReplicaOutcome replicas{.count = 32,
                          .failed = static_cast<std::uint32_t>(layout),
                          .share = static_cast<double>(layout) / 32.0,
                          .wilson_low = 0.125,
                          .wilson_high = 0.25 * static_cast<double>(acceleration),
                          .verdict = ReplicaVerdict::uncertain,
                          .simulated = 33,
                          .cpu_seconds = 0.5,
                          .box_share = {}};
  for (std::size_t box = 0; box < shape.boxes; ++box) replicas.box_share.push_back(static_cast<float>(box) / 1024.0F);
  WorldDamage damage{.boxes_beyond = static_cast<std::uint32_t>(layout)};
  for (std::size_t box = 0; box < shape.boxes; ++box) {
    damage.peak_acceleration.push_back(static_cast<float>(box) / 8.0F);
    damage.velocity_change.push_back(static_cast<float>(layout + box) / 16.0F);
    damage.beyond.push_back(box % 2);
  }
  world.found.put(std::move(replicas));
  world.found.put(std::move(damage));
  Series& series = world.series;
  for (std::size_t sample = 0; sample < shape.samples; ++sample) {
    series.time.push_back(0.1 * static_cast<double>(sample));
    series.container_acceleration.push_back(vector());
    series.total_kinetic_energy.push_back(number());
    series.fallen_count.push_back(static_cast<std::uint32_t>(random() % 9));
    for (std::size_t box = 0; box < shape.boxes; ++box) {
      const bool last = sample + 1 == shape.samples;
      series.displacement.push_back(last ? world.end.end_displacement[box] : vector());
      series.orientation.push_back({1, number(), number(), number()});
      series.angular_velocity.push_back(vector());
      series.linear_acceleration.push_back(vector());
      series.force.push_back(vector());
      series.kinetic_energy.push_back(number());
    }
  }
  return world;
}

/// Adds forces on the walls, and their series.
inline void add_walls(std::mt19937& random, WorldRecord& world) {
  std::uniform_real_distribution<double> uniform(0, 1e5);
  WallForces walls;
  for (std::size_t side = 0; side < kPushedCount; ++side) {
    walls.peak_force.at(side) = uniform(random);
    walls.peak_time.at(side) = uniform(random);
    walls.peak_point.at(side) = Vec3(uniform(random), uniform(random), uniform(random));
    walls.lasting_force.at(side) = uniform(random);
    walls.limit.at(side) = uniform(random);
    walls.impulse.at(side) = Vec3(uniform(random), uniform(random), uniform(random));
  }
  for (std::size_t sample = 0; sample < world.series.time.size(); ++sample)
    for (float& force : walls.force.emplace_back()) force = static_cast<float>(uniform(random));
  world.found.put(std::move(walls));
}

/// A run with one unit per layout, each with two accelerations.
inline Run make_run(const std::vector<Shape>& shapes, bool series = true, RunTables analyses = {}) {
  std::mt19937 random(7);
  Run run;
  RunDescription& about = run.description;
  about = {.software = "holdfast 0.1.0",
           .git_commit = "unknown",
           .engine = "bullet",
           .command_line = "holdfast screen --layouts a b",
           .created_utc = "2024-05-01T12:00:00Z",
           .host = "host",
           .config_text = "[Physics Engine]\nDensityValue = 250\n",
           .settings = {{"Physics Engine/DensityValue", "250"}, {"Export Settings/SavePath", ""}},
           .analyses = std::move(analyses),
           .record_series = series};
  Acceleration braking{.name = "braking.txt", .sha256 = std::string(64, 'b')};
  braking.segments = {{.start = 0, .duration = 1, .acceleration = {1, 0, 0}},
                      {.start = 1.5, .duration = 0.25, .acceleration = {8, 0, 0.5}}};
  about.accelerations = {braking, Acceleration{.name = "missing.txt"}};
  for (std::uint64_t layout = 0; layout < shapes.size(); ++layout) {
    const Shape shape = shapes[layout];
    const std::string name = "loading, \"" + std::to_string(layout) + "\".txt";
    about.layout_names.push_back(name);
    about.layout_hashes.emplace_back(64, 'a');
    UnitRecord unit;
    Layout loading{.name = name, .sha256 = std::string(64, 'a'), .header = "262  18"};
    for (std::size_t box = 0; box < shape.boxes; ++box)
      loading.boxes.push_back({Vec3(0, 0, 0), Vec3(0.8, 0.6, 0.4), static_cast<int>(layout), 2});
    LayoutMargins margins;
    margins.margin = {0.5, 0.25, 1.5, 0.125 * static_cast<double>(layout)};
    margins.critical_box = {1, 2, 0, static_cast<std::uint32_t>(layout)};
    MarginSpread spread;
    spread.low = {0.375, 0.125, 1.5, 0.0625 * static_cast<double>(layout)};
    spread.high = {0.625, 0.375, 1.5, 0.25 * static_cast<double>(layout)};
    LayoutIndicators indicators;
    indicators.centre_of_gravity = Vec3(1, 2, 0.25 * static_cast<double>(layout));
    indicators.centre_offset = Vec3(0.5, -0.25, 0.125);
    indicators.fill = 0.5;
    indicators.badly_based = 0.125;
    indicators.badly_braced = 0.25;
    for (std::size_t box = 0; box < shape.boxes; ++box) {
      indicators.base_support.push_back(static_cast<float>(box) / 1024.0F);
      indicators.supported_sides.push_back(static_cast<std::uint8_t>(box % 5));
    }
    unit.layouts.push_back({layout, std::make_shared<const Layout>(std::move(loading)), {}});
    Findings& found = unit.layouts.back().found;
    found.put(std::move(margins));
    found.put(std::move(spread));
    found.put(std::move(indicators));
    for (std::uint64_t acceleration = 0; acceleration < 2; ++acceleration) {
      unit.worlds.push_back(make_world(random, layout, acceleration, shape));
      if (about.analyses == RunTables{&kWalls.tables} || about.analyses == all_tables())
        add_walls(random, unit.worlds.back());
      if (!series) unit.worlds.back().series = {};
    }
    run.units.push_back(unit);
  }
  return run;
}

/// Shapes whose worlds cross no, one and several boundaries of chunks.
inline std::vector<Shape> mixed_shapes() {
  return {{3, 4}, {0, 0}, {600, 31}, {1, 1}, {64, 256}, {0, 0}, {100, 31}, {1, 20000}, {5, 1}};
}

/// Limits that close a part after every unit, or only at the end.
inline PartLimits every_unit() { return {.worlds = 1, .age = std::chrono::hours(1)}; }
inline PartLimits never() {
  return {.worlds = 1U << 30U, .bytes = std::size_t{1} << 40U, .age = std::chrono::hours(1)};
}

inline void require_ok(const std::optional<Error>& error) {
  INFO((error ? error->message() : ""));
  REQUIRE_FALSE(error);
}

template <class T>
T require_value(Result<T> result) {
  INFO((result ? "" : result.error().message()));
  REQUIRE(result);
  return std::move(*result);
}

/// A unit through the three stages.
inline std::optional<Error> write_unit(ResultsWriter& writer, UnitRecord record) {
  const std::unique_ptr<SinkUnit> unit = writer.place(record);
  unit->pack();
  return unit->write();
}

/// Units [begin, end), one after the other.
inline void write_units(ResultsWriter& writer, const Run& run, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) require_ok(write_unit(writer, run.units[i]));
}

/// Writes a whole run into a finished file.
inline void write_run_to(const std::string& path, const Run& run, const PartLimits& limits) {
  const auto writer = require_value(ResultsWriter::open(path, run.description, {}, limits));
  write_units(*writer, run, 0, run.units.size());
  require_ok(writer->finish());
  require_ok(assemble(path, run.description));
}

std::string file_bytes(const std::string& path);

/// Names in a folder, sorted.
std::vector<std::string> list_directory(const std::string& path);

}  // namespace results_fixture
