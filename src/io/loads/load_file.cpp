#include "io/loads/load_file.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/number_text.hpp"
#include "core/model/length_unit.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_lines.hpp"
#include "io/loads/check_load.hpp"
#include "io/loads/floating_boxes.hpp"
#include "io/loads/json_loads.hpp"
#include "io/loads/known_formats.hpp"
#include "io/loads/table_loads.hpp"
#include "io/loads/table_text.hpp"

namespace holdfast::internal {

namespace {

/// Unit of StableCargo's text, m.
constexpr double kTextUnit = 0.01;

/// Fewest boxes outside a container that other axes may explain; they are half of its boxes at least.
constexpr std::size_t kFewestOutside = 2;

/// Fewest cells of a row that is taken for a header whose words are not known.
constexpr std::size_t kFewestColumns = 6;

/// Rows before the header that are passed over: titles and dates.
constexpr int kMostTitleRows = 20;

std::vector<std::string> texts_of(const std::vector<TableCell>& row) {
  std::vector<std::string> texts;
  for (const TableCell& cell : row) texts.emplace_back(cell.text);
  return texts;
}

bool is_number(std::string_view text) {
  std::string with_point(text);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return parse_number(with_point).has_value();
}

/// Whether a row can be a header: it names something, and its cells are no numbers.
bool has_words(const std::vector<std::string>& row) {
  return std::none_of(row.begin(), row.end(), [](const std::string& cell) { return is_number(cell); });
}

/// A table of text below its header.
class TextRows final : public LoadRows {
 public:
  TextRows(const std::string& path, std::string_view text, char separator)
      : path_(path), separator_(separator), table_(text, separator) {}

  /// Looks for the header among the first rows: the first one whose words tell boxes; else what the best one lacks.
  /// Titles above it may say in which units the table is.
  Result<ColumnPlan> find_header(std::span<const ColumnChoice> choices, TableContext& context) {
    std::optional<Error> best;
    bool best_says_something = false;
    // A title above the header has none of the columns that the user names.
    std::vector<ColumnChoice> where_there(choices.begin(), choices.end());
    for (ColumnChoice& choice : where_there) choice.needed = false;
    for (int i = 0; i < kMostTitleRows && table_.next(); ++i) {
      std::vector<std::string> row = texts_of(table_.row());
      if (!has_words(row)) {
        if (separator_ == ' ') break;
        note_title(row, context);
        continue;
      }
      const Result<ColumnPlan> words = plan_columns(row, where_there);
      Result<ColumnPlan> plan = plan_columns(row, choices);
      if (plan && plan->has_boxes()) {
        headers_ = std::move(row);
        header_line_ = table_.line();
        take_units_below(*plan);
        return plan;
      }
      note_title(row, context);
      const bool says_something = !words || words->has_place() || words->has_size() || words->mass || words->length;
      if (best && (best_says_something || !says_something)) continue;
      best_says_something = says_something;
      Error error =
          plan ? Error{.what = "the header does not tell " + missing_columns(*plan),
                       .value = joined(row),
                       .accepted = "columns such as x, y, z, length, width, height; or --columns \"HEADER = x, ...\""}
               : plan.error();
      error.file = path_;
      error.line = table_.row().front().line;
      best = std::move(error);
    }
    if (best) return *best;
    if (Error wrong = mistake(); !wrong.what.empty()) return wrong;
    return Error{.file = path_, .what = "has no header", .accepted = "a first row that names the columns"};
  }

  const std::vector<std::string>& headers() const override { return headers_; }
  bool next() override {
    while (table_.next())
      if (!is_header()) return true;
    return false;
  }
  void restart() override {
    table_.restart();
    while (table_.line() <= header_line_ - 1 && table_.next()) {
    }
  }
  std::string_view cell(int column) const override {
    const std::vector<TableCell>& row = table_.row();
    return static_cast<std::size_t>(column) < row.size() ? row[static_cast<std::size_t>(column)].text : "";
  }
  Error at(int column, std::string what) const override {
    const std::vector<TableCell>& row = table_.row();
    const auto index = static_cast<std::size_t>(std::max(column, 0));
    const TableCell& cell = index < row.size() ? row[index] : row.back();
    const std::string name = column >= 0 ? " (column " + shown(headers_[index]) + ')' : "";
    return {.file = path_, .line = cell.line, .column = cell.column, .what = std::move(what) + name};
  }
  long line() const override { return table_.row().front().line; }
  Error mistake() const override {
    if (table_.error().empty()) return {};
    return {.file = path_, .line = table_.line(), .what = table_.error()};
  }

