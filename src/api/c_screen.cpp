#include "api/c_screen.hpp"

#include <algorithm>
#include <limits>

#include "api/c_settings.hpp"
#include "api/convert.hpp"
#include "api/screen_closer.hpp"

using namespace holdfast::internal;

namespace holdfast::internal {

namespace {

holdfast::ScreenOptions screen_options(const std::vector<holdfast::Setting>& settings,
                                       const holdfast_screen_options* given) {
  const auto options = options_of(given, "options");
  holdfast::ScreenOptions all{.settings = settings};
  if (options.norm != nullptr) all.norm = options.norm;
  if (options.engine != nullptr) all.engine = options.engine;
  if (options.accuracy != nullptr) all.accuracy = options.accuracy;
  if (options.scheduler != nullptr) all.scheduler = options.scheduler;
  if (options.threads != 0) all.threads = options.threads;
  all.unit = unit_of(options.unit);
  if (flag(options.mark_bad_layouts, "options.mark_bad_layouts")) all.bad_layouts = holdfast::BadLayouts::mark;
  all.keep_boxes = flag(options.keep_boxes, "options.keep_boxes");
  all.most_in_flight = options.most_in_flight;
  return all;
}

holdfast::RecordOptions record_options(const holdfast_record_options* given) {
  const auto options = options_of(given, "options");
  return {.series = !flag(options.no_series, "options.no_series"),
          .resume = flag(options.resume, "options.resume"),
          .overwrite = flag(options.overwrite, "options.overwrite"),
          .command_line = options.command_line == nullptr ? "" : options.command_line};
}

/// What the screen says of the layouts of a call that it could use.
void keep_problems(CScreen& object) {
  object.problems.assign(object.made().problems().begin(), object.made().problems().end());
}

/// What a call returns that may have been cancelled.
int ended(CScreen& object, bool cancelled) {
  if (cancelled) object.message = "cancelled";
  return cancelled ? HOLDFAST_CANCELLED : HOLDFAST_OK;
}

int submit(CScreen& object, const holdfast::LayoutView& layout, std::uint64_t* ticket) {
  object.accelerations();
  const std::optional<std::uint64_t> given = object.made().submit(layout);
  if (!given) return HOLDFAST_FULL;
  keep_problems(object);
  if (ticket != nullptr) *ticket = *given;
  return HOLDFAST_OK;
}

}  // namespace

std::size_t CScreen::accelerations() {
  const std::size_t count = made().accelerations().size();
  if (count == 0) throw BadArgument{"the screen has no acceleration: holdfast_screen_add_acceleration comes before"};
  return count;
}

void copy_outcomes(std::span<const holdfast::WorldOutcome> worlds, holdfast_outcome* outcomes) {
  if (worlds.empty()) return;
  const FilledEntries entries(outcomes, "outcomes");
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const holdfast::WorldOutcome& from = worlds[i];
    holdfast_outcome copy = {};
    HOLDFAST_WORLD_FIELDS(HOLDFAST_C_COPY)
    entries.put(i, copy);
  }
}

}  // namespace holdfast::internal

int holdfast_screen_new(const holdfast_settings* settings, const holdfast_screen_options* options,
                        holdfast_screen** screen) {
  if (screen != nullptr) *screen = nullptr;
  return with_settings(settings, [&](const std::vector<holdfast::Setting>& given) {
    return make_object<CScreen>(screen, [&](CScreen& object) {
      object.screen.emplace(screen_options(given, options));
      return HOLDFAST_OK;
    });
  });
}

void holdfast_screen_free(holdfast_screen* screen) {
  const auto object = Handles<holdfast_screen, CScreen>::all().remove(screen);
  if (object != nullptr && object->screen) ScreenCloser::close(*object->screen);
}

int holdfast_screen_add_acceleration(holdfast_screen* screen, const char* name, const double* segments,
                                     size_t segment_count) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const std::string own_name = "acceleration " + std::to_string(object.made().accelerations().size());
    object.made().add_acceleration(acceleration_of(name == nullptr ? own_name : name, segments, segment_count));
    return HOLDFAST_OK;
  });
}

