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
#include "io/loads/known_formats.hpp"

namespace holdfast::internal {

namespace {

/// Inner lengths that a container may have, m: of a pallet, and of the longest vehicle.
constexpr double kShortestContainer = 0.8;
constexpr double kLongestContainer = 25.0;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return result;
}

template <class Words>
bool is_one_of(std::string_view text, const Words& words) {
  const std::string word = lower(text);
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
      : rows_(rows), plan_(plan), context_(context), choices_(choices), settings_(settings) {
    axes_ = choices.axes.value_or(axes_of(settings));
  }

  LoadsOfFile read() {
    choose_load_column();
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
    note_rows();
    return std::move(found_);
  }

 private:
  void choose_load_column() {
    if (plan_.load) return;
    if (!plan_.order_or_load) return;
    // The loads of `order` come one after the other, and their names repeat; places in a loading order do not.
    std::map<std::string, int, std::less<>> seen;
    bool repeats = false;
    while (!repeats && rows_.next()) {
      const std::string_view value = rows_.cell(plan_.order_or_load.index);
      repeats = !value.empty() && ++seen[std::string(value)] > 1;
    }
    rows_.restart();
    order_is_load_ = repeats;
  }

  std::string_view text(const UsedColumn& column) const {
    return column ? rows_.cell(column.index) : std::string_view();
  }

  void read_row() {
    const std::string_view type = text(plan_.type);
    if (type_ == TypeColumn::unknown && !type.empty()) {
      type_ = is_one_of(type, kContainerWords) || is_one_of(type, kBoxWords) ? TypeColumn::rows
              : find_container(type) != nullptr                              ? TypeColumn::containers
                                                                             : TypeColumn::materials;
    }
    if (type_ == TypeColumn::rows && is_one_of(type, kContainerWords) && !is_one_of(type, kBoxWords))
      return read_container_row();
    if (is_unplaced()) {
      ++unplaced_;
      if (unplaced_names_.size() < 3 && !text(plan_.name).empty()) unplaced_names_.emplace_back(text(plan_.name));
      return;
    }
    read_box();
  }

  bool is_unplaced() const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!text(plan_.low.at(axis)).empty() || !text(plan_.middle.at(axis)).empty()) return false;
    return true;
  }

  std::string_view load_name() const {
    const UsedColumn& column = plan_.load ? plan_.load : order_is_load_ ? plan_.order_or_load : UsedColumn{};
    return column ? rows_.cell(column.index) : std::string_view(context_.load);
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
      growing.type = context_.container;
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
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      const UsedColumn& low = plan_.low.at(axis);
      const UsedColumn& middle = plan_.middle.at(axis);
      const UsedColumn& high = plan_.high.at(axis);
      const auto place = read_number(growing, low ? low : middle, low ? "the place" : "the middle");
      std::optional<double> end;
      if (high && low && !size.at(axis)) {
        end = read_number(growing, high, "the second corner");
        if (place && end) size.at(axis) = *end - *place;
      }
      if (!place || !size.at(axis)) return false;
      box.corner_min[k] = low ? *place : *place - 0.5 * *size.at(axis);
      box.corner_max[k] = end ? *end : box.corner_min[k] + *size.at(axis);
      for (const UsedColumn& column : {low, middle, high, plan_.extent.at(axis), plan_.length})
        if (column && column.unit > 0.0) of_box.unit = column.unit;
    }
    return true;
  }

  /// Extents along the axes of the file, as placed; nothing along axes whose corners tell.
  std::array<std::optional<double>, 3> read_size(Growing& growing) {
    std::array<std::optional<double>, 3> size;
    if (plan_.length && plan_.width && plan_.height && !(plan_.extent[0] && plan_.extent[1] && plan_.extent[2])) {
      std::array<std::optional<double>, 3> own = {read_number(growing, plan_.length, "the length"),
                                                  read_number(growing, plan_.width, "the width"),
                                                  read_number(growing, plan_.height, "the height")};
      if (!turn(growing, own)) return {};
      for (std::size_t axis = 0; axis < 3; ++axis) size.at(axes_.axes.at(axis).of_file) = own.at(axis);
      return size;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const UsedColumn& column = plan_.extent.at(axis)) size.at(axis) = read_number(growing, column, "the size");
    return size;
  }

  /// Turns the sizes of an item as its orientation says: from its own length, width and height to those of the
  /// container.
  bool turn(Growing& growing, std::array<std::optional<double>, 3>& size) {
    const std::string code = lower(text(plan_.orientation));
    if (code.empty() || code == "0" || code == "false" || code == "xyz" || code == "lwh") return true;
    if (code == "1" || code == "true" || code == "90") {
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
      const double value = column.unit > 0.0 ? *number * column.unit : *number;
      if (value >= least && value <= kMostOfLoad) return value;
      Error error = rows_.at(column.index, std::string(what) + " is not possible");
      error.value = shown(text(column));
      error.accepted = least > 0.0 ? "a number above 0" : "a number from 0";
      growing.errors.add(std::move(error));
      return std::nullopt;
    };
    box.mass = positive(plan_.mass, "the mass", kLeastMass);
    box.mat = positive(plan_.mat, "the friction of the mat", 0.0);
    box.bearing_limit = positive(plan_.bearing_limit, "the bearing limit", 0.0);
    of_box.nesting = optional(plan_.nesting, "the nesting").value_or(0.0);
    if (plan_.nesting.unit > 0.0) of_box.nesting = in_metres(of_box.nesting, plan_.nesting.unit);
    const UsedColumn& order = plan_.order ? plan_.order : order_is_load_ ? UsedColumn{} : plan_.order_or_load;
    if (const std::string_view value = text(order); !value.empty()) {
      box.order = parse_integer(value);
      if (!box.order) add_wrong(growing, order, "the loading order is not a whole number", "such as 1");
    }
    std::string_view material = text(plan_.material);
    if (material.empty() && type_ == TypeColumn::materials) material = text(plan_.type);
    if (!material.empty()) box.material = MaterialName(kept_name(material));
    if (const std::string_view value = text(plan_.fixed); !value.empty()) {
      const std::string word = lower(value);
      box.fixed = word == "1" || word == "yes" || word == "true" || word == "x";
      if (!box.fixed && word != "0" && word != "no" && word != "false")
        add_wrong(growing, plan_.fixed, "neither yes nor no", "yes or no");
    }
    std::string_view type = text(plan_.container);
    if (type.empty() && type_ == TypeColumn::containers) type = text(plan_.type);
    if (type.empty()) return;
    if (growing.type.empty()) growing.type = type;
    if (growing.type != type)
      add_wrong(growing, plan_.container ? plan_.container : plan_.type, "a second type of container",
                "one type per load");
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
    const std::string_view written = text(column);
    std::optional<double> number = parse_number(written);
    if (rows_.may_have_decimal_commas()) {
      const bool has_comma = written.find(',') != std::string_view::npos;
      const bool has_point = written.find('.') != std::string_view::npos;
      if (has_comma && !has_point) {
        std::string with_point(written);
        with_point[with_point.find(',')] = '.';
        number = parse_number(with_point);
      }
      if (number && (has_comma || has_point)) {
        if (decimal_mark_ == 0) decimal_mark_ = has_comma ? ',' : '.';
        if (decimal_mark_ != (has_comma ? ',' : '.')) number.reset();
      }
    }
    constexpr double kFarthest = 1e9;
    if (number && std::abs(*number) <= kFarthest) return number;
    if (growing.errors.full()) {
      growing.errors.count_more();
      return std::nullopt;
    }
    Error error = rows_.at(column.index, std::string(what) + (written.empty() ? " is missing" : " is not a number"));
    error.value = shown(written);
    error.accepted = decimal_mark_ == ',' ? "a number such as 80 or 12,5; the table has decimal commas"
                                          : "a number such as 80 or 12.5";
    growing.errors.add(std::move(error));
    return std::nullopt;
  }

  /// The unit of numbers whose header has none: the user's; that in which a container in the file is one; else cm.
  void find_unit() {
    unit_ = choices_.unit.value_or(0.01);
    if (choices_.unit) return;
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
    growing.load.guessed_unit = choices_.unit || knows_units ? 0.0 : unit_;
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
  const ColumnPlan& plan_;
  const TableContext& context_;
  const TableChoices& choices_;
  const Settings& settings_;
  FileAxes axes_;
  double unit_ = 0.01;  ///< of numbers whose header has none, m
  bool order_is_load_ = false;
  TypeColumn type_ = TypeColumn::unknown;
  char decimal_mark_ = 0;  ///< that has been seen; 0: none yet
  std::deque<Growing> loads_;
  std::map<std::string, std::size_t, std::less<>> places_;  ///< of loads, by their names in the table
  std::map<std::string, std::size_t, std::less<>>::iterator last_place_ = places_.end();
  std::size_t unplaced_ = 0;
  std::vector<std::string> unplaced_names_;
  LoadsOfFile found_;
};

}  // namespace

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
