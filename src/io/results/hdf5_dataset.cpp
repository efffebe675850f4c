#include <algorithm>
#include <array>
#include <cassert>

#include "io/results/hdf5_file.hpp"

namespace holdfast::internal::h5 {

namespace {

hid_t stored_type(ElementType type) {
  switch (type) {
    case ElementType::u8:
      return H5T_STD_U8LE;
    case ElementType::u32:
      return H5T_STD_U32LE;
    case ElementType::u64:
      return H5T_STD_U64LE;
    case ElementType::i32:
      return H5T_STD_I32LE;
    case ElementType::f32:
      return H5T_IEEE_F32LE;
    case ElementType::f64:
      return H5T_IEEE_F64LE;
    case ElementType::label:
    case ElementType::text:
      break;
  }
  return H5T_C_S1;
}

Id type_of(const DatasetSpec& spec, std::size_t text_size) {
  Id type(H5Tcopy(stored_type(spec.type)), H5Tclose);
  if (spec.type == ElementType::text || spec.type == ElementType::label) {
    H5Tset_size(type, text_size);
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
  }
  return type;
}

/// Deflate expands one byte to at most 1032 bytes.
constexpr std::uint64_t kMostInflation = 1032;

/// Longest text that is read from a column, bytes.
constexpr std::size_t kMostTextBytes = std::size_t{1} << 20U;

std::string parent_of(std::string_view path) { return std::string(path.substr(0, path.rfind('/'))); }

}  // namespace

void Dataset::fail(const std::string& what) const { file_->fail(what + " (" + std::string(spec_->path) + ")"); }

Dataset Dataset::create(const File& file, const DatasetSpec& spec, std::uint64_t length, std::size_t text_size) {
  Dataset dataset(file, spec);
  dataset.length_ = length;
  dataset.number_bytes_ = spec.type == ElementType::text ? std::max<std::size_t>(text_size, 1) : size_of(spec.type);
  const std::uint64_t most = std::max<std::uint64_t>(kTableChunkBytes / dataset.entry_bytes(), 1);
  dataset.chunk_entries_ =
      is_long(spec) ? holdfast::internal::chunk_entries(spec.axis) : std::clamp<std::uint64_t>(length, 1, most);

  const int rank = spec.width == 1 ? 1 : 2;
  const std::array<hsize_t, 2> extent = {length, spec.width};
  // A long dataset may end inside a chunk, and its length in a part is not known in advance; this needs an unlimited
  // dimension.
  const std::array<hsize_t, 2> limit = {is_long(spec) ? H5S_UNLIMITED : length, spec.width};
  const std::array<hsize_t, 2> chunk = {dataset.chunk_entries_, spec.width};
  const Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  dataset.whole_ = !is_long(spec) && length > 0 && length * dataset.entry_bytes() <= kWholeTableBytes;
  if (dataset.whole_) {
    H5Pset_layout(creation, H5D_COMPACT);
  } else if (length > 0 || is_long(spec)) {
    H5Pset_chunk(creation, rank, chunk.data());
    if (dataset.number_bytes_ > 1) H5Pset_shuffle(creation);
    H5Pset_deflate(creation, 1);
  }
  const Id space(H5Screate_simple(rank, extent.data(), limit.data()), H5Sclose);

  const std::string path(spec.path);
  make_group(file, parent_of(spec.path));
  const Id type = type_of(spec, dataset.number_bytes_);
  dataset.id_ = Id(H5Dcreate2(file.id(), path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  if (dataset.id_ < 0) dataset.fail("cannot be written");
  write_attribute(file, dataset.id_, path, "units", spec.units);
  write_attribute(file, dataset.id_, path, "description", spec.description);
  return dataset;
}

Dataset Dataset::open(const File& file, const DatasetSpec& spec) {
  Dataset dataset(file, spec);
  dataset.id_ = Id(H5Dopen2(file.id(), std::string(spec.path).c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset.id_ < 0) dataset.fail("lacks a dataset");

  const Id type(H5Dget_type(dataset.id_), H5Tclose);
  dataset.number_bytes_ = H5Tget_size(type);
  const bool is_string = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
  const bool type_fits = spec.type == ElementType::text    ? is_string
                         : spec.type == ElementType::label ? is_string && dataset.number_bytes_ == kLabelBytes
                                                           : H5Tequal(type, stored_type(spec.type)) > 0;
  const Id space(H5Dget_space(dataset.id_), H5Sclose);
  std::array<hsize_t, 2> extent = {0, 1};
  const int rank = spec.width == 1 ? 1 : 2;
  const bool shape_fits =
      H5Sget_simple_extent_ndims(space) == rank && H5Sget_simple_extent_dims(space, extent.data(), nullptr) == rank &&
      (extent[1] == spec.width ||
       (extent[1] < spec.width && (spec.type == ElementType::f32 || spec.type == ElementType::f64)));
  if (!type_fits || !shape_fits) dataset.fail("has a dataset of a wrong type or shape");
  dataset.length_ = extent[0];
  dataset.width_ = extent[1];

  const Id creation(H5Dget_create_plist(dataset.id_), H5Pclose);
  std::array<hsize_t, 2> chunk = {1, 1};
  // With chunks of another shape HDF5 may read for ever.
  if (H5Pget_layout(creation) == H5D_CHUNKED && (H5Pget_chunk(creation, rank, chunk.data()) != rank || chunk[0] == 0))
    dataset.fail("has a dataset of a wrong chunk size");
  dataset.chunk_entries_ = chunk[0];
  // A damaged file may claim billions of entries that it does not contain; no memory is allocated for these.
  const std::uint64_t most_entries = H5Dget_storage_size(dataset.id_) * kMostInflation / dataset.entry_bytes();
  if (dataset.length_ > most_entries || dataset.number_bytes_ > kMostTextBytes)
    dataset.fail("has a dataset that claims more entries than it contains");
  return dataset;
}

std::vector<std::byte> Dataset::read(std::uint64_t begin, std::uint64_t count) const {
  if (begin > length_ || count > length_ - begin) fail("ends before the requested entries");
  std::vector<std::byte> bytes(count * entry_bytes());
  if (count == 0) return bytes;
  const int rank = spec_->width == 1 ? 1 : 2;
  const std::array<hsize_t, 2> from = {begin, 0};
  const std::array<hsize_t, 2> extent = {count, width_};
  const std::array<hsize_t, 2> whole = {count, spec_->width};
  const std::array<hsize_t, 2> start = {0, 0};
  const Id in_file(H5Dget_space(id_), H5Sclose);
  const Id in_memory(H5Screate_simple(rank, whole.data(), nullptr), H5Sclose);
  if (width_ < spec_->width) {
    // All bits set: not a number.
    std::fill(bytes.begin(), bytes.end(), std::byte{0xFF});
    H5Sselect_hyperslab(in_memory, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  }
  H5Sselect_hyperslab(in_file, H5S_SELECT_SET, from.data(), nullptr, extent.data(), nullptr);
  const Id type = type_of(*spec_, number_bytes_);
  file_->check(H5Dread(id_, type, in_memory, in_file, H5P_DEFAULT, bytes.data()),
               "cannot be read (" + std::string(spec_->path) + ")");
  return bytes;
}

void Dataset::extend(std::uint64_t length) {
  const std::array<hsize_t, 2> extent = {length, spec_->width};
  if (H5Dset_extent(id_, extent.data()) < 0) fail("cannot be written");
  length_ = length;
}

void Dataset::write_chunk(std::uint64_t index, std::span<const std::byte> bytes) {
  const std::array<hsize_t, 2> at = {index * chunk_entries_, 0};
  if (H5Dwrite_chunk(id_, H5P_DEFAULT, 0, at.data(), bytes.size(), bytes.data()) < 0) fail("cannot be written");
  file_->check_disk("cannot be written (" + std::string(spec_->path) + ")");
}

void Dataset::write_whole(std::span<const std::byte> bytes) {
  assert(whole_ && bytes.size() == length_ * entry_bytes());
  const Id type = type_of(*spec_, number_bytes_);
  if (H5Dwrite(id_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) fail("cannot be written");
}

ChunkPlace Dataset::chunk_place(std::uint64_t index) const {
  if (chunk_entries_ != holdfast::internal::chunk_entries(spec_->axis) || width_ != spec_->width)
    fail("has a dataset of a wrong chunk size");
  const std::array<hsize_t, 2> at = {index * chunk_entries_, 0};
  unsigned filter_mask = 0;
  haddr_t begin = HADDR_UNDEF;
  hsize_t size = 0;
  if (H5Dget_chunk_info_by_coord(id_, at.data(), &filter_mask, &begin, &size) < 0 || begin == HADDR_UNDEF)
    fail("lacks a part of its data");
  if (filter_mask != 0 || size > 2 * chunk_entries_ * entry_bytes())
    fail("has a chunk that differs from what was written");
  return {begin, size};
}

}  // namespace holdfast::internal::h5
