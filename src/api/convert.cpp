#include "api/convert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "analyses/damage/damage.hpp"
#include "analyses/replicas/replica_verdict.hpp"
#include "analyses/walls/wall_forces.hpp"
#include "api/given_parts.hpp"
#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/model/acceleration_check.hpp"
#include "core/model/layout_check.hpp"
#include "core/model/setting_kinds.hpp"

namespace holdfast::internal {

namespace {

Vec3 corner(const std::array<double, 3>& numbers, holdfast::LengthUnit unit) {
  return {metres(numbers[0], unit), metres(numbers[1], unit), metres(numbers[2], unit)};
}

/// Adds a box where it will be: a temporary one would have to be moved, with its texts.
Box& add_box(Layout& layout, const std::array<double, 3>& corner_min, const std::array<double, 3>& corner_max,
             int material, holdfast::LengthUnit unit) {
  Box& box = layout.boxes.emplace_back();
  box.corner_min = corner(corner_min, unit);
  box.corner_max = corner(corner_max, unit);
  if (material != 0) box.material = material;
  return box;
}

/// True when the layout leaves the container, and would not if its numbers were centimetres.
bool looks_like_centimetres(const Layout& layout, const Settings& settings) {
  Vec3 largest = Vec3::Zero();
  for (const Box& box : layout.boxes) largest = largest.cwiseMax(box.corner_max);
  const Vec3 size = container_of(settings, layout).size;
  return (largest.array() > 10.0 * size.array()).any() &&
         (largest.array() / 100.0 <= size.array() + kLayoutTolerance).all();
}

/// An error when there are no boxes, as in a file, or more than a layout may have.
std::vector<Error> check_count(std::size_t boxes, const std::string& name) {
  if (boxes == 0) return {{.file = name, .what = "has no boxes", .accepted = "a layout has at least one"}};
  if (boxes <= kMostBoxes) return {};
  return {{.file = name,
           .what = "too many boxes",
           .value = std::to_string(boxes),
           .accepted = "at most " + std::to_string(kMostBoxes)}};
}

/// The number as an int; nothing when it is none.
std::optional<int> whole_number(double number) {
  const bool fits = number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max();
  if (!fits || number != std::floor(number)) return std::nullopt;
  return static_cast<int>(number);
}

/// @param box from 0
void add_bad_material(ErrorList& errors, std::size_t box, std::string value) {
  if (errors.full()) return errors.count_more();
  errors.add({.what = "the material of box " + std::to_string(box + 1) + " is not an id",
              .value = std::move(value),
              .accepted = "a whole number from 0",
              .box = static_cast<long>(box) + 1,
              .box_number = kMaterialNumber});
}

/// What is wrong with a layout beyond its geometry.
std::vector<Error> check_numbers(const Layout& layout, holdfast::LengthUnit unit, const Settings& settings) {
  ErrorList errors(layout.name);
  for (std::size_t i = 0; i < layout.boxes.size(); ++i)
    if (layout.boxes[i].material.is_number() && layout.boxes[i].material.id() < 0)
      add_bad_material(errors, i, layout.boxes[i].material.text());
  if (unit == holdfast::LengthUnit::metre && looks_like_centimetres(layout, settings))
    errors.add({.what = "the numbers seem to be centimetres, and metres are expected",
                .accepted = "set the unit to centimetres for numbers as in layout files"});
  return errors.take();
}

/// The layout, or without its boxes and with what is wrong with it.
/// @param errors found so far
/// @param all    gets all errors
ReadLayout checked(ReadLayout read, std::vector<Error> errors, holdfast::LengthUnit unit, const Settings& settings,
                   std::vector<Error>& all) {
  if (errors.empty()) errors = check_numbers(read.layout, unit, settings);
  if (errors.empty()) errors = check_layout(read.layout, settings, read.layout.name, read.warnings);
  if (errors.empty()) return read;
  read.layout.boxes.clear();
  read.error = summary_of(errors);
  all.insert(all.end(), errors.begin(), errors.end());
  return read;
}

Vec3 vector_of(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

template <class To, class From>
std::vector<To> copied(const std::vector<From>& from, To (*convert)(const From&)) {
  std::vector<To> to;
  to.reserve(from.size());
  for (const From& entry : from) to.push_back(convert(entry));
  return to;
}

std::array<float, 3> array_of(const Float3& v) { return {v.x, v.y, v.z}; }
std::array<float, 4> array_of(const Float4& q) { return {q.w, q.x, q.y, q.z}; }

holdfast::BoxOutcome outcome_of(const EndTable& end, std::size_t i, const Thresholds& thresholds) {
  holdfast::BoxOutcome box;
  visit_box_values(end, i, judge_box(end, i, by_run(thresholds)),
                   [&](const OutcomeField&, const auto& value, auto member) {
                     if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Float3>)
                       box.*member = array_of(value);
                     else
                       box.*member = value;
                   });
  return box;
}

holdfast::ReplicaOutcome public_replicas(const ReplicaOutcome& found, bool keep_boxes) {
  return {.verdict = found.verdict,
          .count = found.count,
          .failed = found.failed,
          .share = found.share,
          .wilson_low = found.wilson_low,
          .wilson_high = found.wilson_high,
          .cpu_seconds = found.cpu_seconds,
          .box_share = keep_boxes ? found.box_share : std::vector<float>()};
}

holdfast::DamageOutcome public_damage(const WorldDamage& found, bool keep_boxes) {
  holdfast::DamageOutcome damage;
  damage.known = true;
  damage.boxes_beyond = found.boxes_beyond;
  const auto largest = [](const std::vector<float>& values) {
    return values.empty() ? 0.0F : *std::max_element(values.begin(), values.end());
  };
  damage.peak_acceleration = largest(found.peak_acceleration);
  damage.velocity_change = largest(found.velocity_change);
  if (!keep_boxes) return damage;
  damage.box_peak_acceleration = found.peak_acceleration;
  damage.box_velocity_change = found.velocity_change;
  damage.box_beyond = found.beyond;
  return damage;
}

holdfast::WallForce wall_of(const WallForces& walls, std::size_t side) {
  const auto array = [](const Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  return {.peak_force = walls.peak_force.at(side),
          .peak_time = walls.peak_time.at(side),
          .peak_point = array(walls.peak_point.at(side)),
          .lasting_force = walls.lasting_force.at(side),
          .limit = walls.limit.at(side),
          .impulse = array(walls.impulse.at(side))};
}

}  // namespace

holdfast::Problem problem_of(const Error& error) {
  return {.file = error.file,
          .line = error.line,
          .column = error.column,
          .what = error.what,
          .value = error.value,
          .accepted = error.accepted,
          .message = error.message(),
          .box = error.box - 1,
          .box_column = static_cast<int>(error.box_number) - 1};
}

holdfast::Error exception_of(const std::vector<Error>& errors) {
  return holdfast::Error(copied<holdfast::Problem, Error>(errors, problem_of));
}

ReadLayout read_layout(const holdfast::Layout& layout, const std::string& name, holdfast::LengthUnit unit,
                       const Settings& settings, std::vector<Error>& all) {
  unit = layout.unit.value_or(unit);
  ReadLayout read;
  read.layout.name = name;
  std::vector<Error> errors = check_count(layout.boxes.size(), name);
  if (errors.empty()) {
    ErrorList wrong_parts(name);
    if (layout.container) read.layout.container = shape_of(*layout.container, unit, settings, wrong_parts);
    read.layout.boxes.reserve(layout.boxes.size());
    for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
      const holdfast::Box& box = layout.boxes[i];
      Box& read_box = add_box(read.layout, box.corner_min, box.corner_max, box.material, unit);
      if (has_parts(box)) take_parts(box, i, unit, read_box, wrong_parts);
    }
    errors = wrong_parts.take();
  }
  return checked(std::move(read), std::move(errors), unit, settings, all);
}

ReadLayout read_layout(const holdfast::LayoutView& layout, const std::string& name, holdfast::LengthUnit unit,
                       const Settings& settings, std::vector<Error>& all) {
  if (layout.layout != nullptr) return read_layout(*layout.layout, name, unit, settings, all);
  unit = layout.unit.value_or(unit);
  ReadLayout read;
  read.layout.name = name;
  const std::span<const double> numbers = layout.numbers;
  const std::size_t count = numbers.size() / kNumbersPerBox;
  std::vector<Error> errors;
  if (const holdfast::Problem* const problem = layout.problem)
    errors = {{.file = name, .what = problem->what, .value = problem->value, .accepted = problem->accepted}};
  else if (numbers.size() % kNumbersPerBox != 0)
    errors = {{.file = name,
               .what = "the layout is no whole number of boxes",
               .value = std::to_string(numbers.size()) + " numbers",
               .accepted = "seven numbers per box: two corners and a material"}};
  else
    errors = check_count(count, name);
  if (errors.empty()) {
    ErrorList wrong(name);
    if (!layout.container.empty()) read.layout.container = shape_of_type(layout.container, wrong);
    check_counts(layout, count, wrong);
    const bool more = has_parts(layout) && wrong.empty();
    read.layout.boxes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double* const row = &numbers[i * kNumbersPerBox];
      const std::optional<int> material = whole_number(row[6]);
      if (!material) add_bad_material(wrong, i, rounded_text(row[6]));
      Box& read_box =
          add_box(read.layout, {row[0], row[1], row[2]}, {row[3], row[4], row[5]}, material.value_or(0), unit);
      if (more) take_parts(layout, i, read_box, wrong);
    }
    errors = wrong.take();
  }
  return checked(std::move(read), std::move(errors), unit, settings, all);
}

