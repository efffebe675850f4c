#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// What one entry of a dataset belongs to. All datasets of an axis have the same length.
enum class Axis : std::uint8_t {
  worlds,
  boxes,
  samples,
  rows,
  layouts,
  layout_boxes,
  accelerations,
  segments,
};
inline constexpr std::size_t kAxisCount = 8;

/// Name of the axis as above.
std::string_view to_string(Axis axis);

/// The axes whose length grows with the numbers of boxes and samples, not only with those of worlds and layouts.
inline constexpr std::array<Axis, 4> kLongAxes = {Axis::boxes, Axis::samples, Axis::rows, Axis::layout_boxes};

/// The axes along which successive worlds add entries: all but those of the accelerations, which are of the run.
inline constexpr std::array<Axis, 6> kGrowingAxes = {Axis::worlds, Axis::boxes,   Axis::samples,
                                                     Axis::rows,   Axis::layouts, Axis::layout_boxes};

/// One number per axis.
using AxisCounts = std::array<std::uint64_t, kAxisCount>;
inline std::uint64_t& at(AxisCounts& counts, Axis axis) { return counts[static_cast<std::size_t>(axis)]; }
inline std::uint64_t at(const AxisCounts& counts, Axis axis) { return counts[static_cast<std::size_t>(axis)]; }

/// Type of the numbers of a dataset. Text is UTF-8 of fixed length, as long as the longest value needs, padded with
/// zero bytes. A label is text of `kLabelBytes`, so that a long axis may have it.
enum class ElementType : std::uint8_t { u8, u32, u64, i32, f32, f64, label, text };

/// Bytes of a label: the longest name of a box.
inline constexpr std::size_t kLabelBytes = 120;

/// Size of one number, bytes; 0 for text, whose length varies from file to file.
std::size_t size_of(ElementType type);

/// Name as in numpy: "float32"; "text".
std::string_view to_string(ElementType type);

/// Origin of a dataset: recorded in the simulation, or derived from it with thresholds.
enum class Origin : std::uint8_t { recorded, derived };

struct AnalysisTables;

/// What a dataset holds.
struct DatasetContent {
  std::string_view path;
  Axis axis;
  std::string_view units;  ///< "1": a number without unit; "none": text
  std::string_view description;
  std::uint64_t since = 1;  ///< version of the file that has it first
};

/// One dataset of the results file.
struct DatasetSpec : DatasetContent {
  ElementType type;
  std::size_t width;  ///< numbers per entry: 1, or the length of the second dimension
  Origin origin = Origin::recorded;
  const AnalysisTables* analysis = nullptr;  ///< the dataset is there where a run was asked for it; null: always
};

/// Entries per chunk of a long axis: 64 KiB of one float32 column of a series, 192 KiB of a vector column. Fewer for
/// boxes, because every part repeats the start of its first chunks.
constexpr std::uint64_t chunk_entries(Axis axis) { return axis == Axis::samples || axis == Axis::rows ? 16384 : 4096; }

/// Start of the chunk that contains an entry of a long axis.
constexpr std::uint64_t chunk_begin(Axis axis, std::uint64_t entry) { return entry - entry % chunk_entries(axis); }

/// Largest chunk of any other dataset, bytes.
inline constexpr std::size_t kTableChunkBytes = std::size_t{256} << 10U;

/// Largest chunk that is read, bytes. HDF5 keeps one of at most 1 MB between two reads, and unpacks a larger one for
/// each.
inline constexpr std::size_t kMostChunkBytes = std::size_t{1} << 20U;

/// Other datasets with at most this many bytes are stored without chunks: a chunk and its index take more.
inline constexpr std::size_t kWholeTableBytes = 1024;

/// Version of the layout of the file; it is raised when a reader of the old layout would misread the new one.
/// Version 2 has max_residual in m/s, and its scale beside it; version 1 has the ratio of the two. Version 3 has what
/// boxes ever did, by which worlds are judged; in earlier versions they are judged by where boxes are at the end.
inline constexpr std::uint64_t kFormatVersion = 3;
inline constexpr std::string_view kFormatName = "holdfast results";

/// Every dataset of the file, in the order in which they are written. The writer, the assembler, the reader,
/// docs/reference/results_file.md and the tests all use this table.
const std::vector<DatasetSpec>& schema();

/// Index of a dataset in `schema`; the path must be in the table.
std::size_t dataset_index(std::string_view path);

/// The dataset of that path, which must be in the table.
inline const DatasetSpec& dataset_spec(std::string_view path) { return schema()[dataset_index(path)]; }

/// True for the datasets of a long axis, which are divided into chunks of `chunk_entries`.
inline bool is_long(const DatasetSpec& spec) {
  return std::find(kLongAxes.begin(), kLongAxes.end(), spec.axis) != kLongAxes.end();
}

/// A dataset that every file has, and whose length is that of the axis.
const DatasetSpec& representative(Axis axis);

/// Indices in `schema` of the long datasets, in increasing order.
const std::vector<std::size_t>& long_datasets();

/// The type of the entries of a member: of a column, that of its entries.
template <class Member>
struct EntryOfMember {
  using Type = Member;
};
template <class Entry>
struct EntryOfMember<std::vector<Entry>> {
  using Type = Entry;
};
template <class Member>
using EntryOf = typename EntryOfMember<Member>::Type;

template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;

/// Element type as which a C++ type is stored.
template <class T>
constexpr ElementType element_type_of() {
  if constexpr (std::is_enum_v<T>) {
    return element_type_of<std::underlying_type_t<T>>();
  } else if constexpr (std::is_same_v<T, std::uint8_t> || std::is_same_v<T, bool>) {
    return ElementType::u8;
  } else if constexpr (kIsArray<T>) {
    return element_type_of<typename T::value_type>();
  } else if constexpr (std::is_same_v<T, std::uint32_t>) {
    return ElementType::u32;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return ElementType::u64;
  } else if constexpr (std::is_same_v<T, std::int32_t>) {
    return ElementType::i32;
  } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>) {
    return ElementType::f64;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return ElementType::text;
  } else {
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, Float3> || std::is_same_v<T, Float4>);
    return ElementType::f32;
  }
}

/// Numbers of a C++ type per entry.
template <class T>
constexpr std::size_t width_of() {
  if constexpr (kIsArray<T>)
    return std::tuple_size_v<T> * width_of<typename T::value_type>();
  else if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, Float3>)
    return 3;
  else
    return std::is_same_v<T, Float4> ? 4 : 1;
}

}  // namespace holdfast::internal
