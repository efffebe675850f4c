#include "io/loads/cell_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/length_unit.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

/// Digits between marks of thousands.
constexpr std::size_t kDigitsBetween = 3;

/// A cell up to its last digit, and the letters after it; both are empty where it has no digit.
struct NumberAndUnit {
  std::string_view number, unit;
};

NumberAndUnit number_and_unit(std::string_view cell) {
  const std::size_t digit = cell.find_last_of("0123456789");
  if (digit == std::string_view::npos) return {};
  return {trimmed(cell.substr(0, digit + 1)), trimmed(cell.substr(digit + 1))};
}

/// Of lengths or masses; 0: the word is none.
double unit_of(const std::string& word) { return length_unit(word).value_or(mass_unit(word).value_or(0.0)); }

/// Whether a mark may be one of thousands: `1.200`, but not `0.200`.
bool may_be_thousands(std::string_view written, std::size_t mark) {
  return mark > 0 && mark <= kDigitsBetween && written.size() == mark + 1 + kDigitsBetween && written[0] != '0';
}

/// Takes out signs between thousands that are never others: 1'200, and 1 200 with a space that does not break.
void erase_spaces(std::string& written) {
  for (const std::string_view space : {"'", "’", "\u00A0", "\u202F"})
    for (std::size_t at = written.find(space); at != std::string::npos && at > 0; at = written.find(space, at))
      written.erase(at, space.size());
}

}  // namespace

std::string_view CellNumbers::text(const UsedColumn& column) const {
  return column ? rows_.cell(column.index) : std::string_view();
}

void CellNumbers::look_at_cells() {
  take_units_of_cells();
  if (!rows_.has_exact_numbers()) find_marks_of_thousands();
}

/// Cells may have units: `120 cm`. The first one that is not 0, which needs none, tells whether those of its column
/// have.
void CellNumbers::take_units_of_cells() {
  std::set<int> told;
  for (int i = 0; i < kRowsLookedAt && rows_.next(); ++i)
    for_each_column(plan_, [&](UsedColumn& column) {
      if (column.unit > 0.0 || text(column).empty() || parse_number(text(column)) == 0.0) return;
      if (!told.insert(column.index).second) return;
      column.unit = unit_of(lower_case(number_and_unit(text(column)).unit));
      if (column.unit > 0.0) columns_with_units_.insert(column.index);
    });
  rows_.restart();
}

/// What marks thousands in columns: every mark is before three digits. 0: nothing does.
template <class Note>
char CellNumbers::thousands_of(const std::vector<UsedColumn>& columns, Note note) {
  char mark = 0;
  rows_.restart();
  for (int i = 0; i < kRowsLookedAt && !columns.empty() && rows_.next(); ++i)
    for (const UsedColumn& column : columns) {
      const std::string_view written = number_and_unit(text(column)).number;
      const std::size_t at = written.find_first_of(".,");
      note(written, at != std::string_view::npos);
      if (at == std::string_view::npos) continue;
      if (!may_be_thousands(written, at)) return 0;
      mark = written[at];
    }
  return mark;
}

/// `1.200` in a column of mm is no length.
void CellNumbers::find_marks_of_thousands() {
  std::vector<UsedColumn> lengths;
  for (const auto& of : {plan_.low, plan_.extent, std::array{plan_.length, plan_.width, plan_.height}})
    std::copy_if(of.begin(), of.end(), std::back_inserter(lengths), [&](const UsedColumn& column) {
      return column && (column.unit > 0.0 ? column.unit : unit_) == *length_unit("mm");
    });
  thousands_of_lengths_ = thousands_of(lengths, [](std::string_view, bool) {});
  if (plan_.mass) thousands_of_masses_ = thousands_of_masses();
  rows_.restart();
}

