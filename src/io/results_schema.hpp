#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "core/status.hpp"
#include "core/vector.hpp"
#include "core/world_record.hpp"

namespace holdfast {

/// What the entries of a dataset stand for, one each. All datasets of an axis have the same length.
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

/// Type of the numbers of a dataset. Text is UTF-8 of fixed length, as long as the longest value needs, padded with
/// zero bytes.
enum class ElementType : std::uint8_t { u8, u32, u64, i32, f32, f64, text };

/// Size of one number, bytes; 0 for text, whose length varies from file to file.
std::size_t size_of(ElementType type);

/// Name as in numpy: "float32"; "text".
std::string_view to_string(ElementType type);

/// When a dataset is written: with the worlds, or derived from them at the end.
enum class Origin : std::uint8_t { recorded, derived };

/// One dataset of the results file.
struct DatasetSpec {
  std::string_view path;
  ElementType type;
  std::size_t width;  ///< numbers an entry: 1, or the length of the second dimension
  Axis axis;
  std::string_view units;  ///< "1": a number without unit; "none": text
  std::string_view description;
  Origin origin = Origin::recorded;
  /// For a column of indices into another axis, that axis; else its own. In a part such indices count from the
  /// part's first entry.
  Axis refers_to = axis;
};

/// Entries a chunk of a series dataset holds: 64 KiB of one float32 column, 192 KiB of a vector.
inline constexpr std::uint64_t kChunkEntries = 16384;

/// Most bytes of a chunk of any other dataset.
inline constexpr std::size_t kTableChunkBytes = std::size_t{256} << 10U;

/// Version of the layout of the file; raised when a reader of the old layout would go wrong.
inline constexpr std::uint64_t kFormatVersion = 1;
inline constexpr std::string_view kFormatName = "holdfast results";

/// Number of datasets in the schema.
inline constexpr std::size_t kDatasetCount = 76;

/// Every dataset of the file, in the order in which they are written. The writer, the assembler, the reader,
/// docs/results_file.md and the tests all go by this table.
extern const std::array<DatasetSpec, kDatasetCount> kSchema;

/// Place of a dataset in `kSchema`; the path must be one of the table.
std::size_t dataset_index(std::string_view path);

/// The dataset of that path, which must be one of the table.
inline const DatasetSpec& dataset_spec(std::string_view path) { return kSchema[dataset_index(path)]; }

/// True for the datasets under /series, which are cut into chunks of `kChunkEntries`.
inline bool is_series(const DatasetSpec& spec) { return spec.axis == Axis::samples || spec.axis == Axis::rows; }

/// Place in `kSchema` of the first dataset under /series; the others follow it.
std::size_t first_series_dataset();

/// Element type and width as which a C++ type is stored.
template <class T>
constexpr ElementType element_type_of() {
  if constexpr (std::is_enum_v<T>) {
    return element_type_of<std::underlying_type_t<T>>();
  } else if constexpr (std::is_same_v<T, std::uint8_t>) {
    return ElementType::u8;
  } else if constexpr (std::is_same_v<T, std::uint32_t>) {
    return ElementType::u32;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return ElementType::u64;
  } else if constexpr (std::is_same_v<T, std::int32_t>) {
    return ElementType::i32;
  } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>) {
    return ElementType::f64;
  } else {
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, Float3> || std::is_same_v<T, Float4>);
    return ElementType::f32;
  }
}

}  // namespace holdfast