Result<Acceleration> read_acceleration(const holdfast::Acceleration& acceleration) {
  Acceleration read;
  read.name = acceleration.name;
  read.purpose = acceleration.purpose;
  for (std::size_t i = 0; i < acceleration.segments.size(); ++i) {
    const holdfast::Segment& given = acceleration.segments[i];
    const Segment segment{given.start, given.duration, vector_of(given.acceleration)};
    std::optional<Error> error;
    if (const auto fault = check_segment(segment))
      error = fault->error;
    else
      error = append_segment(read.segments, segment);
    if (!error) continue;
    error->file = acceleration.name;
    error->what = "segment " + std::to_string(i + 1) + ": " + error->what;
    return *error;
  }
  if (read.segments.empty()) return Error{.file = acceleration.name, .what = "the acceleration has no segments"};
  return read;
}

holdfast::Box public_box(const Box& box) {
  const auto numbers = [](const Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  holdfast::Box converted{.corner_min = numbers(box.corner_min),
                          .corner_max = numbers(box.corner_max),
                          .material = box.material.is_number() ? box.material.id() : 0,
                          .name = box.name,
                          .mass = box.mass,
                          .mat = box.mat,
                          .fixed = box.fixed,
                          .order = box.order,
                          .bearing_limit = box.bearing_limit};
  if (!box.material.is_number()) converted.material_name = box.material.text();
  if (box.centre_of_mass) converted.centre_of_mass = numbers(*box.centre_of_mass);
  return converted;
}

holdfast::Container public_container(const GivenContainer& container) {
  holdfast::Container converted{
      .type = container.type, .open_sides = container.open_sides, .bed_height = container.bed_height};
  if (container.size) converted.size = std::array{container.size->x(), container.size->y(), container.size->z()};
  if (!container.drop_sides) return converted;
  converted.drop_sides.emplace();
  for (const DropSide& drop : *container.drop_sides) converted.drop_sides->push_back({drop.side, drop.height});
  return converted;
}

holdfast::Layout public_layout(const Layout& layout, holdfast::LengthUnit unit) {
  holdfast::Layout converted{.name = layout.name, .boxes = {}};
  const auto number = [&](double length) {
    return unit == holdfast::LengthUnit::centimetre ? setting_kinds::centimetres(length) : length;
  };
  const auto numbers = [&](const Vec3& v) { return std::array{number(v.x()), number(v.y()), number(v.z())}; };
  converted.boxes.reserve(layout.boxes.size());
  for (const Box& box : layout.boxes) {
    holdfast::Box& to = converted.boxes.emplace_back(public_box(box));
    to.corner_min = numbers(box.corner_min);
    to.corner_max = numbers(box.corner_max);
    if (box.centre_of_mass) to.centre_of_mass = numbers(*box.centre_of_mass);
  }
  if (!layout.container) return converted;
  const ContainerShape& shape = *layout.container;
  std::vector<holdfast::DropSide> drops;
  for (const DropSide& drop : shape.drop_sides) drops.push_back({drop.side, number(drop.height)});
  converted.container = {.type = shape.type,
                         .size = numbers(shape.size),
                         .open_sides = shape.open_sides,
                         .drop_sides = std::move(drops),
                         .bed_height = number(shape.bed_height)};
  return converted;
}

holdfast::Acceleration public_acceleration(const Acceleration& acceleration) {
  holdfast::Acceleration converted{.name = acceleration.name, .segments = {}, .purpose = acceleration.purpose};
  for (const Segment& segment : acceleration.segments) {
    const Vec3& a = segment.acceleration;
    converted.segments.push_back({segment.start, segment.duration, {a.x(), a.y(), a.z()}});
  }
  return converted;
}

void fill_world(const WorldRecord& record, const Thresholds& thresholds, bool keep_boxes,
                holdfast::WorldOutcome& world) {
  const bool was_run = record.row.stop_reason != StopReason::not_run;
  const WorldVerdict verdict = judge_world(record.row, record.end, by_run(thresholds));
  visit_world_values(record.row, verdict, [&](const OutcomeField& field, const auto& value, auto member) {
    using Member = std::decay_t<decltype(world.*member)>;
    if constexpr (std::is_convertible_v<decltype(value), Member>)
      world.*member = was_run || field.scope != FieldScope::derived ? value : Member();
    else
      world.*member = static_cast<Member>(value);
  });
  world.verdict = verdict.verdict;
  world.walls.clear();
  if (const WallForces* walls = record.found.get<WallForces>(); walls != nullptr && walls->known())
    for (std::size_t side = 0; side < kPushedCount; ++side) world.walls.push_back(wall_of(*walls, side));
  world.box_outcomes.clear();
  for (std::size_t i = 0; keep_boxes && i < record.end.end_displacement.size(); ++i)
    world.box_outcomes.push_back(outcome_of(record.end, i, thresholds));
  world.replicas = public_replicas(record.found.value<ReplicaOutcome>(), keep_boxes);
  const WorldDamage* damage = record.found.get<WorldDamage>();
  world.damage = damage != nullptr && damage->known() ? public_damage(*damage, keep_boxes) : holdfast::DamageOutcome();
}

void mark_cancelled(holdfast::WorldOutcome& world) {
  if (world.stop_reason == holdfast::StopReason::not_run && world.status == status::ok) world.message = "cancelled";
}

void move_series(internal::Series&& series, holdfast::Series& to) {
  to.time = std::move(series.time);
  to.displacement = copied<std::array<float, 3>, Float3>(series.displacement, array_of);
  to.orientation = copied<std::array<float, 4>, Float4>(series.orientation, array_of);
  to.angular_velocity = copied<std::array<float, 3>, Float3>(series.angular_velocity, array_of);
}

}  // namespace holdfast::internal
