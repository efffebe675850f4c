#include "io/results/hdf5_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>

#include "io/input/regular_file.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal::h5 {

namespace {

/// The last error of HDF5: the innermost entry of its error stack, or the system's message in it.
std::string last_words() {
  std::string words;
  const auto keep_innermost = [](unsigned, const H5E_error2_t* entry, void* to) -> herr_t {
    *static_cast<std::string*>(to) = entry->desc != nullptr ? entry->desc : "";
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &words);
  H5Eclear2(H5E_DEFAULT);
  constexpr std::string_view kMark = "error message = '";
  if (const auto begin = words.find(kMark); begin != std::string::npos) {
    const auto from = begin + kMark.size();
    return words.substr(from, words.find('\'', from) - from);
  }
  return words;
}

/// True where the last call has failed because there is no memory.
bool lacks_memory() {
  bool lacks = false;
  const auto look = [](unsigned, const H5E_error2_t* entry, void* to) -> herr_t {
    if (entry->min_num == H5E_NOSPACE || entry->min_num == H5E_CANTALLOC) *static_cast<bool*>(to) = true;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, look, &lacks);
  return lacks;
}

[[noreturn]] void fail_with(const std::string& path, const std::string& what) {
  if (lacks_memory()) {
    // As `operator new` does: whoever limits the memory has said what happens then.
    if (const std::new_handler handler = std::get_new_handler(); handler != nullptr) handler();
    throw std::bad_alloc();
  }
  throw Failure(Error{.file = path, .what = what, .value = last_words()});
}

// Every call clears that stack, also a call that closes an identifier. Lists and types passed to a call must therefore
// outlive the check of its result, and have names.

Id access_list() {
  Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  return access;
}

Id text_type(std::size_t size) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, size);
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Tset_strpad(type, size == H5T_VARIABLE ? H5T_STR_NULLTERM : H5T_STR_NULLPAD);
  return type;
}

/// The type of text attributes, of which a file has hundreds: created once, and never closed.
hid_t long_text_type() {
  static const hid_t kType = H5Tcopy(text_type(H5T_VARIABLE));
  return kType;
}

hid_t single_space() {
  static const hid_t kSpace = H5Screate(H5S_SCALAR);
  return kSpace;
}

Id group_creation() {
  Id creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  return creation;
}

Id open_object(const File& file, const std::string& path) {
  return {file.check(H5Oopen(file.id(), path.c_str(), H5P_DEFAULT), "has no " + path), H5Oclose};
}

template <class T>
void write_scalar_attribute(const File& file, hid_t on, const std::string& object, const std::string& name, hid_t type,
                            const T& value) {
  const std::string what = "cannot be written (attribute " + name + " of " + object + ")";
  const Id attribute(file.check(H5Acreate2(on, name.c_str(), type, single_space(), H5P_DEFAULT, H5P_DEFAULT), what),
                     H5Aclose);
  file.check(H5Awrite(attribute, type, &value), what);
}

template <class T>
T read_scalar_attribute(const File& file, const std::string& object, const std::string& name, hid_t type) {
  const Id on = open_object(file, object);
  const std::string what = "has no attribute " + name + " at " + object + " that can be read";
  const Id attribute(file.check(H5Aopen(on, name.c_str(), H5P_DEFAULT), what), H5Aclose);
  const Id space(H5Aget_space(attribute), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1) file.fail(what);
  T value{};
  file.check(H5Aread(attribute, type, &value), what);
  return value;
}

