#include "io/loads/table_loads.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <utility>

#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/layout_check.hpp"
#include "core/model/length_unit.hpp"
#include "core/model/load_limits.hpp"
#include "core/model/overlap_trim.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_lines.hpp"
#include "io/loads/cell_numbers.hpp"
#include "io/loads/known_formats.hpp"
#include "io/loads/load_parts.hpp"

namespace holdfast::internal {

namespace {

/// Inner lengths that a container may have, m: of a pallet, and of the longest vehicle.
constexpr double kShortestContainer = 0.8;
constexpr double kLongestContainer = 25.0;

template <class Words>
bool is_one_of(std::string_view text, const Words& words) {
  const std::string word = lower_case(text);
  return std::any_of(words.begin(), words.end(), [&](std::string_view known) {
    return word.starts_with(known) && (word.size() == known.size() || word.substr(known.size()) == "s");
  });
}

/// What the values of a column `type` mean.
enum class TypeColumn { unknown, rows, containers, materials };

/// A load as its rows come.
struct Growing {
  explicit Growing(const std::string& path) : errors(path) {}

  ReadLoad load;
  ErrorList errors;
  std::array<std::optional<double>, 3> size;  ///< of its container, in the file's unit or in m where `size_unit` is set
  double size_unit = 0.0;
  std::string type;  ///< of its container
  /// What its boxes, whose corners are those of the file until all rows are read, need to become metres.
  struct OfBox {
    double unit = 0.0;  ///< m; 0: that of the file
    double nesting = 0.0;
  };
  std::vector<OfBox> of_boxes;
};

class TableReader {
 public:
  TableReader(LoadRows& rows, const ColumnPlan& plan, const TableContext& context, const TableChoices& choices,
              const Settings& settings)
      : rows_(rows),
        plan_(plan),
        context_(context),
        choices_(choices),
        settings_(settings),
        numbers_(rows, plan_, choices.unit.value_or(context.unit)) {
    axes_ = choices.axes.value_or(axes_of(settings));
  }

  LoadsOfFile read() {
    choose_load_column();
    numbers_.look_at_cells();
    find_units_of_groups();
    while (rows_.next()) read_row();
    if (Error mistake = rows_.mistake(); !mistake.what.empty()) {
      // What the rest of the table holds is not known: no load of it can be trusted.
      Growing& first = load_named("");
      first.errors.add(std::move(mistake));
      for (auto& growing : loads_)
        if (&growing != &first) growing.errors.add({.what = "the table cannot be read to its end"});
    }
    find_unit();
    found_.loads.reserve(loads_.size());
    for (Growing& growing : loads_) finish(growing);
    if (!plan_.load && load_column()) join_parts(found_.loads, context_.name);
    if (!plan_.load && load_column() && found_.loads.size() > 1)
      found_.notes.push_back({.file = context_.path,
                              .what = "a column is taken for names of loads, since their boxes overlap",
                              .value = shown(rows_.headers()[static_cast<std::size_t>(load_column().index)]),
                              .accepted = "--columns \"" +
                                          shown(rows_.headers()[static_cast<std::size_t>(load_column().index)]) +
                                          " = -\" leaves it out"});
    note_rows();
    found_.ignored = plan_.ignored;
    if (plan_.low[0] && plan_.low[1] && plan_.low[2])
      for (const UsedColumn& column : plan_.low)
        found_.place_headers.push_back(rows_.headers()[static_cast<std::size_t>(column.index)]);
    return std::move(found_);
  }

 private:
  void choose_load_column() {
    if (plan_.load || plan_.group || !plan_.order_or_group) return;
    // The loads of `order` come one after the other, and their names repeat; places in a loading order do not.
    std::map<std::string, int, std::less<>> seen;
    bool repeats = false;
    while (!repeats && rows_.next()) {
      const std::string_view value = rows_.cell(plan_.order_or_group.index);
      repeats = !value.empty() && ++seen[std::string(value)] > 1;
    }
    rows_.restart();
    order_is_load_ = repeats;
  }