 private:
  /// Whether the row is the header once more, as tables of several pages have it.
  bool is_header() const {
    const std::vector<TableCell>& row = table_.row();
    return std::equal(row.begin(), row.end(), headers_.begin(), headers_.end(),
                      [](const TableCell& cell, const std::string& header) { return cell.text == header; });
  }

  /// A row of units beneath the header is part of it.
  void take_units_below(ColumnPlan& plan) {
    if (table_.next() && give_units(plan, texts_of(table_.row())))
      header_line_ = table_.line();
    else
      restart();
  }

  /// What a title tells: units, `All dimensions in inches`, but no words that prose has too; `Container: 40HC`.
  static void note_title(const std::vector<std::string>& row, TableContext& context) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string_view cell = row[i];
      const std::size_t colon = cell.find(':');
      const bool is_of_container = std::find(kContainerWords.begin(), kContainerWords.end(),
                                             header_word(cell.substr(0, colon)).word) != kContainerWords.end();
      if (!is_of_container) continue;
      const std::string_view value = colon != std::string_view::npos ? trimmed(cell.substr(colon + 1))
                                     : i + 1 < row.size()            ? std::string_view(row[i + 1])
                                                                     : std::string_view();
      if (is_container_name(value)) context.container = value;
    }
    for (const std::string& cell : row) {
      // After these a unit is meant, and none that belongs to a number or a name.
      constexpr std::array kBefore = {"in",    "unit",    "units",   "dimensions", "dims",
                                      "sizes", "lengths", "weights", "einheit"};
      const std::vector<std::string> words = words_of(cell);
      for (std::size_t i = 0; i < words.size(); ++i) {
        const bool is_meant =
            i == 0 ? words.size() == 1 : std::find(kBefore.begin(), kBefore.end(), words[i - 1]) != kBefore.end();
        if (!is_meant || words[i] == "in") continue;
        if (context.unit == 0.0) context.unit = length_unit(words[i]).value_or(0.0);
        if (context.mass_unit == 0.0) context.mass_unit = mass_unit(words[i]).value_or(0.0);
      }
    }
  }

  static std::string joined(const std::vector<std::string>& row) {
    std::string text;
    for (const std::string& cell : row) text += (text.empty() ? "" : ", ") + cell;
    return shown(text);
  }

  const std::string& path_;
  char separator_;
  TableText table_;
  std::vector<std::string> headers_;
  long header_line_ = 0;
};

/// The words of the first two lines of a text that are not blank: in StableCargo's, the header and a box.
std::array<std::vector<Field>, 2> first_lines(std::string_view text) {
  std::array<std::vector<Field>, 2> found;
  LineReader lines(text);
  for (std::vector<Field>& fields : found)
    while (fields.empty() && lines.next()) split_fields(lines.line(), fields);
  return found;
}

/// Whether the second line of a text, after one that names no columns, is that of a box in StableCargo's text: such a
/// text may have any header.
bool has_seven_numbers(std::string_view text) {
  const auto [header, box] = first_lines(text);
  std::vector<std::string> words;
  for (const Field& field : header) words.emplace_back(field.text);
  const Result<ColumnPlan> plan = plan_columns(words, {});
  if (plan && plan->has_boxes()) return false;
  return box.size() >= kLayoutColumns && std::all_of(box.begin(), box.begin() + 6, [](const Field& field) {
           return parse_number(field.text).has_value();
         });
}

Result<LoadsOfFile> read_text(const TextFile& file, const Settings& settings) {
  LoadsOfFile found{.form = "text"};
  ReadLoad& load = found.loads.emplace_back();
  Result<Layout> layout = read_layout_text(file, settings, load.warnings);
  if (layout) {
    load.layout = std::move(*layout);
    load.guessed_unit = settings.loads.unit ? 0.0 : kTextUnit;
    load.box_count = load.layout.boxes.size();
    check_load(load, file.path, settings);
    if (!load.errors.empty()) load.layout.boxes.clear();
  } else {
    load.errors = layout.errors();
  }
  // A header may have any words, so that a table whose words are not known is taken for a text too.
  if (!load.errors.empty() && !has_seven_numbers(file.text) && first_lines(file.text)[1].size() != kLayoutColumns)
    found.form += ", since no line names the places and sizes of boxes";
  load.layout.name = file.name;
  load.layout.sha256 = file.sha256;
  return found;
}

const char* separator_name(char separator) {
  switch (separator) {
    case ',':
      return "comma";
    case ';':
      return "semicolon";
    case '\t':
      return "tab";
    case '|':
      return "bar";
    default:
      return "blank";
  }
}

