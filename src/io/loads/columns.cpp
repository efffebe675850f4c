#include "io/loads/columns.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/closest_word.hpp"
#include "core/base/utf8.hpp"
#include "core/model/length_unit.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

/// Letters and digits of ASCII, and bytes of other letters.
bool is_letter_or_digit(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
         static_cast<unsigned char>(letter) >= 0x80U;
}

/// Letters of two bytes that are written as others here: accents go, German umlauts become two letters.
constexpr std::array<std::pair<std::string_view, std::string_view>, 52> kPlainLetters = {
    {{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"Ä", "ae"}, {"Ö", "oe"}, {"Ü", "ue"}, {"ß", "ss"}, {"é", "e"}, {"è", "e"},
     {"ê", "e"},  {"É", "e"},  {"á", "a"},  {"à", "a"},  {"â", "a"},  {"ã", "a"},  {"å", "a"},  {"í", "i"}, {"ì", "i"},
     {"î", "i"},  {"ó", "o"},  {"ò", "o"},  {"ô", "o"},  {"õ", "o"},  {"ø", "o"},  {"ú", "u"},  {"ù", "u"}, {"û", "u"},
     {"ñ", "n"},  {"ç", "c"},  {"ą", "a"},  {"ć", "c"},  {"ę", "e"},  {"ł", "l"},  {"ń", "n"},  {"ś", "s"}, {"ź", "z"},
     {"ż", "z"},  {"Ł", "l"},  {"Ś", "s"},  {"č", "c"},  {"ě", "e"},  {"ř", "r"},  {"š", "s"},  {"Š", "s"}, {"ů", "u"},
     {"ý", "y"},  {"Ý", "y"},  {"ž", "z"},  {"µ", "mu"}, {"μ", "mu"}, {"ő", "o"},  {"ű", "u"}}};

/// Adds a letter that is not of ASCII as it is compared; signs are left out.
void add_comparable(std::string_view letter, std::string& word) {
  for (const auto& [from, to] : kPlainLetters)
    if (letter == from) {
      word += to;
      return;
    }
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(letter[i]); };
  const bool is_sign = byte(0) == 0xC2U || (byte(0) == 0xE2U && byte(1) <= 0x81U) ||
                       (byte(0) == 0xE3U && byte(1) == 0x80U) || (byte(0) == 0xEFU && byte(1) == 0xBCU);
  if (is_sign) return;
  // Cyrillic capitals.
  constexpr unsigned kCyrillic = 0xD0U;
  if (letter.size() == 2 && byte(0) == kCyrillic && byte(1) >= 0x90U && byte(1) <= 0xAFU) {
    const bool is_late = byte(1) >= 0xA0U;
    word += static_cast<char>(is_late ? kCyrillic + 1U : kCyrillic);
    word += static_cast<char>(is_late ? byte(1) - 0x20U : byte(1) + 0x20U);
    return;
  }
  word += letter;
}