int holdfast_screen_evaluate(holdfast_screen* screen, const holdfast_layouts* layouts, holdfast_outcome* outcomes,
                             size_t capacity) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const std::vector<holdfast::LayoutView> given = layouts_of(layouts);
    const std::size_t count = given.size();
    const std::size_t accelerations = object.accelerations();
    if (count > std::numeric_limits<std::size_t>::max() / accelerations)
      throw BadArgument{"there are too many layouts"};
    require_room(capacity, count * accelerations, "outcomes");
    if (count > 0) FilledEntries(outcomes, "outcomes");
    object.last = &object.evaluated;
    object.evaluated.clear();
    object.made().evaluate(given, object.evaluated);
    keep_problems(object);
    copy_outcomes(object.evaluated, outcomes);
    return ended(object, std::any_of(object.evaluated.begin(), object.evaluated.end(), [](const auto& world) {
                   return world.stop_reason == holdfast::StopReason::not_run && world.status == holdfast::status::ok;
                 }));
  });
}

int holdfast_screen_holds(holdfast_screen* screen, const holdfast_layouts* layouts, uint8_t* holds, size_t capacity) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const std::vector<holdfast::LayoutView> given = layouts_of(layouts);
    object.accelerations();
    require_room(capacity, given.size(), "holds");
    if (!given.empty()) required(holds, "holds");
    const std::vector<bool> found = object.made().holds(given);
    keep_problems(object);
    std::copy(found.begin(), found.end(), holds);
    return ended(object, object.made().cancelled());
  });
}

int holdfast_screen_margins(holdfast_screen* screen, const holdfast_layouts* layouts, holdfast_margins* margins,
                            size_t capacity) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const std::vector<holdfast::LayoutView> given = layouts_of(layouts);
    require_room(capacity, given.size(), "margins");
    if (!given.empty()) FilledEntries(margins, "margins");
    const std::vector<holdfast::LayoutMargins> found = object.made().margins(given);
    keep_problems(object);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const holdfast::LayoutMargins& layout = found[i];
      holdfast_margins copy{.trials = layout.trials, .cpu_seconds = layout.cpu_seconds};
      std::copy(layout.margin.begin(), layout.margin.end(), copy.margin);
      std::copy(layout.critical_box.begin(), layout.critical_box.end(), copy.critical_box);
      std::copy(layout.margin_within_limits.begin(), layout.margin_within_limits.end(), copy.margin_within_limits);
      std::copy(layout.critical_box_within_limits.begin(), layout.critical_box_within_limits.end(),
                copy.critical_box_within_limits);
      FilledEntries(margins, "margins").put(i, copy);
    }
    return ended(object, object.made().cancelled());
  });
}

int holdfast_screen_record(holdfast_screen* screen, const holdfast_layouts* layouts, const char* path,
                           const holdfast_record_options* options) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const std::vector<holdfast::LayoutView> given = layouts_of(layouts);
    object.accelerations();
    const bool complete = object.made().record(given, required(path, "path"), record_options(options));
    keep_problems(object);
    return ended(object, !complete);
  });
}

int holdfast_screen_submit(holdfast_screen* screen, const double* boxes, size_t box_count, uint64_t* ticket) {
  return call_object<CScreen>(screen,
                              [&](CScreen& object) { return submit(object, layout_of("", boxes, box_count), ticket); });
}

int holdfast_screen_submit_layout(holdfast_screen* screen, const holdfast_layouts* layout, uint64_t* ticket) {
  return call_object<CScreen>(screen,
                              [&](CScreen& object) { return submit(object, only_layout_of(layout, ""), ticket); });
}

int holdfast_screen_poll(holdfast_screen* screen, double seconds, int in_order, uint64_t* ticket,
                         holdfast_outcome* outcomes, size_t capacity) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const auto order =
        flag(in_order, "in_order") ? holdfast::PollOrder::as_submitted : holdfast::PollOrder::as_finished;
    require_room(capacity, object.accelerations(), "outcomes");
    FilledEntries(outcomes, "outcomes");
    if (object.made().in_flight() == 0) return HOLDFAST_NONE;
    if (!object.made().poll(object.polled, seconds, order)) return HOLDFAST_NOT_YET;
    object.last = &object.polled.worlds;
    if (ticket != nullptr) *ticket = object.polled.ticket;
    copy_outcomes(object.polled.worlds, outcomes);
    return HOLDFAST_OK;
  });
}

int holdfast_screen_cancel(holdfast_screen* screen) {
  const auto object = Handles<holdfast_screen, CScreen>::all().find(screen);
  if (object == nullptr) return HOLDFAST_BAD_HANDLE;
  if (object->screen) object->screen->cancel();
  return HOLDFAST_OK;
}