Result<LoadsOfFile> read_table_text(const TextFile& file, const TableChoices& choices, const Settings& settings) {
  const char separator = separator_of(file.text);
  TextRows rows(file.path, file.text, separator);
  TableContext context{.path = file.path, .name = file.name};
  const Result<ColumnPlan> plan = rows.find_header(choices.columns, context);
  if (!plan) return plan.errors();
  LoadsOfFile found = read_table(rows, *plan, context, choices, settings);
  found.form = std::string(separator_name(separator)) + "-separated table";
  if (context.unit > 0.0 && !choices.unit)
    found.notes.push_back({.file = file.path,
                           .what = "lengths are taken as " + length_unit_name(context.unit) + ", as a title says",
                           .accepted = "--unit says another"});
  return found;
}

}  // namespace

LoadSyntax load_syntax(std::string_view text) {
  if (const std::optional<DecodedText> utf8 = decoded(text)) return load_syntax(utf8->text);
  if (looks_like_json(text)) return LoadSyntax::json;
  if (has_seven_numbers(text)) return LoadSyntax::text;
  const char separator = separator_of(text);
  TableText table(text, separator);
  for (int i = 0; i < kMostTitleRows && table.next(); ++i) {
    const std::vector<std::string> row = texts_of(table.row());
    if (!has_words(row)) {
      if (separator == ' ') break;
      continue;
    }
    const Result<ColumnPlan> plan = plan_columns(row, {});
    if (plan && plan->has_boxes()) return LoadSyntax::table;
    // Words with blanks between them may be prose, or the first line of an acceleration.
    const bool says_some = !plan || plan->has_place() || plan->has_size() || row.size() >= kFewestColumns;
    if (separator != ' ' && says_some) return LoadSyntax::table;
  }
  return LoadSyntax::text;
}