  /// A column `unit` may tell those of lengths: where all of its values are such.
  void find_units_of_groups() {
    bool any = false;
    bool all = true;
    for (int i = 0; i < CellNumbers::kRowsLookedAt && plan_.group && all && rows_.next(); ++i) {
      const std::string value = lower_case(text(plan_.group));
      any = any || !value.empty();
      all = value.empty() || length_unit(value) || mass_unit(value);
    }
    group_is_unit_ = any && all;
    rows_.restart();
  }

  std::string_view text(const UsedColumn& column) const {
    return column ? rows_.cell(column.index) : std::string_view();
  }

  void read_row() {
    const std::string_view type = text(plan_.type);
    if (type_ == TypeColumn::unknown && !type.empty()) {
      type_ = is_one_of(type, kContainerWords) || is_one_of(type, kBoxWords) ? TypeColumn::rows
              : is_container_name(type)                                      ? TypeColumn::containers
                                                                             : TypeColumn::materials;
    }
    if (type_ == TypeColumn::rows && is_one_of(type, kContainerWords) && !is_one_of(type, kBoxWords) && !is_cargo())
      return read_container_row();
    if (is_unplaced()) {
      ++unplaced_;
      if (unplaced_names_.size() < 3 && !text(plan_.name).empty()) unplaced_names_.emplace_back(text(plan_.name));
      return;
    }
    read_box();
  }

  /// Whether a row of a word for containers is one of cargo: a pallet with a place.
  bool is_cargo() const { return lower_case(text(plan_.type)).starts_with("pallet") && !is_unplaced(); }

  /// Whether a row is one of sums: it is called so, and is none of a box.
  bool is_sum() const {
    constexpr std::size_t kLongest = 12;  // bytes, of the words and a colon
    const std::string_view name = text(plan_.name);
    if (name.empty() || name.size() > kLongest) return false;
    const std::string word = lower_case(name.substr(0, name.find(':')));
    return std::find(kSumWords.begin(), kSumWords.end(), word) != kSumWords.end() && !has_place_and_size();
  }

  bool has_place_and_size() const {
    const auto is_there = [&](const UsedColumn& column) { return !text(column).empty(); };
    const auto has_length = [&](const UsedColumn& column) {
      return is_there(column) && parse_number(text(column)) != 0.0;
    };
    const std::array<UsedColumn, 3> by_name = {plan_.length, plan_.width, plan_.height};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!is_there(plan_.low.at(axis)) && !is_there(plan_.middle.at(axis))) return false;
      if (!has_length(plan_.extent.at(axis)) && !has_length(plan_.high.at(axis)) && !has_length(by_name.at(axis)))
        return false;
    }
    return true;
  }

  bool has_unplaced_status() const {
    if (!plan_.status) return false;
    std::string status = lower_case(text(plan_.status));
    std::erase_if(status, [](char letter) { return letter == ' ' || letter == '-' || letter == '_'; });
    return std::find(kUnplacedWords.begin(), kUnplacedWords.end(), status) != kUnplacedWords.end();
  }

