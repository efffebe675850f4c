#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace holdfast::internal {

/// Name under which a file is written before it is whole.
inline std::string temporary_name(const std::string& path) { return path + ".tmp"; }

/// Owner of a file descriptor.
struct Descriptor {
  int number = -1;
  explicit Descriptor(int opened) : number(opened) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();
};

/// A file to read bytes from, wherever they are in it. Throws `h5::Failure`.
class BytesOfFile {
 public:
  explicit BytesOfFile(std::string path);
  /// Fails when the file ends before.
  std::vector<std::byte> read(std::uint64_t begin, std::uint64_t count) const;

 private:
  std::string path_;
  Descriptor file_;
};

/// Writes the bytes so that after a crash `path` has all of them or does not exist: temporary name, fsync, rename,
/// fsync of the folder. Throws `h5::Failure`; then the temporary file is gone. For src/io only.
void write_durably(const std::string& path, std::span<const std::byte> bytes);

/// Has the name of a file or folder survive a crash: fsync of the folder that it is in. Throws `h5::Failure`.
void sync_entry(const std::string& path);

/// The last steps of the above for a closed file under its temporary name.
void commit_temporary(const std::string& path);

}  // namespace holdfast::internal