/// Why a dataset cannot be trusted to hold its own data in pieces that fit into memory; null: it can.
const char* why_not_read(hid_t dataset) {
  const Id creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_external_count(creation) != 0) return "has data in another file";
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout == H5D_VIRTUAL) return "has data in another dataset";
  for (int i = 0; i < H5Pget_nfilters(creation); ++i) {
    std::size_t values = 0;
    unsigned flags = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, nullptr);
    // Others are libraries that HDF5 would load.
    if (filter < 0 || filter > H5Z_FILTER_RESERVED) return "has data that is packed in an unknown way";
  }
  if (layout != H5D_CHUNKED) return nullptr;
  std::array<hsize_t, H5S_MAX_RANK> extent{};
  const int rank = H5Pget_chunk(creation, static_cast<int>(extent.size()), extent.data());
  const Id type(H5Dget_type(dataset), H5Tclose);
  std::uint64_t bytes = H5Tget_size(type);
  for (int i = 0; i < rank; ++i) {
    bytes *= std::max<std::uint64_t>(extent.at(static_cast<std::size_t>(i)), 1);
    if (bytes > kMostChunkBytes) return "has chunks that are too large";
  }
  return nullptr;
}

/// Fails if anything in the file lies elsewhere, or cannot be read in pieces: links other than to objects of this
/// file, and datasets as above. Whoever opens a file of somebody else sees what is in that file, and nothing else.
void check_contents(const File& file) {
  struct Look {
    const File& file;
    std::string what;
  } look{file, {}};
  const auto visit = [](hid_t root, const char* name, const H5L_info_t* link, void* to) -> herr_t {
    auto& found = *static_cast<Look*>(to);
    if (link->type != H5L_TYPE_HARD) {
      found.what = std::string("has a link in place of /") + name;
      return 1;
    }
    const Id object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
    if (object < 0) return -1;
    const char* reason = H5Iget_type(object) == H5I_DATASET ? why_not_read(object) : nullptr;
    if (reason != nullptr) found.what = std::string(reason) + " (/" + name + ")";
    return reason != nullptr ? 1 : 0;
  };
  file.check(H5Lvisit(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, visit, &look), "cannot be read");
  if (!look.what.empty()) throw Failure(Error{.file = file.path(), .what = look.what});
}

std::atomic<std::uint64_t> returned_calls = 0;

}  // namespace

std::uint64_t calls_returned() { return returned_calls; }

void be_quiet() {
  // After memory has run out, the library's cleanup at the end of the process crashes; all files are closed before.
  static const bool kNeverTidy = H5dont_atexit() >= 0;
  static_cast<void>(kNeverTidy);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

File File::create(const std::string& path) {
  be_quiet();
  const Id access = access_list();
  auto disk = std::make_unique<DiskState>();
  use_disk_driver(access, disk.get());
  const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (disk->error_number != 0) {
    H5Fclose(id);
    throw Failure(Error{.file = path, .what = "cannot be created", .value = std::strerror(disk->error_number)});
  }
  if (id < 0) fail_with(path, "cannot be created");
  File file(path, id);
  file.disk_ = std::move(disk);
  return file;
}

File File::create_in_memory(const std::string& path) {
  be_quiet();
  const Id access = access_list();
  constexpr std::size_t kGrowBy = std::size_t{1} << 18U;
  H5Pset_fapl_core(access, kGrowBy, false);
  const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (id < 0) fail_with(path, "cannot be created in memory");
  return {path, id};
}

File File::open(const std::string& path) {
  be_quiet();
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0)
    if (const auto error = why_no_regular_file(path, status.st_mode)) throw Failure(*error);
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) fail_with(path, "cannot be opened as an HDF5 file");
  File file(path, id);
  check_contents(file);
  return file;
}

std::vector<std::byte> File::image() {
  check(H5Fflush(id_, H5F_SCOPE_LOCAL), "cannot be assembled in memory");
  const ssize_t size = H5Fget_file_image(id_, nullptr, 0);
  check(size, "cannot be assembled in memory");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  check(H5Fget_file_image(id_, bytes.data(), bytes.size()), "cannot be assembled in memory");
  return bytes;
}

void File::close() {
  const bool closed = id_.close();
  check_disk("cannot be written");
  if (!closed) fail("cannot be written");
}

void File::check_disk(const std::string& what) const {
  if (disk_ && disk_->error_number != 0)
    throw Failure(Error{.file = path_, .what = what, .value = std::strerror(disk_->error_number)});
}