  bool is_unplaced() const {
    if (is_sum() || has_unplaced_status()) return true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!text(plan_.low.at(axis)).empty() || !text(plan_.middle.at(axis)).empty()) return false;
    return true;
  }

  UsedColumn load_column() const {
    if (plan_.load) return plan_.load;
    if (plan_.group) return group_is_unit_ ? UsedColumn{} : plan_.group;
    return order_is_load_ ? plan_.order_or_group : UsedColumn{};
  }

  std::string_view load_name() {
    const UsedColumn column = load_column();
    if (!column) return context_.load;
    const std::string_view name = rows_.cell(column.index);
    if (!plan_.load) return name;
    // Of merged cells only the first has the name.
    if (name.empty()) return last_load_;
    if (last_load_ != name) last_load_ = name;
    return name;
  }

  Growing& load_named(std::string_view name) {
    // The rows of most tables come load by load.
    if (last_place_ != places_.end() && last_place_->first == name) return loads_[last_place_->second];
    const std::size_t count = loads_.size();
    const auto place = places_.find(name);
    last_place_ = place != places_.end() ? place : places_.emplace(name, count).first;
    if (place == places_.end()) {
      const std::size_t boxes_before = loads_.empty() ? 0 : loads_.back().of_boxes.size();
      Growing& growing = loads_.emplace_back(context_.path);
      growing.load.layout.boxes.reserve(boxes_before);  // loads of a table are about as large
      const std::string shown_name = kept_name(name);
      growing.load.layout.name = context_.name + (shown_name.empty() ? "" : '#' + shown_name);
      growing.size = context_.container_size;
      growing.size_unit = context_.container_unit;
      growing.type = context_.container;
      if (growing.type.empty() && is_container_name(name)) growing.type = name;
    }
    return loads_[last_place_->second];
  }

  void read_container_row() {
    Growing& growing = load_named(load_name());
    const std::array<UsedColumn, 3> by_name = {plan_.length, plan_.width, plan_.height};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const UsedColumn& along = plan_.extent.at(axes_.axes.at(axis).of_file);
      const UsedColumn& column = along ? along : by_name.at(axis);
      if (const auto number = read_number(growing, column, "the size of the container")) {
        growing.size.at(axis) = *number;
        growing.size_unit = column.unit;
      }
    }
  }

  void read_box() {
    Growing& growing = load_named(load_name());
    if (growing.of_boxes.size() == kMostBoxes) {
      growing.errors.add(rows_.at(-1, "a load has more than " + std::to_string(kMostBoxes) + " boxes"));
      return;
    }
    read_container_columns(growing);
    Box box{.material = MaterialName(kUsualMaterial), .line = rows_.line(), .name = kept_name(text(plan_.name))};
    Growing::OfBox of_box;
    if (!read_corners(growing, box, of_box)) return;
    read_properties(growing, box, of_box);
    growing.load.layout.boxes.push_back(std::move(box));
    if (std::string pointer = rows_.pointer(); !pointer.empty())
      growing.load.box_pointers.push_back(std::move(pointer));
    growing.of_boxes.push_back(of_box);
  }

  /// Columns with the size of the container say it in every row, or in the first.
  void read_container_columns(Growing& growing) {
    const std::array<UsedColumn, 3> columns = {plan_.container_length, plan_.container_width, plan_.container_height};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (growing.size.at(axis) || text(columns.at(axis)).empty()) continue;
      growing.size.at(axis) = read_number(growing, columns.at(axis), "the size of the container");
      growing.size_unit = columns.at(axis).unit;
    }
  }

  /// False when the corners are not known.
  bool read_corners(Growing& growing, Box& box, Growing::OfBox& of_box) {
    std::array<std::optional<double>, 3> size = read_size(growing);
    of_box.unit = unit_of_lengths();
    if (of_box.unit == 0.0 && group_is_unit_) of_box.unit = length_unit(lower_case(text(plan_.group))).value_or(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      const UsedColumn& low = plan_.low.at(axis);
      const UsedColumn& middle = plan_.middle.at(axis);
      const UsedColumn& high = plan_.high.at(axis);
      const auto place = read_length(growing, low ? low : middle, low ? "the place" : "the middle");
      std::optional<double> end;
      if (high && low && !size.at(axis)) {
        end = read_length(growing, high, "the second corner");
        if (place && end) size.at(axis) = *end - *place;
      }
      if (!place || !size.at(axis)) return false;
      box.corner_min[k] = low ? *place : *place - 0.5 * *size.at(axis);
      box.corner_max[k] = end ? *end : box.corner_min[k] + *size.at(axis);
    }
    return true;
  }

  /// The unit of the first column of lengths that says one, m; 0: none does.
  double unit_of_lengths() const {
    for (const auto& columns :
         {plan_.low, plan_.middle, plan_.high, plan_.extent, std::array{plan_.length, plan_.width, plan_.height}})
      for (const UsedColumn& column : columns)
        if (column && column.unit > 0.0) return column.unit;
    return 0.0;
  }

  /// A length of a column, in the unit of lengths: another one in that of its own.
  std::optional<double> read_length(Growing& growing, const UsedColumn& column, const char* what) {
    std::optional<double> number = read_number(growing, column, what);
    const double unit = unit_of_lengths();
    if (number && column.unit > 0.0 && column.unit != unit) *number *= column.unit / unit;
    return number;
  }

  /// Extents along the axes of the file, as placed; nothing along axes whose corners tell.
  std::array<std::optional<double>, 3> read_size(Growing& growing) {
    std::array<std::optional<double>, 3> size;
    if (plan_.length && plan_.width && plan_.height && !(plan_.extent[0] && plan_.extent[1] && plan_.extent[2])) {
      std::array<std::optional<double>, 3> own = {read_length(growing, plan_.length, "the length"),
                                                  read_length(growing, plan_.width, "the width"),
                                                  read_length(growing, plan_.height, "the height")};
      if (!turn(growing, own)) return {};
      for (std::size_t axis = 0; axis < 3; ++axis) size.at(axes_.axes.at(axis).of_file) = own.at(axis);
      return size;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const UsedColumn& column = plan_.extent.at(axis)) size.at(axis) = read_length(growing, column, "the size");
    if (!choices_.turns.empty() && !text(plan_.orientation).empty() && !turn_of_format(growing, size)) return {};
    return size;
  }

  /// Turns the sizes of an item along the axes of the file as its code says in the known format.
  bool turn_of_format(Growing& growing, std::array<std::optional<double>, 3>& size) {
    constexpr std::size_t kLetters = 4;  // of a code, with the blank after it
    const std::optional<long> code = parse_integer(text(plan_.orientation));
    const auto at = static_cast<std::size_t>(code.value_or(-1)) * kLetters;
    if (!code || *code < 0 || at >= choices_.turns.size()) {
      add_wrong(growing, plan_.orientation, "an orientation that the format does not have", "such as 0");
      return false;
    }
    const std::string_view letters = choices_.turns.substr(at, 3);
    const std::array own = size;
    for (std::size_t axis = 0; axis < 3; ++axis) size.at(axis) = own.at(static_cast<std::size_t>(letters[axis] - 'x'));
    return true;
  }

  /// Turns the sizes of an item as its orientation says: from its own length, width and height to those of the
  /// container.
  bool turn(Growing& growing, std::array<std::optional<double>, 3>& size) {
    const std::string code = lower_case(text(plan_.orientation));
    if (code.empty() || code == "0" || code == "180" || code == "false" || code == "xyz" || code == "lwh") return true;
    if (code == "1" || code == "true" || code == "90" || code == "270") {
      std::swap(size[0], size[1]);
      return true;
    }
    constexpr std::array<std::string_view, 2> kLetters = {"xyz", "lwh"};
    for (const std::string_view letters : kLetters) {
      if (code.size() != 3) break;
      const std::array<std::size_t, 3> from = {letters.find(code[0]), letters.find(code[1]), letters.find(code[2])};
      if (from[0] > 2 || from[1] > 2 || from[2] > 2 || from[0] == from[1] || from[1] == from[2] || from[0] == from[2])
        continue;
      size = {size.at(from[0]), size.at(from[1]), size.at(from[2])};
      return true;
    }
    Error error = rows_.at(plan_.orientation.index, "an orientation that is not known");
    error.value = shown(text(plan_.orientation));
    error.accepted =
        "0, 1 where length and width are exchanged, or letters such as YXZ; or columns with sizes as placed";
    growing.errors.add(std::move(error));
    return false;
  }

  void read_properties(Growing& growing, Box& box, Growing::OfBox& of_box) {
    const auto optional = [&](const UsedColumn& column, const char* what) {
      return text(column).empty() ? std::nullopt : read_number(growing, column, what);
    };
    const auto positive = [&](const UsedColumn& column, const char* what, double least) -> std::optional<double> {
      const auto number = optional(column, what);
      if (!number) return std::nullopt;
      double unit = column.unit > 0.0 || &column != &plan_.mass ? column.unit : context_.mass_unit;
      if (&column == &plan_.mass && plan_.mass_unit) unit = mass_unit(lower_case(text(plan_.mass_unit))).value_or(unit);
      const double value = unit > 0.0 ? *number * unit : *number;
      if (value >= least && value <= kMostOfLoad) return value;
      Error error = rows_.at(column.index, std::string(what) + " is not possible");
      error.value = shown(text(column));
      error.accepted = least > 0.0 ? "a number above 0" : "a number from 0";
      growing.errors.add(std::move(error));
      return std::nullopt;
    };
    box.mass = says_none(text(plan_.mass)) ? std::nullopt : positive(plan_.mass, "the mass", kLeastMass);
    if (const std::string mat = lower_case(text(plan_.mat)); mat.empty())
      box.mat.reset();
    else if (is_yes(mat))
      box.mat = kAntislipFriction;
    else if (!is_no(mat))
      box.mat = positive(plan_.mat, "the friction of the mat", 0.0);
    if (box.mat && text(plan_.mat).ends_with('%')) *box.mat /= 100.0;
    box.bearing_limit = positive(plan_.bearing_limit, "the bearing limit", 0.0);
    of_box.nesting = optional(plan_.nesting, "the nesting").value_or(0.0);
    if (plan_.nesting.unit > 0.0) of_box.nesting = in_metres(of_box.nesting, plan_.nesting.unit);
    const UsedColumn& order = plan_.order ? plan_.order : plan_.order_or_group;
    if (const std::string_view value = text(order); !value.empty()) {
      box.order = parse_integer(value);
      if (!box.order && (plan_.order || !order_is_load_))
        add_wrong(growing, order, "the loading order is not a whole number", "such as 1");
    }
    std::string_view material = text(plan_.material);
    if (material.empty() && type_ == TypeColumn::materials) material = text(plan_.type);
    if (!material.empty()) box.material = MaterialName(kept_name(material));
    if (const std::string_view value = text(plan_.fixed); !value.empty()) {
      const std::string word = lower_case(value);
      box.fixed = word == "1" || is_yes(word);
      if (!box.fixed && word != "0" && !is_no(word)) add_wrong(growing, plan_.fixed, "neither yes nor no", "yes or no");
    }
    if (const std::string_view value = text(plan_.quantity); !value.empty()) {
      const std::optional<double> quantity = parse_number(value);
      if (quantity && *quantity > 1.0) {
        ++several_;
        if (several_line_ == 0) several_line_ = rows_.line();
      }
    }
    std::string_view type = text(plan_.container);
    if (type.empty() && type_ == TypeColumn::containers) type = text(plan_.type);
    if (type.empty()) return;
    if (growing.type.empty()) growing.type = type;
    if (growing.type != type)
      add_wrong(growing, plan_.container ? plan_.container : plan_.type, "a second type of container",
                "one type per load");
  }

  /// Friction of an anti-slip mat of which a table says no more than that it is there: that of EN 12195-1.
  static constexpr double kAntislipFriction = 0.6;

  static bool is_yes(std::string_view word) {
    return word == "yes" || word == "true" || word == "x" || word == "ja" || word == "y";
  }
  static bool is_no(std::string_view word) {
    return word == "no" || word == "false" || word == "-" || word == "nein" || word == "n";
  }

  /// Whether the cell of a mass says that it is not known.
  static bool says_none(std::string_view cell) {
    const std::string word = lower_case(cell);
    return word == "-" || word == "n/a" || word == "na" || parse_number(word) == 0.0;
  }

  void add_wrong(Growing& growing, const UsedColumn& column, const char* what, const char* accepted) {
    if (growing.errors.full()) return growing.errors.count_more();
    Error error = rows_.at(column.index, what);
    error.value = shown(text(column));
    error.accepted = accepted;
    growing.errors.add(std::move(error));
  }

  /// The number of a cell; nothing, and an error, where there is none.
  std::optional<double> read_number(Growing& growing, const UsedColumn& column, const char* what) {
    const std::string_view cell = text(column);
    const auto [number, lacks_unit] = numbers_.read(column, cell);
    if (number) return number;
    if (growing.errors.full()) {
      growing.errors.count_more();
      return std::nullopt;
    }
    Error error =
        rows_.at(column.index, std::string(what) + (cell.empty() ? " is missing"
                                                    : lacks_unit ? " has no unit, as other cells of its column have"
                                                                 : " is not a number"));
    error.value = shown(cell);
    error.accepted = numbers_.has_decimal_commas() ? "a number such as 80 or 12,5; the table has decimal commas"
                                                   : "a number such as 80 or 12.5";
    growing.errors.add(std::move(error));
    return std::nullopt;
  }

  /// The unit of numbers whose header has none: the user's; that in which a container in the file is one; else cm.
  void find_unit() {
    unit_ = choices_.unit.value_or(context_.unit > 0.0 ? context_.unit : 0.01);
    if (choices_.unit || context_.unit > 0.0) return;
    for (const Growing& growing : loads_) {
      if (growing.size_unit > 0.0 || !growing.size[0] || !growing.size[1]) continue;
      std::optional<double> only;
      for (const double unit : {1.0, 0.01, 0.001}) {
        const double length = *growing.size[0] * unit;
        const double width = *growing.size[1] * unit;
        const bool is_one = std::min(length, width) >= 0.5 && std::max(length, width) >= kShortestContainer &&
                            std::max(length, width) <= kLongestContainer && std::min(length, width) <= 4.0;
        if (!is_one) continue;
        if (only) return;
        only = unit;
      }
      if (only && *only != unit_) {
        unit_ = *only;
        found_.notes.push_back({.file = context_.path,
                                .what = "no unit is stated: taken as " + length_unit_name(unit_),
                                .value = "the container is " + rounded_text(*growing.size[0]) + " x " +
                                         rounded_text(*growing.size[1]) + ' ' + length_unit_name(unit_),
                                .accepted = "--unit says another"});
      }
      return;
    }
  }

  /// Gives a load its container and its boxes their corners in it.
  void finish(Growing& growing) {
    Layout& layout = growing.load.layout;
    find_shape(growing);
    const Vec3 container = container_of(settings_, layout).size;
    std::vector<double> nesting;
    const bool knows_units = std::all_of(growing.of_boxes.begin(), growing.of_boxes.end(),
                                         [](const Growing::OfBox& of_box) { return of_box.unit > 0.0; });
    growing.load.guessed_unit = choices_.unit || context_.unit > 0.0 || knows_units ? 0.0 : unit_;
    for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
      Box& box = layout.boxes[i];
      const Growing::OfBox& of_box = growing.of_boxes[i];
      const double unit = of_box.unit > 0.0 ? of_box.unit : unit_;
      for (Vec3* const corner : {&box.corner_min, &box.corner_max})
        for (double& length : *corner) length = in_metres(length, unit);
      std::tie(box.corner_min, box.corner_max) = axes_.corners(box.corner_min, box.corner_max, container);
      if (plan_.nesting) nesting.push_back(plan_.nesting.unit > 0.0 ? of_box.nesting : in_metres(of_box.nesting, unit));
    }
    growing.load.errors = growing.errors.take();
    if (growing.load.errors.empty() && layout.boxes.empty())
      growing.load.errors.push_back({.file = context_.path, .what = "has no boxes", .value = layout.name});
    if (growing.load.errors.empty() && plan_.nesting) nest_boxes(layout, nesting, settings_);
    if (plan_.mass && growing.load.errors.empty() &&
        std::none_of(layout.boxes.begin(), layout.boxes.end(), [](const Box& box) { return box.mass; }))
      growing.load.warnings.push_back({.file = context_.path,
                                       .what = "no box has a weight, though there is a column for it",
                                       .value = shown(rows_.headers()[static_cast<std::size_t>(plan_.mass.index)]),
                                       .accepted = "those of their material or of their volume are taken"});
    found_.loads.push_back(std::move(growing.load));
  }

  void find_shape(Growing& growing) {
    ContainerShape shape = settings_.container;
    shape.type.clear();
    bool has_own = false;
    if (const ContainerType* const type = find_container(growing.type)) {
      shape = type->shape();
      has_own = true;
    } else if (!growing.type.empty()) {
      growing.load.warnings.push_back(
          {.file = context_.path,
           .what = "a type of container that the catalogue does not have",
           .value = shown(growing.type),
           .accepted = "the container of the run is taken; `holdfast containers` lists types"});
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!growing.size.at(axis)) continue;
      const double unit = growing.size_unit > 0.0 ? growing.size_unit : unit_;
      const double length = in_metres(*growing.size.at(axis), unit);
      constexpr double kLeast = 0.01;
      constexpr double kMost = 1000.0;
      if (length < kLeast || length > kMost) {
        growing.errors.add({.what = "the container of " + shown(growing.load.layout.name) + " has no possible size",
                            .value = rounded_text(length) + " m",
                            .accepted = "from 1 cm to 1 km"});
        continue;
      }
      shape.size[static_cast<Eigen::Index>(axis)] = length;
      has_own = true;
    }
    if (has_own) growing.load.layout.container = shape;
  }

  void note_rows() {
    if (several_ > 0)
      found_.notes.push_back({.file = context_.path,
                              .line = several_line_,
                              .what = std::to_string(several_) + (several_ == 1 ? " row is" : " rows are") +
                                      " of more than one box, and taken as one",
                              .accepted = "a row with a place of its own for each box"});
    if (unplaced_ > 0) {
      std::string names;
      for (const std::string& name : unplaced_names_) names += (names.empty() ? "" : ", ") + shown(name);
      if (unplaced_ > unplaced_names_.size() && !names.empty()) names += ", ...";
      found_.notes.push_back(
          {.file = context_.path,
           .what = std::to_string(unplaced_) + (unplaced_ == 1 ? " item is not placed" : " items are not placed"),
           .value = names});
    }
  }

  LoadRows& rows_;
  ColumnPlan plan_;
  const TableContext& context_;
  const TableChoices& choices_;
  const Settings& settings_;
  CellNumbers numbers_;
  FileAxes axes_;
  double unit_ = 0.01;  ///< of numbers whose header has none, m
  bool order_is_load_ = false;
  TypeColumn type_ = TypeColumn::unknown;
  bool group_is_unit_ = false;  ///< the column of groups tells units of lengths
  std::string last_load_;       ///< name of the load of the row before
  std::size_t several_ = 0;     ///< rows of more than one box
  long several_line_ = 0;       ///< of the first of them
  std::deque<Growing> loads_;
  std::map<std::string, std::size_t, std::less<>> places_;  ///< of loads, by their names in the table
  std::map<std::string, std::size_t, std::less<>>::iterator last_place_ = places_.end();
  std::size_t unplaced_ = 0;
  std::vector<std::string> unplaced_names_;
  LoadsOfFile found_;
};

}  // namespace

