// Layouts under accelerations in native, Bullet, Box3D and Jolt, taking turns on one thread: README.md says how.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/series_recorder.hpp"
#include "core/engine/simulate.hpp"
#include "core/model/verdict.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_file.hpp"
#include "parallel/schedulers/processor_time.hpp"
#include "parallel/screening/failure_order.hpp"
#include "parallel/screening/world_limits.hpp"
#include "setting_name.hpp"

namespace holdfast::peers {

namespace {

using internal::Acceleration;
using internal::Error;
using internal::Layout;
using internal::Result;
using internal::Settings;
using internal::WorldRecord;

/// What the command line asks for.
struct Request {
  std::vector<std::string> layouts;
  std::vector<std::string> accelerations;
  std::vector<std::string> settings;
  std::string worlds;
  std::string positions;  ///< empty: none
  double interval = 0.1;  ///< s
  int repeats = 1;
  std::optional<double> friction;  ///< coefficient of every pair of surfaces; without it, that of the default settings
  bool holds = false;              ///< whether layouts hold is all that is asked
};

[[noreturn]] void fail(const std::string& what) {
  fmt::print(stderr, "peer_bench: {}\n", what);
  std::exit(1);
}

template <class T>
T value_or_fail(Result<T> result) {
  if (!result) fail(result.error().message());
  return std::move(*result);
}

/// A text file that is closed when the program ends.
class TextFile {
 public:
  explicit TextFile(const std::string& path) : file_(std::fopen(path.c_str(), "w")) {
    if (file_ == nullptr) fail(path + ": cannot be written");
  }
  void write(const std::string& text) {
    if (std::fputs(text.c_str(), file_.get()) < 0 || std::fflush(file_.get()) != 0) fail("a file cannot be written");
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

struct NamedEngine {
  std::string name;
  std::unique_ptr<internal::Engine> engine;
};

/// Builds and simulates one world; `cpu_seconds` is the processor time of both.
WorldRecord run(const internal::Engine& engine, const Layout& layout, const Acceleration& acceleration,
                const Settings& settings, bool series) {
  const Layout* const layouts[] = {&layout};
  const Acceleration* const accelerations[] = {&acceleration};
  internal::WorldBatch batch = make_batch(layouts, accelerations, settings);
  internal::RecordingPlan plan = recording_plan(settings, series);
  plan.samples = static_cast<std::size_t>(most_samples(acceleration, settings));
  internal::SeriesRecorder recorder(plan);
  internal::Recorder* const recorders[] = {&recorder};
  const std::atomic<bool> abort = false;
  const double begin = internal::processor_seconds();
  simulate(engine, batch, settings, recorders, abort);
  const double end = internal::processor_seconds();
  WorldRecord record = recorder.take();
  record.row.cpu_seconds = end - begin;
  return record;
}

/// Whether a layout holds all accelerations, and what it takes to know.
struct Answer {
  bool holds = true;
  std::size_t worlds = 0;
  double cpu_seconds = 0.0;
};

/// Asks one layout after the other whether it holds all accelerations, as a search does: a world ends when its verdict
/// is decided, and a layout with the first acceleration that it does not hold.
class Asker {
 public:
  Asker(const internal::Engine& engine, const Settings& settings, const std::vector<Acceleration>& accelerations)
      : engine_(engine),
        settings_(settings),
        accelerations_(accelerations),
        plan_(recording_plan(settings, false)),
        order_(accelerations.size(), engine.traits()) {
    plan_.stop_when = internal::StopWhen::moved;
  }

  Answer ask(const Layout& layout) {
    Answer answer;
    const double begin = internal::processor_seconds();
    order_.enter(asked_++);
    internal::LoadSimulation load(engine_, layout, settings_);
    for (const std::size_t i : order_.order()) {
      internal::SeriesRecorder recorder(plan_);
      load.run(accelerations_[i], recorder, false);
      WorldRecord record = recorder.take();
      record.row.acceleration = i;
      order_.count(record, plan_.thresholds);
      ++answer.worlds;
      answer.holds = !rejects(record, plan_.thresholds);
      if (!answer.holds) break;
    }
    answer.cpu_seconds = internal::processor_seconds() - begin;
    return answer;
  }

 private:
  const internal::Engine& engine_;
  const Settings& settings_;
  const std::vector<Acceleration>& accelerations_;
  internal::RecordingPlan plan_;
  internal::FailureOrder order_;
  std::size_t asked_ = 0;
};

std::string row_of(const WorldRecord& record, const Settings& settings) {
  const internal::WorldVerdict verdict =
      judge_world(record.row, record.end, internal::by_run(recording_plan(settings, false).thresholds));
  const double simulated =
      settings.screening.settle_seconds + record.row.end_time;  // what is unstable ends before t = 0
  return fmt::format("{},{:.9g},{:.6f},{},{:.7g},{},{},{}", record.boxes.id.size(), simulated, record.row.cpu_seconds,
                     internal::to_string(verdict.verdict), verdict.peak_displacement, verdict.moved, verdict.fallen,
                     verdict.tilted);
}

/// One line per sample and box, each after the columns in `key`.
std::string rows_of_positions(const std::string& key, const WorldRecord& record) {
  std::string rows;
  const std::size_t boxes = record.boxes.id.size();
  for (std::size_t i = 0; i < record.series.displacement.size(); ++i) {
    const internal::Float3& d = record.series.displacement[i];
    rows += fmt::format("{},{:.6g},{},{:.7g},{:.7g},{:.7g}\n", key, record.series.time[i / boxes],
                        record.boxes.id[i % boxes], d.x, d.y, d.z);
  }
  return rows;
}

Layout read_layout(const std::string& path, const Settings& settings) {
  std::vector<Error> warnings;
  return value_or_fail(parse_layout(value_or_fail(internal::read_text_file(path)), settings, warnings));
}

Acceleration read_acceleration(const std::string& path) {
  std::vector<Error> warnings;
  return value_or_fail(parse_acceleration(value_or_fail(internal::read_text_file(path)), warnings));
}

/// Layout by layout: whether it holds, by every engine.
void ask_all(const Request& request, const Settings& settings, const std::vector<NamedEngine>& engines,
             const std::vector<Acceleration>& accelerations) {
  TextFile answers(request.worlds);
  answers.write("layout,setting,repeat,boxes,worlds,cpu_seconds,holds\n");
  std::vector<std::vector<Asker>> askers(static_cast<std::size_t>(request.repeats));
  for (std::vector<Asker>& of_repeat : askers)
    for (const NamedEngine& named : engines) of_repeat.emplace_back(*named.engine, settings, accelerations);
  for (const std::string& path : request.layouts) {
    const Layout layout = read_layout(path, settings);
    for (std::size_t repeat = 0; repeat < askers.size(); ++repeat) {
      for (std::size_t i = 0; i < engines.size(); ++i) {
        const Answer answer = askers[repeat][i].ask(layout);
        answers.write(fmt::format("{},{},{},{},{},{:.6f},{:d}\n", layout.name, engines[i].name, repeat,
                                  layout.boxes.size(), answer.worlds, answer.cpu_seconds, answer.holds));
      }
    }
  }
}

void run_all(const Request& request) {
  Settings settings;
  settings.results_interval = request.interval;
  if (request.friction) {
    internal::ContactSettings& contact = settings.contact;
    contact.friction_model = internal::FrictionModel::pairs;
    contact.box_box = contact.box_floor = contact.box_wall = *request.friction;
  }
  std::vector<NamedEngine> engines;
  for (const std::string& name : request.settings) engines.push_back({name, value_or_fail(engine_of(name, settings))});
  std::vector<Acceleration> accelerations;
  for (const std::string& path : request.accelerations) accelerations.push_back(read_acceleration(path));
  if (request.holds) return ask_all(request, settings, engines, accelerations);

  TextFile worlds(request.worlds);
  worlds.write(
      "layout,acceleration,setting,repeat,boxes,simulated_seconds,cpu_seconds,verdict,peak_displacement,moved,fallen,"
      "tilted\n");
  std::unique_ptr<TextFile> positions;
  if (!request.positions.empty()) {
    positions = std::make_unique<TextFile>(request.positions);
    positions->write("layout,acceleration,setting,time,box,x,y,z\n");
  }
  for (const std::string& path : request.layouts) {
    const Layout layout = read_layout(path, settings);
    for (const Acceleration& acceleration : accelerations) {
      for (int repeat = 0; repeat < request.repeats; ++repeat) {
        for (const NamedEngine& named : engines) {
          const WorldRecord record = run(*named.engine, layout, acceleration, settings, positions != nullptr);
          const std::string key = fmt::format("{},{},{}", layout.name, acceleration.name, named.name);
          worlds.write(fmt::format("{},{},{}\n", key, repeat, row_of(record, settings)));
          if (positions && repeat == 0) positions->write(rows_of_positions(key, record));
        }
      }
    }
  }
}

}  // namespace

}  // namespace holdfast::peers

int main(int count, char** values) {
  holdfast::peers::Request request;
  CLI::App app("Simulates layouts under accelerations with several engines that take turns, on one thread.");
  app.add_option("--layouts", request.layouts, "Files of layouts")->required()->type_name("FILE");
  app.add_option("--accelerations", request.accelerations, "Files of accelerations")->required()->type_name("FILE");
  app.add_option("--settings", request.settings, "Such as native-screening, box3d-60x4s, jolt-480x20x4p")
      ->required()
      ->type_name("NAME");
  app.add_option("--worlds", request.worlds,
                 "CSV to write: one line per world (with --holds: per layout), setting and repeat")
      ->required()
      ->type_name("FILE");
  app.add_option("--positions", request.positions, "CSV to write: displacements of all boxes, m")->type_name("FILE");
  app.add_option("--interval", request.interval, "Between two positions of a box, s")->type_name("S");
  app.add_option("--repeats", request.repeats, "How often every world is simulated")->type_name("N");
  app.add_option("--friction", request.friction, "Coefficient of friction of all pairs of surfaces, in place of 0.5")
      ->type_name("MU");
  app.add_flag("--holds", request.holds,
               "Ask only whether each layout holds all accelerations: worlds end when they are decided, a layout with "
               "the first acceleration that it does not hold");
  CLI11_PARSE(app, count, values);
  holdfast::peers::run_all(request);
  return 0;
}