hid_t File::check(hid_t id, const std::string& what) const {
  if (id < 0) fail(what);
  ++returned_calls;
  return id;
}

void File::fail(const std::string& what) const {
  check_disk(what);
  fail_with(path_, what);
}

void make_group(const File& file, const std::string& path) {
  if (exists(file, path)) return;
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end);
    if (!exists(file, group)) {
      const Id creation = group_creation();
      const hid_t id = H5Gcreate2(file.id(), group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT);
      H5Gclose(file.check(id, "cannot be written (group " + group + ")"));
    }
    if (end == std::string::npos) return;
  }
}

bool exists(const File& file, const std::string& path) { return H5Lexists(file.id(), path.c_str(), H5P_DEFAULT) > 0; }

void write_attribute(const File& file, const std::string& object, const std::string& name, std::string_view text) {
  write_attribute(file, open_object(file, object), object, name, text);
}

void write_attribute(const File& file, hid_t on, const std::string& object, const std::string& name,
                     std::string_view text) {
  const std::string copy = valid_utf8(text);
  const char* pointer = copy.c_str();
  write_scalar_attribute(file, on, object, name, long_text_type(), pointer);
}

void write_attribute(const File& file, const std::string& object, const std::string& name, std::uint64_t value) {
  write_scalar_attribute(file, open_object(file, object), object, name, H5T_STD_U64LE, value);
}

void write_attribute(const File& file, const std::string& object, const std::string& name, double value) {
  write_scalar_attribute(file, open_object(file, object), object, name, H5T_IEEE_F64LE, value);
}

std::string read_text_attribute(const File& file, const std::string& object, const std::string& name) {
  char* pointer = read_scalar_attribute<char*>(file, object, name, long_text_type());
  std::string text = pointer != nullptr ? pointer : "";
  H5free_memory(pointer);
  return text;
}

std::uint64_t read_count_attribute(const File& file, const std::string& object, const std::string& name) {
  return read_scalar_attribute<std::uint64_t>(file, object, name, H5T_NATIVE_UINT64);
}

bool has_attribute(const File& file, const std::string& object, const std::string& name) {
  return H5Aexists_by_name(file.id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> attribute_names(const File& file, const std::string& object) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  const Id open = open_object(file, object);
  // Files of this format keep attributes in the object's header, in the order of writing, which is the native one.
  file.check(H5Aiterate2(open, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add, &names), "cannot be read (" + object + ")");
  return names;
}

double read_number_attribute(const File& file, const std::string& object, const std::string& name) {
  return read_scalar_attribute<double>(file, object, name, H5T_NATIVE_DOUBLE);
}

void write_text(const File& file, const std::string& path, std::string_view text, std::string_view description) {
  const Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  const std::string padded(text.empty() ? std::string(1, '\0') : valid_utf8(text));
  const Id type = text_type(padded.size());
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const std::string what = "cannot be written (" + path + ")";
  const Id id(file.check(H5Dcreate2(file.id(), path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), what),
              H5Dclose);
  file.check(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), what);
  write_attribute(file, id, path, "units", "none");
  write_attribute(file, id, path, "description", description);
}

std::string read_text(const File& file, const std::string& path) {
  const std::string what = "has no text " + path + " that can be read";
  const Id id(file.check(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), what), H5Dclose);
  const Id space(H5Dget_space(id), H5Sclose);
  const Id type(H5Dget_type(id), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || H5Sget_simple_extent_npoints(space) != 1)
    throw Failure(Error{.file = file.path(), .what = what});
  const std::uint64_t size = H5Tget_size(type);
  if (size > H5Dget_storage_size(id)) throw Failure(Error{.file = file.path(), .what = what});
  std::string text(size, '\0');
  file.check(H5Dread(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), what);
  return text.substr(0, text.find('\0'));
}

}  // namespace holdfast::internal::h5
