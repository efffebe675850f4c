#include "io/results/results_removal.hpp"

#include <filesystem>
#include <fstream>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_part.hpp"

namespace holdfast::internal {

namespace {

/// Whether a file may be replaced: it does not exist, is HDF5, or is empty.
bool is_replaceable(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return true;
  if (!std::filesystem::is_regular_file(status)) return false;
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  std::ifstream file(path, std::ios::binary);
  std::string head(kSignature.size(), '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return file.is_open() && (file.gcount() == 0 || head == kSignature);
}

}  // namespace

std::optional<Error> remove_results(const std::string& path) {
  if (!is_replaceable(path))
    return Error{.file = path, .what = "is not a results file, and is not replaced", .accepted = "another name"};
  return h5::caught(path, [&] {
    std::filesystem::remove(path);
    remove_parts(path);
    remove_temporaries(path);
  });
}

}  // namespace holdfast::internal
