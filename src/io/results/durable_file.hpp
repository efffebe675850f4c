#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace holdfast::internal {

/// Name of a file while it is incomplete.
inline std::string temporary_name(const std::string& path) { return path + ".tmp"; }

/// Owner of a file descriptor.
struct Descriptor {
  int number = -1;
  explicit Descriptor(int opened) : number(opened) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();
};

/// A file to read bytes from at any position. Throws `h5::Failure`.
class BytesOfFile {
 public:
  explicit BytesOfFile(std::string path);
  /// Fails if the file is too short.
  std::vector<std::byte> read(std::uint64_t begin, std::uint64_t count) const;

 private:
  std::string path_;
  Descriptor file_;
};

/// Writes the bytes so that after a crash `path` has all of them or does not exist: temporary name, fsync, rename,
/// fsync of the folder. Throws `h5::Failure` after removing the temporary file. For src/io only.
void write_durably(const std::string& path, std::span<const std::byte> bytes);

/// Makes the name of a file or folder survive a crash: fsync of the folder that contains it. Throws `h5::Failure`.
void sync_entry(const std::string& path);

/// The same last steps for a file that is already closed under its temporary name.
void commit_temporary(const std::string& path);

}  // namespace holdfast::internal