/// The same of masses: where another mark is that of decimals; or `1,576` beside 751, twice at least, where no column
/// has a mark of decimals, and no mass is written without it that would have one. Or what marks them in lengths.
char CellNumbers::thousands_of_masses() {
  constexpr double kLarge = 100.0;
  constexpr double kThousand = 1000.0;
  constexpr int kFewest = 2;
  int marked = 0;
  bool has_large = false;
  bool has_thousands = false;
  const char mark = thousands_of({plan_.mass}, [&](std::string_view written, bool has_mark) {
    const double mass = has_mark ? 0.0 : parse_number(written).value_or(0.0);
    marked += has_mark ? 1 : 0;
    has_large = has_large || mass >= kLarge;
    has_thousands = has_thousands || mass >= kThousand;
  });
  if (mark == 0 || mark == thousands_of_lengths_) return mark;
  if (const char decimals = decimal_mark_of_others(); decimals != 0) return mark != decimals ? mark : '\0';
  return marked >= kFewest && has_large && !has_thousands ? mark : '\0';
}

/// What marks decimals in the columns of lengths and of friction; 0: nothing.
char CellNumbers::decimal_mark_of_others() {
  rows_.restart();
  for (int i = 0; i < kRowsLookedAt && rows_.next(); ++i)
    for (const auto& columns :
         {plan_.low, plan_.middle, plan_.high, plan_.extent, std::array{plan_.length, plan_.width, plan_.height},
          std::array{plan_.mat, plan_.bearing_limit, plan_.nesting}})
      for (const UsedColumn& column : columns) {
        const std::string_view written = number_and_unit(text(column)).number;
        const std::size_t at = written.find_first_of(".,");
        if (at != std::string_view::npos && !may_be_thousands(written, at)) return written[at];
      }
  return 0;
}

/// What marks thousands in a column; 0: nothing.
char CellNumbers::thousands_mark(const UsedColumn& column) const {
  if (&column == &plan_.mass) return thousands_of_masses_;
  const bool is_of_lengths = &column != &plan_.mat && &column != &plan_.bearing_limit && &column != &plan_.quantity;
  return is_of_lengths ? thousands_of_lengths_ : '\0';
}

CellNumbers::Reading CellNumbers::read(const UsedColumn& column, std::string_view cell) {
  constexpr double kFarthest = 1e9;
  const char thousands = thousands_mark(column);
  const bool is_plain = decimal_mark_ == '.' || cell.find('.') == std::string_view::npos;
  const bool needs_unit = !columns_with_units_.empty() && columns_with_units_.contains(column.index);
  if (const std::optional<double> number = parse_number(cell);
      number && thousands == 0 && is_plain && !needs_unit && std::abs(*number) <= kFarthest)
    return {number};
  std::string written(cell);
  // The cell's own unit, over that of the column.
  double factor = 1.0;
  const auto [number_part, letters] = number_and_unit(cell);
  const std::string word = lower_case(letters);
  const double unit = unit_of(word);
  if (word == "%" && &column == &plan_.mat) {
    written = number_part;
  } else if (unit > 0.0 && column.unit > 0.0) {
    written = number_part;
    factor = unit == column.unit ? 1.0 : unit / column.unit;
  }
  erase_spaces(written);
  const bool had_thousands = thousands != 0 && std::erase(written, thousands) > 0;
  std::optional<double> number = parse_number(written);
  // In a table whose cells commas separate, one within a cell is in quotes.
  const bool has_comma = written.find(',') != std::string::npos;
  const bool has_point = written.find('.') != std::string::npos;
  if (has_comma && !has_point) {
    std::string with_point = written;
    with_point[with_point.find(',')] = '.';
    number = parse_number(with_point);
  }
  if (number && (has_comma || has_point) && !had_thousands) {
    if (decimal_mark_ == 0) decimal_mark_ = has_comma ? ',' : '.';
    if (decimal_mark_ != (has_comma ? ',' : '.')) number.reset();
  }
  const bool lacks_unit = needs_unit && unit == 0.0 && number && *number != 0.0;
  if (!number || lacks_unit || std::abs(*number) > kFarthest) return {std::nullopt, lacks_unit};
  return {factor * *number};
}

}  // namespace holdfast::internal
