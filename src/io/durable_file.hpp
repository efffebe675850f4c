#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace holdfast {

/// Name under which a file is written before it is whole.
inline std::string temporary_name(const std::string& path) { return path + ".tmp"; }

/// Writes the bytes so that after a crash `path` has all of them or does not exist: temporary name, fsync, rename,
/// fsync of the folder. Throws `h5::Failure`; then the temporary file is gone. For src/io only.
void write_durably(const std::string& path, std::span<const std::byte> bytes);

/// The last steps of the above for a closed file under its temporary name.
void commit_temporary(const std::string& path);

}  // namespace holdfast
