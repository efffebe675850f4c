#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/engine_loader.hpp"
#include "app/bearing_table.hpp"
#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "app/run_inputs.hpp"
#include "app/screening.hpp"
#include "core/model/norms.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/input_paths.hpp"
#include "io/input/text_lines.hpp"
#include "io/loads/load_file.hpp"
#include "io/loads/table_text.hpp"
#include "parallel/screening/world_limits.hpp"

namespace holdfast::internal {

namespace {

const char* name_of(InputKind kind) {
  switch (kind) {
    case InputKind::layout:
      return "layout";
    case InputKind::acceleration:
      return "acceleration";
    case InputKind::config:
      return "config";
    default:
      return "no known kind";
  }
}

/// What is wrong with a file, and in a few words what is in it.
struct Finding {
  std::vector<Error> errors;
  std::vector<Error> warnings;
  std::string form;  ///< what a layout is written in
  std::string description;
  std::string bearing;  ///< lines about the weight that boxes bear
};

/// The engine of a configuration, as far as it is there.
struct AskedEngine {
  std::optional<Error> error;    ///< what it cannot do of the settings
  std::optional<Error> warning;  ///< why it is not there; the files may be checked all the same
  std::optional<double> steps_per_second;
};

AskedEngine ask_engine(const Settings& settings, const std::string& config_path) {
  const EngineEntry* entry = find_engine(settings.screening.engine);
  // Looking for devices takes seconds, and says nothing of the files.
  if (entry != nullptr && runs_on_devices(*entry)) return {};
  const auto engine = make_engine(settings.screening.engine, settings);
  if (engine) return {.steps_per_second = (*engine)->traits().steps_per_second};
  Error error = engine.error();
  error.file = config_path;
  if (entry != nullptr && why_not_loadable(*entry)) return {.warning = std::move(error)};
  return {.error = std::move(error)};
}

/// Checks files one by one as `screen` does when it reads them, and then together.
class InputCheck {
 public:
  InputCheck(const Settings& settings, std::optional<double> steps_per_second, bool bearing)
      : settings_(settings), steps_per_second_(steps_per_second), bearing_(bearing) {
    if (settings_.screening.norm.empty()) return;
    for (Acceleration& made : find_norm(settings_.screening.norm)->accelerations())
      accelerations_.push_back(std::move(made));
  }

  Finding check(const InputFile& input) {
    Finding finding;
    const Result<TextFile> file = read_text_file(input.path);
    if (!file) return {.errors = file.errors()};
    switch (input.kind) {
      case InputKind::layout:
        take<LoadsOfFile>(finding, read_loads(*file, settings_),
                          [&](const LoadsOfFile& loads) { take_loads(finding, input.path, loads); });
        break;
      case InputKind::acceleration:
        take<Acceleration>(finding, parse_acceleration(*file, finding.warnings), [&](const Acceleration& acceleration) {
          finding.description =
              fmt::format("{} segments, {:g} s", acceleration.segments.size(), acceleration.end_time());
          check_length(finding, input.path, acceleration);
          accelerations_.push_back(acceleration);
        });
        break;
      case InputKind::config:
        take<Config>(finding, parse_config(*file, finding.warnings), [&](const Config& config) {
          finding.description = fmt::format("{} keys", config.given.size());
          const AskedEngine engine = ask_engine(config.settings, input.path);
          if (engine.error) finding.errors.push_back(*engine.error);
          if (engine.warning) finding.warnings.push_back(*engine.warning);
        });
        break;
      case InputKind::unknown:
        finding.errors.push_back(why_no_text(input.path, file->text)
                                     .value_or(Error{.file = input.path,
                                                     .what = "neither layout, acceleration nor config",
                                                     .accepted = "a layout has 7 columns or a header that names them, "
                                                                 "an acceleration 5, a config [sections]"}));
    }
    return finding;
  }

  /// Layouts whose time series would be too large under one of the accelerations.
  std::vector<Error> check_together() const {
    std::vector<Error> warnings;
    for (const auto& [path, boxes] : layouts_) {
      for (const Acceleration& acceleration : accelerations_) {
        const auto too_large = check_rows(path, boxes, acceleration, settings_);
        if (too_large) warnings.push_back(*too_large);
      }
    }
    return warnings;
  }

 private:
  template <class T>
  static void take(Finding& finding, const Result<T>& result, const std::function<void(const T&)>& go_on) {
    if (result)
      go_on(*result);
    else
      finding.errors = result.errors();
  }