bool is_container_name(std::string_view name) {
  const bool has_letter = std::any_of(name.begin(), name.end(),
                                      [](char letter) { return (letter | 0x20) >= 'a' && (letter | 0x20) <= 'z'; });
  const ContainerType* const type = find_container(name);
  if (!has_letter || type == nullptr || type->name.starts_with("pallet")) return false;
  return lower_case(name) == type->name || (name.front() >= '0' && name.front() <= '9');
}

Result<TableChoices> TableChoices::of(const Settings& settings) {
  TableChoices choices;
  choices.axes = settings.loads.axes;
  choices.unit = settings.loads.unit;
  std::string columns;
  if (!settings.loads.format.empty()) {
    const auto known = std::find_if(kKnownFormats.begin(), kKnownFormats.end(),
                                    [&](const KnownFormat& format) { return format.name == settings.loads.format; });
    if (known == kKnownFormats.end()) {
      std::string names;
      for (const KnownFormat& format : kKnownFormats) names += (names.empty() ? "" : ", ") + std::string(format.name);
      return Error{
          .what = "unknown format of tables", .value = settings.loads.format, .accepted = "accepted are " + names};
    }
    columns = known->columns;
    choices.turns = known->turns;
    if (!choices.axes && !known->axes.empty()) choices.axes = parse_axes(known->axes);
    if (!choices.unit && !known->unit.empty()) choices.unit = length_unit(known->unit);
  }
  // Later choices hold.
  choices.columns = *parse_column_choice(columns);
  for (ColumnChoice& choice : choices.columns) choice.needed = false;
  const auto of_user = parse_column_choice(settings.loads.columns);
  if (!of_user) return of_user.errors();
  choices.columns.insert(choices.columns.end(), of_user->begin(), of_user->end());
  return choices;
}

LoadsOfFile read_table(LoadRows& rows, const ColumnPlan& plan, const TableContext& context, const TableChoices& choices,
                       const Settings& settings) {
  return TableReader(rows, plan, context, choices, settings).read();
}

}  // namespace holdfast::internal
