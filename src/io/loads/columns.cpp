#include "io/loads/columns.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/closest_word.hpp"
#include "core/model/length_unit.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

bool is_letter_or_digit(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
}

/// Lower-case letters and digits; German umlauts as two letters.
std::string comparable(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kLetters = {
      {{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"Ä", "ae"}, {"Ö", "oe"}, {"Ü", "ue"}, {"ß", "ss"}}};
  std::string word;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (letter >= 'A' && letter <= 'Z')
      word += static_cast<char>(letter - 'A' + 'a');
    else if (is_letter_or_digit(letter))
      word += letter;
    else
      for (const auto& [two_bytes, letters] : kLetters)
        if (text.substr(i, two_bytes.size()) == two_bytes) word += letters;
  }
  return word;
}

/// A kind of column that a word stands for.
struct Meaning {
  ColumnKind kind = ColumnKind::ignored;
  std::size_t axis = 0;
  int rank = 0;
};

std::optional<Meaning> meaning_with_axis(std::string_view word) {
  constexpr std::string_view kLetters = "xyz";
  constexpr std::string_view kDigits = "012";
  const auto find = [](std::string_view stem, std::size_t axis) -> std::optional<Meaning> {
    for (const ColumnWord& known : kAxisWords)
      if (known.word == stem) return Meaning{known.kind, axis, known.rank};
    return std::nullopt;
  };
  if (word.empty()) return std::nullopt;
  if (const std::size_t axis = kLetters.find(word.front()); axis != std::string_view::npos)
    if (const auto found = find(word.substr(1), axis)) return found;
  const std::string_view stem = word.substr(0, word.size() - 1);
  if (const std::size_t axis = kLetters.find(word.back()); axis != std::string_view::npos) return find(stem, axis);
  if (const std::size_t axis = kDigits.find(word.back()); axis != std::string_view::npos && stem.size() > 1)
    return find(stem, axis);
  return std::nullopt;
}

std::optional<Meaning> meaning_of(std::string_view word) {
  for (const ColumnWord& known : kPlainWords)
    if (known.word == word) return Meaning{known.kind, 0, known.rank};
  return meaning_with_axis(word);
}

bool is_length(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::low:
    case ColumnKind::high:
    case ColumnKind::middle:
    case ColumnKind::extent:
    case ColumnKind::length:
    case ColumnKind::width:
    case ColumnKind::height:
    case ColumnKind::nesting:
    case ColumnKind::container_length:
    case ColumnKind::container_width:
    case ColumnKind::container_height:
      return true;
    default:
      return false;
  }
}

/// A header, by its parts between points from the longest end to the last part.
struct ReadHeader {
  HeaderWord word;
  std::optional<Meaning> meaning;
};

ReadHeader read_header(std::string_view header) {
  ReadHeader read{header_word(header), std::nullopt};
  int stripped = 0;
  for (std::string_view end = header;; ++stripped) {
    const HeaderWord word = header_word(end);
    if (const auto meaning = meaning_of(word.word)) {
      // Of two keys the one that says it with its whole path comes first.
      constexpr int kBelow = 100;
      read = {word, Meaning{meaning->kind, meaning->axis, meaning->rank + kBelow * stripped}};
      return read;
    }
    const std::size_t point = end.find('.');
    if (point == std::string_view::npos) return read;
    end = end.substr(point + 1);
  }
}

UsedColumn* member_of(ColumnPlan& plan, const Meaning& meaning) {
  switch (meaning.kind) {
    case ColumnKind::low:
      return &plan.low.at(meaning.axis);
    case ColumnKind::high:
      return &plan.high.at(meaning.axis);
    case ColumnKind::middle:
      return &plan.middle.at(meaning.axis);
    case ColumnKind::extent:
      return &plan.extent.at(meaning.axis);
    case ColumnKind::length:
      return &plan.length;
    case ColumnKind::width:
      return &plan.width;
    case ColumnKind::height:
      return &plan.height;
    case ColumnKind::orientation:
      return &plan.orientation;
    case ColumnKind::name:
      return &plan.name;
    case ColumnKind::material:
      return &plan.material;
    case ColumnKind::mass:
      return &plan.mass;
    case ColumnKind::mat:
      return &plan.mat;
    case ColumnKind::fixed:
      return &plan.fixed;
    case ColumnKind::order:
      return &plan.order;
    case ColumnKind::order_or_load:
      return &plan.order_or_load;
    case ColumnKind::bearing_limit:
      return &plan.bearing_limit;
    case ColumnKind::nesting:
      return &plan.nesting;
    case ColumnKind::load:
      return &plan.load;
    case ColumnKind::container:
      return &plan.container;
    case ColumnKind::type:
      return &plan.type;
    case ColumnKind::container_length:
      return &plan.container_length;
    case ColumnKind::container_width:
      return &plan.container_width;
    case ColumnKind::container_height:
      return &plan.container_height;
    case ColumnKind::ignored:
    case ColumnKind::status:
      return nullptr;
  }
  return nullptr;
}

}  // namespace

