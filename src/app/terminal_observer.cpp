#include "app/terminal_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <span>
#include <utility>

#include "app/norm_option.hpp"
#include "app/report.hpp"
#include "app/run_inputs.hpp"
#include "app/world_json.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/engine/journey.hpp"
#include "core/engine/simulate.hpp"
#include "core/model/setting_table.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast::internal {

namespace {

constexpr std::size_t kWarningsShown = 20;

/// The engine's name, and its accuracy where it has one.
std::string engine_text(const Settings& settings) {
  const std::string accuracy = accuracy_of(settings);
  return settings.screening.engine + (accuracy.empty() ? "" : ", accuracy " + accuracy);
}

/// The coefficients of friction that act.
std::string friction_text(const Settings& settings) {
  const ContactSettings& contact = settings.contact;
  if (contact.friction_model == FrictionModel::pairs) {
    const std::size_t own = contact.materials.rows().size();
    return fmt::format("friction: box on box {:.3g}, on the floor {:.3g}, on walls {:.3g}{}\n", contact.box_box,
                       contact.box_floor, contact.box_wall,
                       own == 0   ? ""
                       : own == 1 ? "; one pair of materials has its own"
                                  : fmt::format("; {} pairs of materials have their own", own));
  }
  const bool own = std::any_of(settings.materials.begin(), settings.materials.end(),
                               [](const auto& one) { return one.second.friction.has_value(); });
  return fmt::format("friction: box on box {:.3g}, on floor and walls {:.3g}{}\n",
                     settings.box_friction * settings.box_friction, settings.box_friction * settings.container.friction,
                     own ? ", others where a material has its own" : "");
}

/// The first lines: what is run, and what its norm says.
std::string start_text(const ScreeningJob& job, std::size_t layouts, std::size_t accelerations, std::size_t finished) {
  const Settings& settings = job.settings;
  const auto threads = static_cast<std::size_t>(thread_count(settings.screening.threads));
  const std::string& norm = settings.screening.norm;
  return fmt::format("{} x {} = {}, engine {}, scheduler {}, {}{}\n{}{}", counted(layouts, "layout"),
                     counted(accelerations, "acceleration"), counted(layouts * accelerations, "world"),
                     engine_text(settings), find_setting("Screening", "Scheduler")->get(settings, ""),
                     counted(threads, "thread"), finished > 0 ? fmt::format(", {} finished before", finished) : "",
                     friction_text(settings), norm.empty() ? "" : norm_text(norm));
}

}  // namespace

void TerminalObserver::started(const RunProgress& progress) {
  warn_of_same_names(job_.layout_paths);
  warn_of_same_names(job_.acceleration_paths);
  if (!job_.quiet) {
    if (job_.existing == ExistingResults::resume && progress.resumed == 0)
      print_to(stderr, "{}: nothing is finished that could be resumed, all worlds are to be run\n", job_.results_path);
    print_to(stderr, "{}",
             start_text(job_, description_.layout_names.size(), description_.accelerations.size(), progress.resumed));
  }
  display_.emplace(progress, job_.quiet);
  ticker_ = std::make_unique<Ticker>(std::chrono::milliseconds(250), [this] {
    try {
      tick();
    } catch (const std::bad_alloc&) {
      // The next tick may find room.
    }
  });
}

void TerminalObserver::warned(const Error& warning) {
  if (++warning_count_ <= kWarningsShown) note("warning: " + warning.message());
}

void TerminalObserver::layout_begins(const LayoutRecord& layout) {
  if (!job_.json || layout.layout == nullptr) return;
  const std::vector<Box>& boxes = layout.layout->boxes;
  if (std::all_of(boxes.begin(), boxes.end(), [](const Box& box) { return box.name.empty(); })) return;
  std::vector<std::string>& names = box_names_[layout.index];
  names.clear();  // an earlier run may have begun the layout
  for (const Box& box : boxes) names.push_back(box.name);
}

void TerminalObserver::layout_finished(const LayoutRecord& layout) {
  if (job_.json) write_unless(stop_.drop, stdout, layout_json(layout, analyses_of(job_.settings)) + "\n");
}

void TerminalObserver::world_finished(const WorldRecord& world, std::size_t index) {
  const std::string& layout = description_.layout_names[world.row.layout];
  const Acceleration& acceleration = description_.accelerations[world.row.acceleration];
  const Status status = world.row.status;
  if (display_) {
    if (has(status, Status::bad_layout) && world.row.acceleration == 0) note(world.row.message);
    if (has(status, Status::too_large)) note(world.row.message);
    if (has(status, Status::non_finite))
      note(printable(fmt::format("{} under {}: {}", layout, acceleration.name, world.row.message)));
  }
  if (!job_.json) return;
  const WorldRow& row = world.row;
  const double saved = time_saved(row.status, row.stop_reason, row.end_time, planned_end(acceleration, job_.settings));
  box_names_.erase(box_names_.begin(), box_names_.lower_bound(row.layout));  // worlds come layout by layout
  const auto named = box_names_.find(row.layout);
  const std::span<const std::string> names =
      named == box_names_.end() ? std::span<const std::string>() : std::span<const std::string>(named->second);
  const std::string line =
      world_json(world, layout, acceleration.name, index, description_.thresholds, saved, names) + "\n";
  write_unless(stop_.drop, stdout, line);
}

void TerminalObserver::ended() {
  ticker_.reset();
  display_.reset();
  if (warning_count_ > kWarningsShown)
    print_to(stderr, "and {} more warnings; `holdfast check` prints all\n", warning_count_ - kWarningsShown);
}

void TerminalObserver::note(std::string text) {
  const std::scoped_lock lock(notes_mutex_);
  notes_.push_back(std::move(text));
}

void TerminalObserver::tick() {
  std::vector<std::string> notes;
  {
    const std::scoped_lock lock(notes_mutex_);
    notes.swap(notes_);
  }
  for (const std::string& note : notes) display_->line.note(note);
  if (stop_.no_more && !display_->stop_shown) {
    display_->line.note(stop_.drop ? "stopping"
                                   : "stopping: finishing the worlds in flight; press Ctrl-C again to drop them");
    display_->stop_shown = true;
  }
  display_->line.show();
}

}  // namespace holdfast::internal