namespace {

/// Reads and checks the loads of a file, with the axes of the settings.
Result<LoadsOfFile> read_along_axes(const TextFile& file, const Settings& settings) {
  const LoadSyntax syntax = load_syntax(file.text);
  if (syntax == LoadSyntax::text) return read_text(file, settings);
  const Result<TableChoices> choices = TableChoices::of(settings);
  if (!choices) return choices.errors();
  Result<LoadsOfFile> found = syntax == LoadSyntax::json
                                  ? read_json_loads(file.text, file.path, file.name, *choices, settings)
                                  : read_table_text(file, *choices, settings);
  if (!found) return found;
  if (found->loads.empty()) {
    Error error{.file = file.path, .what = "has no boxes"};
    for (const Error& note : found->notes) error.what += ": " + note.what;  // items that are not placed
    return error;
  }
  for (ReadLoad& load : found->loads) {
    if (settings.container.overrides_loads) load.layout.container.reset();
    load.box_count = load.layout.boxes.size();
    check_load(load, file.path, settings);
    if (!load.errors.empty()) load.layout.boxes.clear();
  }
  return found;
}

bool all_good(const LoadsOfFile& loads) {
  return std::all_of(loads.loads.begin(), loads.loads.end(), [](const ReadLoad& load) { return load.errors.empty(); });
}

/// The usual axes with which all loads of a file fit, and which pass a test beside: the first ones, and where those
/// have another end or side as well, also these.
template <class Test>
std::vector<FileAxes> fitting_axes(const TextFile& file, const Settings& settings, Test is_right) {
  std::vector<FileAxes> fitting;
  for (const auto& mirrored :
       {std::array{"x -z y", "x z y"}, std::array{"z x y", "-z x y"}, std::array{"y x z", "-y x z"}}) {
    for (const char* const text : mirrored) {
      Settings turned = settings;
      turned.loads.axes = parse_axes(text);
      const Result<LoadsOfFile> loads = read_along_axes(file, turned);
      if (loads && all_good(*loads) && is_right(*loads)) fitting.push_back(*turned.loads.axes);
    }
    if (!fitting.empty()) break;
  }
  return fitting;
}

/// How a user tells the axes. Where two are possible the file does not say from which end or side it counts.
std::string axes_option(const std::vector<FileAxes>& fitting) {
  const std::string option = "--axes \"" + axes_text(fitting.front()) + '"';
  if (fitting.size() == 1) return option + ", which are length, width and height";
  const bool is_length = axes_text(fitting.front()).substr(0, 1) != "x";
  return option +
         (is_length ? " where it counts from the front, --axes \"" : " where it counts from the right, --axes \"") +
         axes_text(fitting.back()) + (is_length ? "\" from the rear" : "\" from the left");
}

/// Boxes of which something must be below, and those of them of which nothing is.
FloatingBoxes floating_boxes_of(const LoadsOfFile& loads, const Settings& settings) {
  FloatingBoxes sum;
  for (const ReadLoad& load : loads.loads) sum += count_floating(load.layout, settings);
  return sum;
}

/// The option with which the places of a file are those of middles; empty where boxes do not all fit and stand with it.
std::string middles_option(const TextFile& file, const Settings& settings, const LoadsOfFile& found) {
  if (found.place_headers.empty()) return {};
  Settings by_middles = settings;
  std::string& columns = by_middles.loads.columns;
  std::string option;
  for (std::size_t axis = 0; axis < 3; ++axis)
    option += (axis > 0 ? ", " : "") + found.place_headers.at(axis) + " = " + std::array{"cx", "cy", "cz"}.at(axis);
  columns += (columns.empty() ? "" : ", ") + option;
  const Result<LoadsOfFile> moved = read_along_axes(file, by_middles);
  if (!moved || !all_good(*moved) || floating_boxes_of(*moved, settings).floating > 0) return {};
  return "all boxes stand with --columns \"" + shown(option) + '"';
}

/// Says that the boxes of a file, all of which fit, float; and with which axes none would.
void warn_of_floating(const TextFile& file, const Settings& settings, LoadsOfFile& found) {
  const FloatingBoxes boxes = floating_boxes_of(found, settings);
  if (boxes.floating == 0 || 2 * boxes.floating < boxes.all) return;
  const std::vector<FileAxes> axes = fitting_axes(
      file, settings, [&](const LoadsOfFile& turned) { return floating_boxes_of(turned, settings).floating == 0; });
  if (axes.empty()) {
    if (const std::string option = middles_option(file, settings, found); !option.empty())
      found.loads.front().warnings.push_back(
          {.file = file.path,
           .what = "nothing is beneath most boxes, as where places are those of middles",
           .accepted = option});
    return;
  }
  found.loads.front().warnings.push_back({.file = file.path,
                                          .what = "nothing is beneath " + std::to_string(boxes.floating) + " of " +
                                                  std::to_string(boxes.all) +
                                                  " boxes, as in a file whose height is another axis",
                                          .accepted = "all boxes stand with " + axes_option(axes)});
}

Result<LoadsOfFile> read_utf8_loads(const TextFile& file, const Settings& settings) {
  Result<LoadsOfFile> found = read_along_axes(file, settings);
  const bool has_axes = settings.loads.axes || settings.up_axis == UpAxis::y || !settings.loads.format.empty();
  // To look for what mends a file takes reading it several times.
  constexpr std::size_t kMostTried = std::size_t{1} << 22U;  // bytes
  if (!found || has_axes || file.text.size() > kMostTried) return found;
  if (all_good(*found)) {
    warn_of_floating(file, settings, *found);
    return found;
  }
  const auto say = [&](const std::string& what, const std::string& accepted) {
    for (ReadLoad& load : found->loads)
      if (!load.errors.empty())
        load.errors = {
            {.file = file.path, .what = "the boxes of " + shown(load.layout.name) + what, .accepted = accepted}};
  };
  for (const KnownFormat& format : kKnownFormats) {
    if (format.sign.empty() || file.text.find(format.sign) == std::string::npos) continue;
    Settings of_format = settings;
    of_format.loads.format = format.name;
    const Result<LoadsOfFile> loads = read_along_axes(file, of_format);
    if (!loads || !all_good(*loads)) continue;
    say(" do not fit their container as they are read", "everything fits with --format " + std::string(format.name));
    return found;
  }
  const bool is_turned = std::any_of(found->loads.begin(), found->loads.end(), [](const ReadLoad& load) {
    return load.outside >= kFewestOutside && 2 * load.outside >= load.box_count;
  });
  if (!is_turned) return found;
  const auto fits = [](const LoadsOfFile&) { return true; };
  if (const std::vector<FileAxes> axes = fitting_axes(file, settings, fits); !axes.empty())
    say(" do not fit their container along its axes", "everything fits with " + axes_option(axes));
  else if (const std::string option = middles_option(file, settings, *found); !option.empty())
    say(" do not fit their container with these corners", option);
  return found;
}

}  // namespace

Result<LoadsOfFile> read_loads(const TextFile& file, const Settings& settings) {
  if (const auto error = why_no_text(file.path, file.text)) return *error;
  std::optional<DecodedText> utf8 = decoded(file.text);
  if (!utf8 || load_syntax(utf8->text) == LoadSyntax::text) return read_utf8_loads(file, settings);
  Result<LoadsOfFile> found = read_utf8_loads(
      {.path = file.path, .name = file.name, .text = std::move(utf8->text), .sha256 = file.sha256}, settings);
  if (found && std::string_view(utf8->encoding) != "UTF-16")
    found->notes.push_back({.file = file.path,
                            .what = std::string("is not UTF-8, and taken as ") + utf8->encoding,
                            .accepted = "save it as CSV (UTF-8) if letters of names are wrong"});
  return found;
}

}  // namespace holdfast::internal
