#include "io/input/acceleration_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/model/acceleration_check.hpp"
#include "core/model/push_direction.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

constexpr const char* kAccelerationLine = "initial-time duration ax ay az";
constexpr std::array kAccelerationNames{"the initial time", "the duration", "ax", "ay", "az"};

/// Largest accelerations along the floor that are probably meant in g, in m/s²: norms for cargo ask for 0.2 to 1 g on
/// the road and at sea, and a load that stands so few m/s² has shown nothing. 1 m/s² itself is a gentle push that
/// people try.
constexpr double kLeastInG = 0.05;
constexpr double kMostInG = 0.99;

/// A mean of z as near to gravity is gravity, m/s².
constexpr double kNearGravity = 0.3;

/// Whether a line states the unit of the accelerations, and not a segment.
bool is_unit_line(const std::vector<Field>& fields) { return fields[0].text == "unit"; }

/// The unit of a line that states one, in m/s², or nothing if it is none.
std::optional<double> parse_unit(long line, const std::vector<Field>& fields, ErrorList& errors) {
  const std::string_view unit = fields.size() == 2 ? fields[1].text : "";
  if (unit == "g") return kStandardGravity;
  if (unit == "m/s2" || unit == "m/s²") return 1.0;
  errors.add({.line = line,
              .column = fields.back().column,
              .what = "no unit of acceleration",
              .value = shown(fields.back().text),
              .accepted = "unit g, or unit m/s2"});
  return std::nullopt;
}

/// The segment of a line, or nothing if its numbers are not valid.
/// @param unit of its acceleration, m/s²
std::optional<Segment> parse_segment(long line, const std::vector<Field>& fields, double unit, ErrorList& errors) {
  const auto refuse = [&](std::size_t i, std::string what, std::string accepted) {
    errors.add({.line = line,
                .column = fields[i].column,
                .what = std::move(what),
                .value = shown(fields[i].text),
                .accepted = std::move(accepted)});
    return std::nullopt;
  };
  if (fields.size() != kAccelerationColumns) {
    errors.add({.line = line,
                .column = fields[0].column,
                .what = fields.size() < kAccelerationColumns ? "too few columns" : "too many columns",
                .value = std::to_string(fields.size()),
                .accepted = std::string("the five columns are ") + kAccelerationLine});
    return std::nullopt;
  }
  std::array<double, kAccelerationColumns> numbers{};
  bool good = true;
  for (std::size_t i = 0; i < kAccelerationColumns; ++i) {
    const std::optional<double> number = parse_number(fields[i].text);
    good = good && number;
    if (number)
      numbers[i] = *number;
    else
      refuse(i, std::string(kAccelerationNames[i]) + " is not a number",
             i < 2 ? "a finite number of s" : "a finite number of m/s²");
  }
  if (!good) return std::nullopt;
  const Segment segment{numbers[0], numbers[1], unit * Vec3(numbers[2], numbers[3], numbers[4]), line};
  if (const auto fault = check_segment(segment)) return refuse(fault->column, fault->error.what, fault->error.accepted);
  return segment;
}

/// Warns of accelerations that are so small that they may be meant in g.
void warn_of_unit(const TextFile& file, const Acceleration& acceleration, std::vector<Error>& warnings) {
  double largest = 0.0;
  for (const Segment& segment : acceleration.segments)
    largest = std::max(largest, segment.acceleration.head<2>().norm());
  if (largest < kLeastInG || largest > kMostInG) return;
  warnings.push_back({.file = file.path,
                      .what = "the values are in m/s², and the largest along the floor is small",
                      .value = rounded_text(largest) + " m/s²",
                      .accepted = "if they are in g: a first line 'unit g'; 'unit m/s2' says that they are meant"});
}

/// Warns of a mean of z that is that of gravity, as accelerometers record it: the load has its weight anyway.
void warn_of_gravity(const TextFile& file, const Acceleration& acceleration, std::vector<Error>& warnings) {
  double duration = 0.0;
  double velocity = 0.0;
  for (const Segment& segment : acceleration.segments) {
    duration += segment.duration;
    velocity += segment.duration * segment.acceleration.z();
  }
  if (!(std::abs(std::abs(velocity) - kStandardGravity * duration) < kNearGravity * duration)) return;
  warnings.push_back({.file = file.path,
                      .what = "z seems to have gravity in it, which loads have anyway",
                      .value = "mean " + rounded_text(velocity / duration) + " m/s²",
                      .accepted = "0 on a level road; take 9.81 m/s² off z, with its sign"});
}

}  // namespace

Result<Acceleration> parse_acceleration(const TextFile& file, std::vector<Error>& warnings) {
  Acceleration acceleration;
  acceleration.name = file.name;
  acceleration.sha256 = file.sha256;
  ErrorList errors(file.path);
  LineReader lines(file.text);
  std::vector<Field> fields;
  std::optional<double> unit;
  bool is_first = true;
  while (lines.next()) {
    split_fields(lines.line(), fields);
    if (fields.empty()) continue;
    if (std::exchange(is_first, false) && is_unit_line(fields)) {
      unit = parse_unit(lines.number(), fields, errors);
      continue;
    }
    const std::optional<Segment> segment = parse_segment(lines.number(), fields, unit.value_or(1.0), errors);
    auto disagreement = segment ? append_segment(acceleration.segments, *segment) : std::nullopt;
    if (!disagreement) continue;
    disagreement->line = lines.number();
    disagreement->column = fields[0].column;
    errors.add(std::move(*disagreement));
  }
  if (errors.empty() && acceleration.segments.empty())
    errors.add({.what = trimmed(file.text).empty() ? "is empty" : "has no segments",
                .accepted = std::string("an acceleration has one line per segment: ") + kAccelerationLine});
  if (!errors.empty()) return errors.take();
  if (!unit) warn_of_unit(file, acceleration, warnings);
  warn_of_gravity(file, acceleration, warnings);
  return acceleration;
}

}  // namespace holdfast::internal