/// Letters and digits, in lower case.
std::string comparable(std::string_view text) {
  std::string word;
  while (!text.empty()) {
    const char letter = text[0];
    const std::size_t length = std::max<std::size_t>(utf8_length(text), 1);
    if (length > 1)
      add_comparable(text.substr(0, length), word);
    else if (letter >= 'A' && letter <= 'Z')
      word += static_cast<char>(letter - 'A' + 'a');
    else if (is_letter_or_digit(letter))
      word += letter;
    text.remove_prefix(length);
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

bool has_one_of(std::string_view word, std::span<const std::string_view> stems) {
  return std::any_of(stems.begin(), stems.end(),
                     [&](std::string_view stem) { return word.find(stem) != std::string_view::npos; });
}

/// Rank of a mass of which only a part of the header, or its unit, is known; the lowest one of a table holds.
std::optional<Meaning> likely_mass(std::string_view header, const HeaderWord& read) {
  constexpr int kLikely = 50;
  if (read.length_unit > 0.0 || header.find_first_of("/%") != std::string_view::npos) return std::nullopt;
  const bool is_gross = has_one_of(read.word, kGrossStems);
  if (!is_gross && has_one_of(read.word, kNoMassStems)) return std::nullopt;
  const std::vector<std::string> words = words_of(header);
  const auto ends_with_stem = [](const std::string& word) {
    return std::any_of(kMassStems.begin(), kMassStems.end(),
                       [&](std::string_view stem) { return word.ends_with(stem); });
  };
  // `Zone T` and `Value g` are none.
  const bool has_unit = read.mass_unit > 0.0 && (read.in_brackets || read.mass_unit == *mass_unit("kg"));
  if (!has_unit && !ends_with_stem(read.word) && std::none_of(words.begin(), words.end(), ends_with_stem))
    return std::nullopt;
  return Meaning{ColumnKind::mass, 0, kLikely + (is_gross ? 0 : has_one_of(read.word, kNetStems) ? 2 : 1)};
}

ReadHeader read_header(std::string_view header) {
  ReadHeader read{header_word(header), std::nullopt};
  int stripped = 0;
  for (std::string_view end = header;; ++stripped) {
    const HeaderWord word = header_word(end);
    auto meaning = meaning_of(word.word);
    // `G.W. (kg)` ends with the word of a width.
    if (meaning && is_length(meaning->kind) && word.mass_unit > 0.0) meaning.reset();
    // `limits.weight`
    if (meaning && meaning->kind == ColumnKind::mass && stripped > 0 && has_one_of(read.word.word, kNoMassStems))
      return read;
    if (meaning) {
      // `Load (kg)`
      const bool is_named = meaning->kind == ColumnKind::load || meaning->kind == ColumnKind::group;
      if (is_named && word.mass_unit > 0.0) meaning = likely_mass(header, word);
      if (!meaning) return read;
      // Of two keys the one that says it with its whole path comes first.
      constexpr int kBelow = 100;
      read = {word, Meaning{meaning->kind, meaning->axis, meaning->rank + kBelow * stripped}};
      return read;
    }
    const std::size_t point = end.find('.');
    // After a point and a blank there is no key of JSON.
    if (point == std::string_view::npos || end.substr(point + 1).starts_with(' ')) {
      read.meaning = likely_mass(header, read.word);
      return read;
    }
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
    case ColumnKind::mass_unit:
      return &plan.mass_unit;
    case ColumnKind::mat:
      return &plan.mat;
    case ColumnKind::fixed:
      return &plan.fixed;
    case ColumnKind::order:
      return &plan.order;
    case ColumnKind::order_or_group:
      return &plan.order_or_group;
    case ColumnKind::group:
      return &plan.group;
    case ColumnKind::quantity:
      return &plan.quantity;
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
    case ColumnKind::status:
      return &plan.status;
    case ColumnKind::ignored:
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

namespace {

/// Whether a key of JSON ends with a word of two letters and a capital, after a letter: `Mm` or `Kg`.
bool is_camel(std::string_view key, std::size_t capital) {
  return capital != std::string_view::npos && capital > 0 && key.size() == capital + 2 &&
         is_letter_or_digit(key[capital - 1]) && key[capital + 1] >= 'a';
}

}  // namespace

HeaderWord header_word(std::string_view header) {
  HeaderWord read;
  std::string_view rest = trimmed(header);
  for (const std::string_view inch : {"\"", "''", "″", "(\")", "[\"]", "('')", "(″)"}) {
    if (rest.size() <= inch.size() || !rest.ends_with(inch)) continue;
    read.word = comparable(rest.substr(0, rest.size() - inch.size()));
    read.length_unit = *length_unit("in");
    read.in_brackets = true;
    return read;
  }
  const std::size_t whole = rest.size();
  for (const std::string_view end : {")", "]", ".", "）"})
    while (rest.ends_with(end)) rest.remove_suffix(end.size());
  const bool has_bracket = rest.size() < whole;
  std::size_t begin = rest.size();
  while (begin > 0 && is_letter_or_digit(rest[begin - 1])) --begin;
  // A wide bracket is of letters' bytes.
  if (const std::size_t bracket = rest.rfind("（"); bracket != std::string_view::npos)
    begin = std::max(begin, bracket + std::string_view("（").size());
  const std::string unit = comparable(rest.substr(begin));
  const std::optional<double> length = length_unit(unit);
  // Without a bracket `to` is a word.
  const std::optional<double> mass = has_bracket && unit == "to" ? mass_unit("t") : mass_unit(unit);
  std::string before = begin > 0 ? comparable(rest.substr(0, begin)) : "";
  // `in mm`
  if (before.size() > 2 && (length || mass) && before.ends_with("in") && !meaning_of(before))
    before.resize(before.size() - 2);
  if (const std::size_t capital = rest.find_last_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ");
      !length && !mass && is_camel(rest, capital)) {
    // `lengthMm`
    const std::string word = comparable(rest.substr(capital));
    read.length_unit = length_unit(word).value_or(0.0);
    read.mass_unit = mass_unit(word).value_or(0.0);
    read.word = comparable(rest.substr(0, capital));
    if (read.length_unit > 0.0 || read.mass_unit > 0.0) return read;
  }
  if (before.empty() || (!length && !mass)) {
    read.word = comparable(header);
    return read;
  }
  read.word = before;
  read.length_unit = length.value_or(0.0);
  read.mass_unit = mass.value_or(0.0);
  read.in_brackets = has_bracket;
  return read;
}

Result<std::vector<ColumnChoice>> parse_column_choice(std::string_view text) {
  std::vector<ColumnChoice> choices;
  while (!trimmed(text).empty()) {
    // A header may have commas.
    const std::size_t sign = text.find('=');
    const std::size_t end = std::min(text.find(',', sign == std::string_view::npos ? 0 : sign), text.size());
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
  constexpr int kChosen = -2;  // the rank of what the user chooses, below those of all words
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
      if (header.meaning) header.meaning->rank = kChosen;
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
    const bool is_mass = header.meaning->kind == ColumnKind::mass;
    constexpr int kKnown = 50;  // ranks of words that are known are lower
    // Of masses that are only likely, and of one number in two units, the first one holds.
    const double unit = is_mass                           ? header.word.mass_unit
                        : is_length(header.meaning->kind) ? header.word.length_unit
                                                          : 0.0;
    const bool in_other_unit = *used && unit > 0.0 && used->unit > 0.0 && unit != used->unit;
    if (*used && ranks[used] == rank && ((is_mass && rank >= kKnown) || in_other_unit)) {
      plan.ignored.push_back(headers[i]);
      continue;
    }
    if (*used && ranks[used] == rank)
      return Error{.what = "two columns mean the same",
                   .value = shown(headers[static_cast<std::size_t>(used->index)]) + " and " + shown(headers[i]),
                   .accepted = "leave one out: --columns \"" + shown(headers[i]) + " = -\""};
    if (*used && ranks[used] < rank) {
      if (is_mass) plan.ignored.push_back(headers[i]);
      continue;
    }
    if (*used && is_mass) plan.ignored.push_back(headers[static_cast<std::size_t>(used->index)]);
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

void for_each_column(ColumnPlan& plan, const std::function<void(UsedColumn&)>& visit) {
  for (int kind = 0; kind <= static_cast<int>(ColumnKind::container_height); ++kind)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto of_kind = static_cast<ColumnKind>(kind);
      const bool has_axes = of_kind == ColumnKind::low || of_kind == ColumnKind::high ||
                            of_kind == ColumnKind::middle || of_kind == ColumnKind::extent;
      UsedColumn* const used = member_of(plan, {of_kind, axis});
      if (used != nullptr && *used && (axis == 0 || has_axes)) visit(*used);
    }
}

bool give_units(ColumnPlan& plan, std::span<const std::string> row) {
  const auto unit_of = [&](const UsedColumn& column) {
    const auto index = static_cast<std::size_t>(column.index);
    const std::string word = index < row.size() ? comparable(row[index]) : "";
    const std::optional<double> length = length_unit(word);
    return length ? *length : mass_unit(word).value_or(0.0);
  };
  const auto has_digit = [](const std::string& cell) { return cell.find_first_of("0123456789") != std::string::npos; };
  if (std::any_of(row.begin(), row.end(), has_digit)) return false;
  for (const auto& columns :
       {plan.low, plan.high, plan.middle, plan.extent, std::array{plan.length, plan.width, plan.height}})
    for (const UsedColumn& column : columns)
      if (column && unit_of(column) == 0.0) return false;
  for_each_column(plan, [&](UsedColumn& column) {
    if (column.unit == 0.0) column.unit = unit_of(column);
  });
  return true;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t length =
        static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_letter_or_digit) - text.begin());
    if (length > 0) words.push_back(comparable(text.substr(0, length)));
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return words;
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