bool ColumnPlan::has_place() const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!low.at(axis) && !middle.at(axis)) return false;
  return true;
}

bool ColumnPlan::has_size() const {
  const bool by_name = length && width && height;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!by_name && !extent.at(axis) && !high.at(axis)) return false;
  return true;
}

HeaderWord header_word(std::string_view header) {
  HeaderWord read;
  std::string_view rest = trimmed(header);
  while (!rest.empty() && (rest.back() == ')' || rest.back() == ']' || rest.back() == '.')) rest.remove_suffix(1);
  std::size_t begin = rest.size();
  while (begin > 0 && is_letter_or_digit(rest[begin - 1])) --begin;
  const std::string unit = comparable(rest.substr(begin));
  const std::optional<double> length = length_unit(unit);
  const std::optional<double> mass = mass_unit(unit);
  std::string before = begin > 0 ? comparable(rest.substr(0, begin)) : "";
  // `in mm`
  if (before.size() > 2 && (length || mass) && before.ends_with("in") && !meaning_of(before))
    before.resize(before.size() - 2);
  if (before.empty() || (!length && !mass)) {
    read.word = comparable(header);
    return read;
  }
  read.word = before;
  read.length_unit = length.value_or(0.0);
  read.mass_unit = mass.value_or(0.0);
  return read;
}

Result<std::vector<ColumnChoice>> parse_column_choice(std::string_view text) {
  std::vector<ColumnChoice> choices;
  while (!trimmed(text).empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t equals = part.rfind('=');
    const std::string_view header = equals == std::string_view::npos ? "" : trimmed(part.substr(0, equals));
    const std::string_view word = equals == std::string_view::npos ? "" : trimmed(part.substr(equals + 1));
    const bool is_known = word == "-" || meaning_of(header_word(word).word);
    if (header.empty() || !is_known)
      return Error{.what = "no choice of a column",
                   .value = shown(trimmed(part)),
                   .accepted =
                       "HEADER = WORD, where a word is x, y, z, x2, y2, z2, cx, cy, cz, dx, dy, dz, length, width, "
                       "height, name, mass, material, load, container type, order, mat, fixed, bearing limit, "
                       "nesting, orientation or - for a column to leave out"};
    choices.push_back({std::string(header), std::string(word)});
  }
  return choices;
}

Result<ColumnPlan> plan_columns(std::span<const std::string> headers, std::span<const ColumnChoice> choices) {
  ColumnPlan plan;
  std::map<UsedColumn*, int> ranks;
  std::vector<bool> is_chosen(choices.size(), false);
  for (std::size_t i = 0; i < headers.size(); ++i) {
    ReadHeader header = read_header(headers[i]);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      if (trimmed(headers[i]) != choices[k].header && comparable(headers[i]) != comparable(choices[k].header)) continue;
      is_chosen[k] = true;
      const HeaderWord chosen = header_word(choices[k].word);
      header.meaning = meaning_of(chosen.word);
      if (header.meaning) header.meaning->rank = -1;
      if (chosen.length_unit > 0.0) header.word.length_unit = chosen.length_unit;
      if (chosen.mass_unit > 0.0) header.word.mass_unit = chosen.mass_unit;
    }
    if (!header.meaning) {
      if (!comparable(headers[i]).empty()) plan.ignored.push_back(headers[i]);
      continue;
    }
    UsedColumn* const used = member_of(plan, *header.meaning);
    if (used == nullptr) continue;
    const int rank = header.meaning->rank;
    if (*used && ranks[used] == rank)
      return Error{.what = "two columns mean the same",
                   .value = shown(headers[static_cast<std::size_t>(used->index)]) + " and " + shown(headers[i]),
                   .accepted = "leave one out: --columns \"" + shown(headers[i]) + " = -\""};
    if (*used && ranks[used] < rank) continue;
    ranks[used] = rank;
    const HeaderWord& word = header.word;
    *used = {static_cast<int>(i), is_length(header.meaning->kind) ? word.length_unit : word.mass_unit};
  }
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (!is_chosen[k] && choices[k].needed)
      return Error{
          .what = "there is no column of that name",
          .value = shown(choices[k].header),
          .accepted = closest_word(choices[k].header, std::vector<std::string_view>(headers.begin(), headers.end()))
                          ? "did you mean '" +
                                std::string(*closest_word(
                                    choices[k].header, std::vector<std::string_view>(headers.begin(), headers.end()))) +
                                "'?"
                          : "a header of the table"};
  return plan;
}

std::string missing_columns(const ColumnPlan& plan) {
  constexpr std::array kAxes = {"x", "y", "z"};
  std::string missing;
  const auto add = [&](const std::string& what) { missing += (missing.empty() ? "" : ", ") + what; };
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!plan.low.at(axis) && !plan.middle.at(axis)) add(std::string("the place along ") + kAxes.at(axis));
  if (!plan.has_size()) {
    if (!plan.length) add("the length");
    if (!plan.width) add("the width");
    if (!plan.height) add("the height");
  }
  return missing;
}

}  // namespace holdfast::internal
