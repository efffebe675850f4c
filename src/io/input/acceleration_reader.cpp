#include "io/input/acceleration_reader.hpp"

#include <array>
#include <optional>

#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/model/acceleration_check.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

constexpr const char* kAccelerationLine = "initial-time duration ax ay az";
constexpr std::array kAccelerationNames{"the initial time", "the duration", "ax", "ay", "az"};

/// The segment of a line, or nothing if its numbers are not valid.
std::optional<Segment> parse_segment(long line, const std::vector<Field>& fields, ErrorList& errors) {
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
  const Segment segment{numbers[0], numbers[1], {numbers[2], numbers[3], numbers[4]}, line};
  if (const auto fault = check_segment(segment)) return refuse(fault->column, fault->error.what, fault->error.accepted);
  return segment;
}

}  // namespace

Result<Acceleration> parse_acceleration(const TextFile& file, std::vector<Error>& /*warnings*/) {
  Acceleration acceleration;
  acceleration.name = file.name;
  acceleration.sha256 = file.sha256;
  ErrorList errors(file.path);
  LineReader lines(file.text);
  std::vector<Field> fields;
  while (lines.next()) {
    split_fields(lines.line(), fields);
    if (fields.empty()) continue;
    const std::optional<Segment> segment = parse_segment(lines.number(), fields, errors);
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
  return acceleration;
}

}  // namespace holdfast::internal
