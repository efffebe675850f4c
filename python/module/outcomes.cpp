#include "outcomes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>

namespace py = pybind11;

namespace holdfast::python {

namespace {

/// The columns of a structured array, each of which says something of objects of type `Source`.
template <class Source>
class Columns {
 public:
  /// Adds a column. What it says of an object is what a lambda without captures gives: a number, or an array of
  /// numbers.
  template <class Value>
  void add(const char* name, Value) {
    using Number = std::decay_t<std::invoke_result_t<Value, const Source&>>;
    place<Number>(name, 0, [](const Source& source, std::size_t /*index*/, std::byte* to) {
      const Number number = Value()(source);
      std::memcpy(to, &number, sizeof number);
    });
  }

  /// Adds a number of the analyses as a column of that type.
  template <class Number>
  void add_number(const std::string& name, std::size_t index) {
    place<Number>(name, index, [](const Source& source, std::size_t i, std::byte* to) {
      const auto number = static_cast<Number>(source.numbers[i]);
      std::memcpy(to, &number, sizeof number);
    });
  }

  /// Makes the type of an entry. Called once, after the last column.
  void complete() {
    size_ = aligned(size_, alignment_);
    entry_type_ = py::dtype(names_, types_, offsets_, static_cast<py::ssize_t>(size_));
  }

  /// An array of entries, all of whose numbers are 0.
  py::array zeros(const std::vector<std::size_t>& shape) const {
    py::array array(entry_type_, shape);
    std::memset(array.mutable_data(), 0, static_cast<std::size_t>(array.nbytes()));
    return array;
  }

  void write(const Source& source, py::array& to, std::size_t entry) const {
    std::byte* const begin = static_cast<std::byte*>(to.mutable_data()) + entry * size_;
    for (const Writer& writer : writers_) writer.write(source, writer.index, begin + writer.offset);
  }

 private:
  using Write = void (*)(const Source& source, std::size_t index, std::byte* to);
  struct Writer {
    std::size_t offset, index;
    Write write;
  };

  template <class Number>
  void place(const std::string& name, std::size_t index, Write writer) {
    size_ = aligned(size_, alignof(Number));
    names_.append(name);
    types_.append(py::dtype::of<Number>());
    offsets_.append(size_);
    writers_.push_back({size_, index, writer});
    size_ += sizeof(Number);
    alignment_ = std::max(alignment_, alignof(Number));
  }

  static std::size_t aligned(std::size_t offset, std::size_t alignment) {
    return (offset + alignment - 1) / alignment * alignment;
  }

  std::size_t size_ = 0, alignment_ = 1;
  py::list names_, types_, offsets_;
  std::vector<Writer> writers_;
  py::dtype entry_type_;
};

/// A box of a world.
struct WorldBox {
  const WorldOutcome& world;
  std::size_t box;
};

// Made with the module and never destroyed: Python has ended before they would be.
const Columns<WorldOutcome>* world_columns = nullptr;
const Columns<WorldBox>* box_columns = nullptr;

constexpr float kUnknownFloat = std::numeric_limits<float>::quiet_NaN();

/// What impacts did to a box.
float damage_of(const WorldBox& of, std::vector<float> DamageOutcome::*column) {
  return of.world.damage.known ? (of.world.damage.*column)[of.box] : kUnknownFloat;
}
bool is_beyond(const WorldBox& of) { return of.world.damage.known && of.world.damage.box_beyond[of.box] != 0; }

// As in C, messages are no numbers but come from a function: `messages_of`.
#define HOLDFAST_WORLD_COLUMN(scope, type, name, ...) \
  HOLDFAST_IF_C_##scope(columns.add(#name, [](const WorldOutcome& world) { return world.name; });)
#define HOLDFAST_BOX_COLUMN(scope, type, name, ...) \
  HOLDFAST_IF_C_##scope(columns.add(#name, [](const WorldBox& of) { return of.world.box_outcomes[of.box].name; });)

void add_world_columns(Columns<WorldOutcome>& columns) {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_WORLD_COLUMN)
  const std::vector<AnalysisNumber> numbers = analysis_numbers();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto& [name, type, sentence] = numbers[i];
    if (type == "u1")
      columns.add_number<std::uint8_t>(name, i);
    else if (type == "u4")
      columns.add_number<std::uint32_t>(name, i);
    else if (type == "f4")
      columns.add_number<float>(name, i);
    else
      columns.add_number<double>(name, i);
  }
}

