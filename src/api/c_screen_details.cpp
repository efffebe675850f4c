#include <algorithm>

#include "api/c_screen.hpp"

using namespace holdfast::internal;

// What the last call of a screen found: messages, problems, boxes. None of this changes what it is about, so that the
// message of that call stays.

namespace {

/// Reads of the screen what the last call left; nothing when there is no such screen, or another thread uses it.
template <class Result, class Read>
Result read_of(const holdfast_screen* screen, Result otherwise, Read&& read) noexcept {
  const auto object = Handles<holdfast_screen, CScreen>::all().find(screen);
  if (object == nullptr) return otherwise;
  const std::unique_lock lock(object->in_use, std::try_to_lock);
  return lock ? read(*object) : otherwise;
}

/// An outcome of the last call.
const holdfast::WorldOutcome& outcome_at(const CScreen& object, size_t index) {
  if (index >= object.last->size())
    throw BadArgument{"index is " + std::to_string(index) + ", and the last call gave " +
                      std::to_string(object.last->size()) + " outcomes"};
  return (*object.last)[index];
}

}  // namespace

const char* holdfast_screen_message(const holdfast_screen* screen) { return message_of<CScreen>(screen); }

const char* holdfast_screen_outcome_message(const holdfast_screen* screen, size_t index) {
  return read_of(screen, "", [&](const CScreen& object) {
    return index < object.last->size() ? (*object.last)[index].message.c_str() : "";
  });
}

size_t holdfast_screen_acceleration_count(const holdfast_screen* screen) {
  return read_of(screen, std::size_t{0}, [](const CScreen& object) {
    return object.screen ? object.screen->accelerations().size() : std::size_t{0};
  });
}

size_t holdfast_screen_error_count(const holdfast_screen* screen) {
  return read_of(screen, std::size_t{0}, [](const CScreen& object) { return object.problems.size(); });
}

int holdfast_screen_error(const holdfast_screen* screen, size_t index, holdfast_problem* problem) {
  const auto object = Handles<holdfast_screen, CScreen>::all().find(screen);
  if (object == nullptr) return HOLDFAST_BAD_HANDLE;
  const std::unique_lock lock(object->in_use, std::try_to_lock);
  if (!lock) return HOLDFAST_IN_USE;
  if (problem == nullptr || index >= object->problems.size()) return HOLDFAST_BAD_ARGUMENT;
  const holdfast::Problem& found = object->problems[index];
  try {
    FilledEntries(problem, "problem")
        .put(0, {.file = found.file.c_str(),
                 .line = found.line,
                 .column = found.column,
                 .what = found.what.c_str(),
                 .value = found.value.c_str(),
                 .accepted = found.accepted.c_str(),
                 .message = found.message.c_str(),
                 .layout = found.layout,
                 .box = found.box,
                 .box_column = found.box_column});
  } catch (const BadArgument&) {
    return HOLDFAST_BAD_ARGUMENT;
  }
  return HOLDFAST_OK;
}

int holdfast_screen_replicas(holdfast_screen* screen, size_t index, holdfast_replicas* replicas) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const holdfast::ReplicaOutcome& found = outcome_at(object, index).replicas;
    FilledEntries(replicas, "replicas")
        .put(0, {.verdict = static_cast<int32_t>(found.verdict),
                 .count = found.count,
                 .failed = found.failed,
                 .share = found.share,
                 .wilson_low = found.wilson_low,
                 .wilson_high = found.wilson_high,
                 .cpu_seconds = found.cpu_seconds});
    return HOLDFAST_OK;
  });
}

int holdfast_screen_damage(holdfast_screen* screen, size_t index, holdfast_damage* damage) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const holdfast::DamageOutcome& found = outcome_at(object, index).damage;
    const FilledEntries filled(damage, "damage");
    if (!found.known)
      throw BadArgument{"the world has no damage: the settings do not ask for it, or it was not accelerated"};
    filled.put(0, {.boxes_beyond = found.boxes_beyond,
                   .peak_acceleration = found.peak_acceleration,
                   .velocity_change = found.velocity_change});
    return HOLDFAST_OK;
  });
}

int holdfast_screen_number(holdfast_screen* screen, size_t index, const char* name, double* number) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const holdfast::WorldOutcome& world = outcome_at(object, index);
    required(name, "name");
    required(number, "number");
    const std::vector<holdfast::AnalysisNumber> numbers = holdfast::analysis_numbers();
    const auto found = std::find_if(numbers.begin(), numbers.end(),
                                    [&](const holdfast::AnalysisNumber& known) { return known.name == name; });
    if (found == numbers.end()) throw BadArgument{"no analysis has the number " + std::string(name)};
    *number = world.numbers.at(static_cast<std::size_t>(found - numbers.begin()));
    return HOLDFAST_OK;
  });
}

int holdfast_screen_boxes(holdfast_screen* screen, size_t index, holdfast_box_outcome* boxes, size_t capacity) {
  return call_object<CScreen>(screen, [&](CScreen& object) {
    const holdfast::WorldOutcome& world = outcome_at(object, index);
    if (world.box_outcomes.size() < world.boxes) throw BadArgument{"the screen was made without keep_boxes"};
    require_room(capacity, world.box_outcomes.size(), "boxes");
    for (std::size_t i = 0; i < world.box_outcomes.size(); ++i) {
      const holdfast::BoxOutcome& from = world.box_outcomes[i];
      holdfast_box_outcome copy = {};
      HOLDFAST_BOX_FIELDS(HOLDFAST_C_COPY)
      HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_C_COPY)
      FilledEntries(boxes, "boxes").put(i, copy);
    }
    return HOLDFAST_OK;
  });
}
