#include "io/input/acceleration_reader.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast {

namespace {

constexpr std::size_t kColumns = 5;
constexpr const char* kLineFormat = "initial-time duration ax ay az";
constexpr std::array kNames{"the initial time", "the duration", "ax", "ay", "az"};

/// The segment of a line, or nothing when its numbers cannot be used.
std::optional<Segment> parse_segment(long line, const std::vector<Field>& fields, ErrorList& errors) {
  const auto refuse = [&](std::size_t i, std::string what, const char* accepted) {
    errors.add({.line = line,
                .column = fields[i].column,
                .what = std::move(what),
                .value = shown(fields[i].text),
                .accepted = accepted});
    return std::nullopt;
  };
  if (fields.size() != kColumns) {
    errors.add({.line = line,
                .column = fields[0].column,
                .what = fields.size() < kColumns ? "too few columns" : "too many columns",
                .value = std::to_string(fields.size()),
                .accepted = std::string("the five columns are ") + kLineFormat});
    return std::nullopt;
  }
  std::array<double, kColumns> numbers{};
  bool good = true;
  for (std::size_t i = 0; i < kColumns; ++i) {
    const std::optional<double> number = parse_number(fields[i].text);
    good = good && number;
    if (number)
      numbers[i] = *number;
    else
      refuse(i, std::string(kNames[i]) + " is not a number",
             i < 2 ? "a finite number of s" : "a finite number of m/s²");
  }
  if (!good) return std::nullopt;
  if (numbers[0] < 0.0) return refuse(0, "the initial time is negative", "a time of at least 0 s");
  if (numbers[0] > kLatestSegment || numbers[1] > kLatestSegment)
    return refuse(numbers[0] > kLatestSegment ? 0 : 1, "a time that no run would reach", "times of at most 1e6 s");
  if (numbers[1] < kSameInstant) return refuse(1, "the duration is too short", "a duration of at least 1e-9 s");
  for (std::size_t i = 2; i < kColumns; ++i)
    if (std::abs(numbers[i]) > kLargestAcceleration)
      return refuse(i, std::string(kNames[i]) + " is too large", "accelerations from -10000 to 10000 m/s²");
  return Segment{numbers[0], numbers[1], {numbers[2], numbers[3], numbers[4]}, line};
}

/// Appends a segment, or says how it disagrees with the one before.
void append(std::vector<Segment>& segments, Segment segment, long column, ErrorList& errors) {
  if (!segments.empty()) {
    const Segment& before = segments.back();
    const double end = before.start + before.duration;
    if (std::abs(segment.start - end) < kSameInstant) segment.start = end;
    if (segment.start < end) {
      const bool unsorted = segment.start < before.start;
      errors.add({.line = segment.line,
                  .column = column,
                  .what = (unsorted ? "the segment is before that of line " : "the segment overlaps that of line ") +
                          std::to_string(before.line),
                  .value = "starts at " + number_text(segment.start) + " s",
                  .accepted = unsorted ? "segments are in the order of their times"
                                       : "at least " + rounded_text(end, 12) + " s, where that one ends"});
      return;
    }
  }
  segments.push_back(segment);
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
    if (segment) append(acceleration.segments, *segment, fields[0].column, errors);
  }
  if (errors.empty() && acceleration.segments.empty())
    errors.add({.what = trimmed(file.text).empty() ? "is empty" : "has no segments",
                .accepted = std::string("an acceleration is a line a segment: ") + kLineFormat});
  if (!errors.empty()) return errors.take();
  return acceleration;
}

}  // namespace holdfast
