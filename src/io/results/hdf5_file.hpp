#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.hpp"
#include "io/results/hdf5_disk.hpp"
#include "io/results/results_schema.hpp"

/// The part of HDF5's C interface that the results file needs, with owners of identifiers and with errors. For src/io
/// only; `Failure` never leaves that folder.
namespace holdfast::internal::h5 {

/// Thrown when a call of HDF5 or of the file system fails.
class Failure : public std::exception {
 public:
  explicit Failure(Error error) : error_(std::move(error)), text_(error_.message()) {}
  const Error& error() const { return error_; }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  Error error_;
  std::string text_;
};

/// Throws the error of a file that is not what it should be.
[[noreturn]] inline void fail(const std::string& path, std::string what, std::string accepted = "") {
  throw Failure(Error{.file = path, .what = std::move(what), .accepted = std::move(accepted)});
}

/// What the exception says that is being handled.
inline Error error_in_hand(const std::string& path) {
  try {
    throw;
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const std::bad_alloc&) {
    return out_of_memory(path);
  } catch (const std::out_of_range&) {
    return Error{.file = path, .what = "is damaged: its tables do not fit together"};
  } catch (const std::exception& exception) {
    return Error{.file = path, .what = exception.what()};
  }
}

/// Runs `work` and returns the error that it threw, if any; for the public functions.
template <class Work>
std::optional<Error> caught(const std::string& path, Work&& work) {
  try {
    work();
    return std::nullopt;
  } catch (const std::exception&) {
    return error_in_hand(path);
  }
}

/// The same for work that returns a value.
template <class Work>
auto caught_result(const std::string& path, Work&& work) -> Result<decltype(work())> {
  try {
    return work();
  } catch (const std::exception&) {
    return error_in_hand(path);
  }
}

/// Runs `work`; adds the cure to a failure that has none.
template <class Work>
auto with_cure(const std::string& cure, Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const Failure& failure) {
    Error error = failure.error();
    if (error.accepted.empty()) error.accepted = cure;
    throw Failure(std::move(error));
  }
}

/// Calls of HDF5 that have returned: while it grows, a process that reads makes progress. A signal handler may ask.
std::uint64_t calls_returned();

/// Prevents HDF5 from printing its error stack, which it does by default, per thread.
void be_quiet();

/// Owner of an HDF5 identifier.
class Id {
 public:
  using Closer = herr_t (*)(hid_t);
  Id() = default;
  Id(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
  Id& operator=(Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  ~Id() { close(); }
  /// False if HDF5 cannot close it, for instance because the disk is full.
  bool close() { return id_ < 0 || closer_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

/// An open HDF5 file.
class File {
 public:
  File(File&&) = default;

  /// A new file on disk; an existing file of that name is replaced.
  static File create(const std::string& path);
  /// A new file in memory; `path` is for messages.
  static File create_in_memory(const std::string& path);
  /// An existing file, for reading. Fails if anything in it lies in another file, or in chunks of more than 1 MB.
  static File open(const std::string& path);

  const std::string& path() const { return path_; }
  hid_t id() const { return id_; }

  /// All bytes of a file in memory, as they would be on disk.
  std::vector<std::byte> image();
  /// Writes all remaining data and closes the file. All of its datasets must be closed before.
  void close();

  /// Fails if an earlier write to disk has failed.
  void check_disk(const std::string& what) const;
  /// Throws a failure that names the file and the last error of HDF5.
  [[noreturn]] void fail(const std::string& what) const;
  /// Fails if HDF5 returned a negative number; otherwise returns the number.
  hid_t check(hid_t id, const std::string& what) const;

 private:
  File(std::string path, hid_t id) : path_(std::move(path)), id_(id, H5Fclose) {}
  std::string path_;
  std::unique_ptr<DiskState> disk_;  ///< of a file created on disk
  Id id_;
};

/// Creates a group and those above it.
void make_group(const File& file, const std::string& path);
bool exists(const File& file, const std::string& path);

void write_attribute(const File& file, const std::string& object, const std::string& name, std::string_view text);
/// The same for an object that is already open; `object` is its name in messages.
void write_attribute(const File& file, hid_t on, const std::string& object, const std::string& name,
                     std::string_view text);
void write_attribute(const File& file, const std::string& object, const std::string& name, std::uint64_t value);
void write_attribute(const File& file, const std::string& object, const std::string& name, double value);
std::string read_text_attribute(const File& file, const std::string& object, const std::string& name);
std::uint64_t read_count_attribute(const File& file, const std::string& object, const std::string& name);
bool has_attribute(const File& file, const std::string& object, const std::string& name);
/// Names of the attributes of an object, in the order in which they were written.
std::vector<std::string> attribute_names(const File& file, const std::string& object);
double read_number_attribute(const File& file, const std::string& object, const std::string& name);

/// Writes a single text as a dataset, for texts of several pages.
void write_text(const File& file, const std::string& path, std::string_view text, std::string_view description);
std::string read_text(const File& file, const std::string& path);

/// Position of the compressed bytes of a chunk in their file.
struct ChunkPlace {
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
};

/// An open dataset of the schema. Its file must outlive it.
class Dataset {
 public:
  /// A new dataset of `length` entries, with its attributes.
  /// @param text_size bytes per entry of a text column; ignored for other columns
  static Dataset create(const File& file, const DatasetSpec& spec, std::uint64_t length, std::size_t text_size);
  /// An existing dataset; fails if its type or shape is not that of the schema. Floating-point entries may be narrower,
  /// in a file of a version that knew fewer sides: numbers that the file lacks are read as NaN.
  static Dataset open(const File& file, const DatasetSpec& spec);

  const DatasetSpec& spec() const { return *spec_; }
  std::uint64_t length() const { return length_; }
  std::size_t entry_bytes() const { return number_bytes_ * spec_->width; }
  /// Bytes of a number, or of a text.
  std::size_t number_bytes() const { return number_bytes_; }
  std::uint64_t chunk_entries() const { return chunk_entries_; }

  /// Entries [begin, begin + count), in their stored form.
  std::vector<std::byte> read(std::uint64_t begin, std::uint64_t count) const;
  /// Makes a long dataset longer; never shorter.
  void extend(std::uint64_t length);
  /// True for a new dataset that is so short that it is not divided into chunks: `write_whole` fills it.
  bool whole() const { return whole_; }
  /// Writes all entries, in their stored form.
  void write_whole(std::span<const std::byte> bytes);
  /// Writes the compressed bytes of a whole chunk.
  void write_chunk(std::uint64_t index, std::span<const std::byte> bytes);
  /// Position of a chunk of a long dataset; fails if the chunk is not as `write_chunk` wrote it.
  ChunkPlace chunk_place(std::uint64_t index) const;

 private:
  Dataset(const File& file, const DatasetSpec& spec) : file_(&file), spec_(&spec), width_(spec.width) {}
  [[noreturn]] void fail(const std::string& what) const;

  const File* file_;
  const DatasetSpec* spec_;
  std::size_t width_;  ///< numbers per entry in the file
  Id id_;
  std::uint64_t length_ = 0;
  std::size_t number_bytes_ = 0;
  std::uint64_t chunk_entries_ = 0;
  bool whole_ = false;
};

}  // namespace holdfast::internal::h5