  void take_loads(Finding& finding, const std::string& path, const LoadsOfFile& loads) {
    std::size_t boxes = 0;
    double mass = 0.0;
    finding.warnings = loads.notes;
    finding.form = loads.form;
    for (const ReadLoad& load : loads.loads) {
      const std::vector<Box>& all = load.layout.boxes;
      boxes += all.size();
      for (const Box& box : all)
        if (!properties_of(settings_, box).fixed) mass += box.mass.value_or(0.0);
      if (load.errors.empty()) layouts_.push_back({path, all.size()});
      finding.errors.insert(finding.errors.end(), load.errors.begin(), load.errors.end());
      finding.warnings.insert(finding.warnings.end(), load.warnings.begin(), load.warnings.end());
      if (load.errors.empty()) take_bearing(finding, path, load.layout);
    }
    // A text never has weights.
    const std::string_view without = loads.form.starts_with("text") ? "" : ", no weights";
    finding.description = fmt::format(
        "{}{} {}{}{}{}", loads.loads.size() > 1 ? counted(loads.loads.size(), "load") + ", " : "", boxes,
        boxes == 1 ? "box" : "boxes", mass > 0.0 ? fmt::format(", {:.6g} kg", mass) : without, container_text(loads),
        loads.ignored.empty() ? "" : "; not used: " + shown(fmt::format("{}", fmt::join(loads.ignored, ", "))));
  }

  /// The container of a file's only load, or of all its loads where they have none of their own. A text never has one.
  std::string container_text(const LoadsOfFile& loads) const {
    const bool has_own = std::any_of(loads.loads.begin(), loads.loads.end(),
                                     [](const ReadLoad& load) { return load.layout.container.has_value(); });
    if (loads.form.starts_with("text") || loads.loads.empty() || (has_own && loads.loads.size() > 1)) return "";
    const ContainerSettings container = container_of(settings_, loads.loads.front().layout);
    if (!container.type.empty()) return ", container " + container.type;
    return fmt::format(", container {:g} x {:g} x {:g} m", container.size.x(), container.size.y(), container.size.z());
  }

  void take_bearing(Finding& finding, const std::string& path, const Layout& layout) const {
    const std::size_t load = layout.name.rfind('#');
    const std::string where =
        load == std::string::npos || path.ends_with(layout.name) ? path : path + layout.name.substr(load);
    const BearingFindings found = find_bearing_of(where, layout, settings_, bearing_);
    finding.bearing += found.text;
    finding.warnings.insert(finding.warnings.end(), found.warnings.begin(), found.warnings.end());
  }

  /// Samples are a warning: without series there are none, and only the run knows whether it has them.
  void check_length(Finding& finding, const std::string& path, const Acceleration& acceleration) const {
    if (const auto samples = check_samples(path, acceleration, settings_)) finding.warnings.push_back(*samples);
    if (!steps_per_second_) return;
    if (const auto error = check_steps(path, acceleration, settings_, *steps_per_second_))
      finding.errors.push_back(*error);
    else if (const auto many = many_steps_warning(path, acceleration, settings_, *steps_per_second_))
      finding.warnings.push_back(*many);
  }

  const Settings& settings_;
  std::optional<double> steps_per_second_;
  bool bearing_;                                              ///< all boxes are listed
  std::vector<std::pair<std::string, std::size_t>> layouts_;  ///< path, boxes
  std::vector<Acceleration> accelerations_;
};

std::vector<std::string> paths_of_kind(const std::vector<InputFile>& inputs, InputKind kind) {
  std::vector<std::string> paths;
  for (const InputFile& input : inputs)
    if (input.kind == kind) paths.push_back(input.path);
  return paths;
}

}  // namespace

ExitCode run_check_command(const CheckOptions& options) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  Settings settings = config->settings;
  if (const auto wrong = options.loads.apply_to(settings, *config)) return fail(ExitCode::bad_usage, *wrong);
  const AskedEngine engine = ask_engine(settings, options.config_path.value_or(""));
  if (engine.error) return fail(ExitCode::bad_usage, *engine.error);
  std::vector<Error> warnings;
  if (engine.warning) warnings.push_back(*engine.warning);
  const auto inputs = find_inputs(options.paths, std::cin, warnings);
  if (!inputs) return fail(ExitCode::bad_usage, inputs.errors());
  warn(warnings);
  warn_of_same_names(paths_of_kind(*inputs, InputKind::layout));
  warn_of_same_names(paths_of_kind(*inputs, InputKind::acceleration));

  InputCheck check(settings, engine.steps_per_second, options.bearing);
  std::size_t bad = 0;
  for (const InputFile& input : *inputs) {
    const Finding finding = check.check(input);
    warn(finding.warnings);
    fail(ExitCode::bad_usage, finding.errors);
    const std::string kind = finding.form.empty() ? name_of(input.kind) : fmt::format("layout ({})", finding.form);
    if (finding.errors.empty()) {
      print_to(stdout, "{}: ok: {}, {}\n{}", input.path, kind, finding.description, finding.bearing);
    } else {
      print_to(stdout, "{}: bad: {}, {}\n", input.path, kind, counted(finding.errors.size(), "error"));
      ++bad;
    }
  }
  warn(check.check_together());
  if (bad > 0) print_to(stderr, "{} of {} files are bad\n", bad, inputs->size());
  return bad == 0 ? ExitCode::done : ExitCode::bad_usage;
}

}  // namespace holdfast::internal