void add_box_columns(Columns<WorldBox>& columns) {
  HOLDFAST_BOX_FIELDS(HOLDFAST_BOX_COLUMN)
  HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_BOX_COLUMN)
  columns.add("peak_acceleration",
              [](const WorldBox& of) { return damage_of(of, &DamageOutcome::box_peak_acceleration); });
  columns.add("velocity_change", [](const WorldBox& of) { return damage_of(of, &DamageOutcome::box_velocity_change); });
  columns.add("beyond", [](const WorldBox& of) { return is_beyond(of); });
}

/// Columns that live as long as the process.
template <class Source>
const Columns<Source>* made(void (*add_columns)(Columns<Source>&)) {
  auto columns = std::make_unique<Columns<Source>>();
  add_columns(*columns);
  columns->complete();
  return columns.release();
}

/// An array in the memory of a vector, which lives as long as the array.
template <class Number, class Entry>
py::array_t<Number> array_in(std::vector<Entry>&& entries, std::vector<std::size_t> shape) {
  auto owner = std::make_unique<std::vector<Entry>>(std::move(entries));
  const auto* const data = reinterpret_cast<const Number*>(owner->data());
  const py::capsule capsule(owner.get(), [](void* vector) { delete static_cast<std::vector<Entry>*>(vector); });
  static_cast<void>(owner.release());  // is the capsule's now
  return py::array_t<Number>(std::move(shape), data, capsule);
}

}  // namespace

void declare_row_types() {
  world_columns = made(add_world_columns);
  box_columns = made(add_box_columns);
}

py::array table_of(std::span<const WorldOutcome> worlds, const std::vector<std::size_t>& shape) {
  py::array table = world_columns->zeros(shape);
  for (std::size_t i = 0; i < worlds.size(); ++i) world_columns->write(worlds[i], table, i);
  return table;
}

py::dict messages_of(std::span<const WorldOutcome> worlds) {
  py::dict messages;
  for (const WorldOutcome& world : worlds)
    if (!world.message.empty()) messages[py::make_tuple(world.layout, world.acceleration)] = world.message;
  return messages;
}

py::list boxes_of(std::span<const WorldOutcome> worlds, std::size_t accelerations) {
  py::list all;
  for (; worlds.size() >= accelerations; worlds = worlds.subspan(accelerations)) {
    const std::span<const WorldOutcome> of_layout = worlds.first(accelerations);
    std::size_t boxes = 0;  // the same in all that were simulated
    for (const WorldOutcome& world : of_layout) boxes = std::max(boxes, world.box_outcomes.size());
    py::array table = box_columns->zeros({accelerations, boxes});
    for (std::size_t world = 0; world < accelerations; ++world) {
      for (std::size_t i = 0; i < of_layout[world].box_outcomes.size(); ++i)
        box_columns->write({of_layout[world], i}, table, world * boxes + i);
    }
    all.append(table);
  }
  return all;
}

py::tuple series_of(Series&& series, std::size_t boxes) {
  const std::size_t samples = series.time.size();
  return py::make_tuple(array_in<double>(std::move(series.time), {samples}),
                        array_in<float>(std::move(series.displacement), {samples, boxes, 3}),
                        array_in<float>(std::move(series.orientation), {samples, boxes, 4}),
                        array_in<float>(std::move(series.angular_velocity), {samples, boxes, 3}));
}

}  // namespace holdfast::python
