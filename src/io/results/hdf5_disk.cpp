#include "io/results/hdf5_disk.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <limits>

namespace holdfast::internal::h5 {

namespace {

/// Number of bytes after which the system is asked to write to disk, instead of everything at the end.
constexpr haddr_t kHandOverBytes = haddr_t{8} << 20U;

/// An open file for HDF5, whose own structure must be the first member.
struct DiskFile {
  H5FD_t common{};
  int descriptor = -1;
  haddr_t allocated_end = 0;
  haddr_t written_end = 0;
  haddr_t handed_over_end = 0;
  DiskState* state = nullptr;
};

DiskFile* disk(H5FD_t* file) { return reinterpret_cast<DiskFile*>(file); }
const DiskFile* disk(const H5FD_t* file) { return reinterpret_cast<const DiskFile*>(file); }

H5FD_t* open_file(const char* name, unsigned, hid_t access, haddr_t) {
  auto* const* state = static_cast<DiskState* const*>(H5Pget_driver_info(access));
  const int descriptor = ::open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    (*state)->error_number = errno;
    return nullptr;
  }
  auto* file = new DiskFile;
  file->descriptor = descriptor;
  file->state = *state;
  return &file->common;
}

herr_t close_file(H5FD_t* file) {
  DiskState& state = *disk(file)->state;
  if (::close(disk(file)->descriptor) != 0 && state.error_number == 0) state.error_number = errno;
  delete disk(file);
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_allocated_end(const H5FD_t* file, H5FD_mem_t) { return disk(file)->allocated_end; }
herr_t set_allocated_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  disk(file)->allocated_end = end;
  return 0;
}
haddr_t get_written_end(const H5FD_t* file, H5FD_mem_t) { return disk(file)->written_end; }

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t from, std::size_t size, void* buffer) {
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t count = ::pread(disk(file)->descriptor, to, size, static_cast<off_t>(from));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) break;  // beyond the end: zeros, as HDF5 expects
    to += count;
    from += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  std::memset(to, 0, size);
  return 0;
}

/// Asks the system to begin writing to disk. Errors are reported when the file is synced.
void hand_over(DiskFile& file) {
  const haddr_t size = file.written_end - file.handed_over_end;
  if (size < kHandOverBytes) return;
  ::sync_file_range(file.descriptor, static_cast<off_t>(file.handed_over_end), static_cast<off_t>(size),
                    SYNC_FILE_RANGE_WRITE);
  file.handed_over_end = file.written_end;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t to, std::size_t size, const void* buffer) {
  DiskState& state = *disk(file)->state;
  const auto* from = static_cast<const char*>(buffer);
  disk(file)->written_end = std::max<haddr_t>(disk(file)->written_end, to + size);
  while (size > 0 && state.error_number == 0) {
    const ssize_t count = ::pwrite(disk(file)->descriptor, from, size, static_cast<off_t>(to));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      state.error_number = count < 0 ? errno : ENOSPC;
      break;
    }
    from += count;
    to += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  hand_over(*disk(file));
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  DiskFile& on_disk = *disk(file);
  if (on_disk.written_end == on_disk.allocated_end || on_disk.state->error_number != 0) return 0;
  if (::ftruncate(on_disk.descriptor, static_cast<off_t>(on_disk.allocated_end)) != 0)
    on_disk.state->error_number = errno;
  on_disk.written_end = on_disk.allocated_end;
  return 0;
}

hid_t register_driver() {
  H5FD_class_t driver{};
  driver.name = "holdfast_disk";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<off_t>::max());
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(DiskState*);  // NOLINT(bugprone-sizeof-expression): the property is a pointer
  driver.open = open_file;
  driver.close = close_file;
  driver.query = query;
  driver.get_eoa = get_allocated_end;
  driver.set_eoa = set_allocated_end;
  driver.get_eof = get_written_end;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), std::begin(driver.fl_map));
  return H5FDregister(&driver);
}

}  // namespace

void use_disk_driver(hid_t access, DiskState* state) {
  static const hid_t kDriver = register_driver();
  H5Pset_driver(access, kDriver, &state);
}

}  // namespace holdfast::internal::h5
