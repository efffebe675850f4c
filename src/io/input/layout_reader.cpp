#include "io/input/layout_reader.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/model/layout_check.hpp"
#include "core/model/length_unit.hpp"
#include "io/input/announced_boxes.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

constexpr const char* kLayoutLine = "x1 y1 z1 x2 y2 z2 material";
constexpr std::array kCornerNames{"x1", "y1", "z1", "x2", "y2", "z2"};

std::optional<int> parse_material(std::string_view text) {
  const std::optional<long> id = parse_integer(text);
  if (!id || *id < 0 || *id > std::numeric_limits<int>::max()) return std::nullopt;
  return static_cast<int>(*id);
}

/// Whether the line in the place of the header is a box, which would otherwise be lost without a message.
bool looks_like_box(const std::vector<Field>& fields) {
  if (fields.size() < kLayoutColumns || !parse_material(fields[6].text)) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double> low = parse_number(fields[axis].text);
    const std::optional<double> high = parse_number(fields[axis + 3].text);
    if (!low || !high || *low >= *high) return false;
  }
  return true;
}

class LayoutReader {
 public:
  LayoutReader(const TextFile& file, const Settings& settings) : file_(file), settings_(settings), errors_(file.path) {
    layout_.name = file.name;
    axes_ = axes_of(settings);
    unit_ = settings.loads.unit.value_or(unit_);
    layout_.sha256 = file.sha256;
  }

  Result<Layout> read(std::vector<Error>& warnings) {
    read_lines();
    if (errors_.empty() && box_count_ == 0)
      errors_.add({.what = header_line_ == 0 ? "is empty" : "has no boxes",
                   .accepted = std::string("a layout is a header line, then one line per box: ") + kLayoutLine});
    if (!errors_.empty()) return errors_.take();
    if (announced_)
      warnings.push_back({.file = file_.path,
                          .line = header_line_,
                          .what = "the header announces " + std::to_string(*announced_) + " boxes and the file has " +
                                  std::to_string(box_count_) + ", as in a truncated copy"});
    return std::move(layout_);
  }

 private:
  void read_lines() {
    LineReader lines(file_.text);
    std::vector<Field> header;
    std::vector<Field> fields;
    while (lines.next()) {
      split_fields(lines.line(), fields);
      if (fields.empty()) continue;
      if (box_count_ == kMostBoxes) {
        errors_.add({.line = lines.number(),
                     .what = "too many boxes",
                     .accepted = "at most " + std::to_string(kMostBoxes) + " boxes"});
        return;
      }
      if (header_line_ > 0)
        read_box(lines.number(), fields);
      else
        read_header(lines, header = fields);
    }
    announced_ = contradicted_count(header, box_count_);
  }

  void read_header(const LineReader& lines, const std::vector<Field>& fields) {
    header_line_ = lines.number();
    const std::string_view header = trimmed(lines.line());
    if (header.size() > kMostHeaderBytes) {
      errors_.add({.line = header_line_,
                   .column = fields[0].column,
                   .what = "the header is too long",
                   .value = std::to_string(header.size()) + " bytes",
                   .accepted = "at most " + std::to_string(kMostHeaderBytes)});
      return;
    }
    layout_.header = header;
    if (!looks_like_box(fields)) return;
    errors_.add({.line = header_line_,
                 .column = fields[0].column,
                 .what = "the header is missing, the first line is a box",
                 .value = shown(layout_.header),
                 .accepted = "the first line is a header of numbers, such as the seed and the number of boxes"});
  }

  void read_box(long line, const std::vector<Field>& fields) {
    ++box_count_;
    if (fields.size() < kLayoutColumns) {
      errors_.add({.line = line,
                   .column = fields[0].column,
                   .what = "box " + std::to_string(box_count_) + " has too few columns",
                   .value = std::to_string(fields.size()),
                   .accepted = std::string("the seven columns are ") + kLayoutLine});
      return;
    }
    if (fields.size() > kLayoutColumns && !has_more_columns_) {
      has_more_columns_ = true;
      errors_.add({.line = line,
                   .column = fields[kLayoutColumns].column,
                   .what = "more than seven columns, and nothing says what they mean",
                   .value = shown(fields[kLayoutColumns].text),
                   .accepted = std::string("name all columns in the first line, such as: ") + kLayoutLine + " weight"});
    }
    std::array<double, 6> corner{};
    bool good = true;
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const std::optional<double> number = parse_number(fields[i].text);
      if (!number)
        good = refuse(line, fields[i], kCornerNames[i], "not a number", "a finite number of cm such as 80 or 12.5");
      else if (std::abs(*number) > kFarthestCorner)
        good = refuse(line, fields[i], kCornerNames[i], "too far away", "a number of cm from -1000000 to 1000000");
      else
        corner[i] = in_metres(*number, unit_);
    }
    const std::optional<int> material = parse_material(fields[6].text);
    if (!material) good = refuse(line, fields[6], "the material", "not an id", "a whole number from 0 to 2147483647");
    if (good) layout_.boxes.push_back(make_box(corner, *material, line));
  }

  /// Reports an error. Always false: the box cannot be used.
  bool refuse(long line, const Field& field, const char* name, const char* fault, const char* accepted) {
    errors_.add({.line = line,
                 .column = field.column,
                 .what = std::string(name) + " of box " + std::to_string(box_count_) + " is " + fault,
                 .value = shown(field.text),
                 .accepted = accepted});
    return false;
  }

  Box make_box(const std::array<double, 6>& c, int material, long line) const {
    const auto [min, max] = axes_.corners({c[0], c[1], c[2]}, {c[3], c[4], c[5]}, settings_.container.size);
    return {min, max, material, line};
  }

  const TextFile& file_;
  const Settings& settings_;
  ErrorList errors_;
  Layout layout_;
  long header_line_ = 0;
  std::size_t box_count_ = 0;      ///< box lines so far, good or bad
  bool has_more_columns_ = false;  ///< a line with an eighth column has been seen
  FileAxes axes_;
  double unit_ = 0.01;                    ///< m
  std::optional<std::size_t> announced_;  ///< number of boxes in the header, if it differs from that in the file
};

}  // namespace

Result<Layout> read_layout_text(const TextFile& file, const Settings& settings, std::vector<Error>& warnings) {
  return LayoutReader(file, settings).read(warnings);
}

Result<Layout> parse_layout(const TextFile& file, const Settings& settings, std::vector<Error>& warnings) {
  Result<Layout> layout = read_layout_text(file, settings, warnings);
  if (!layout) return layout;
  std::vector<Error> geometry = check_layout(*layout, settings, file.path, warnings);
  return geometry.empty() ? std::move(layout) : Result<Layout>(std::move(geometry));
}

}  // namespace holdfast::internal
