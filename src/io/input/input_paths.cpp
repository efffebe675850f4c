#include "io/input/input_paths.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>

#include "core/base/number_text.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/regular_file.hpp"
#include "io/input/text_file.hpp"
#include "io/input/text_lines.hpp"
#include "io/loads/json_loads.hpp"
#include "io/loads/load_file.hpp"
#include "io/loads/table_text.hpp"

namespace holdfast::internal {

namespace {

namespace fs = std::filesystem;

InputKind kind_of_line(std::span<const Field> fields) {
  const bool is_acceleration = fields.size() == kAccelerationColumns;
  if (!is_acceleration && fields.size() < kLayoutColumns) return InputKind::unknown;
  // A file with a wrong number keeps its kind, so that the number is reported; prose is not an input.
  const std::span<const Field> columns = fields.first(std::min(fields.size(), kLayoutColumns));
  const auto numbers = std::count_if(columns.begin(), columns.end(),
                                     [](const Field& field) { return parse_number(field.text).has_value(); });
  if (2 * static_cast<std::size_t>(numbers) < columns.size()) return InputKind::unknown;
  return is_acceleration ? InputKind::acceleration : InputKind::layout;
}

const char* plural(InputKind kind) {
  switch (kind) {
    case InputKind::layout:
      return "layouts";
    case InputKind::acceleration:
      return "accelerations";
    default:
      return "inputs";
  }
}

/// The entries of a folder in byte order of their names, without folders and hidden files.
Result<std::vector<std::string>> list_folder(const std::string& path) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    const bool hidden = entry->path().filename().string().starts_with('.');
    if (!hidden && !entry->is_directory(unknown)) files.push_back(entry->path().string());
  }
  if (error) return Error{.file = path, .what = "the folder cannot be read", .value = error.message()};
  std::sort(files.begin(), files.end());
  return files;
}

/// The reason why an entry of a folder cannot be read as a file; nothing if it can.
std::optional<Error> why_unreadable(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return Error{.file = path, .what = "is a link to a missing file"};
    return Error{.file = path, .what = "cannot be accessed", .value = std::strerror(errno)};
  }
  if (auto error = why_no_regular_file(path, status.st_mode)) return error;
  if (::access(path.c_str(), R_OK) == 0) return std::nullopt;
  return Error{.file = path, .what = "cannot be read", .value = std::strerror(errno)};
}

/// Collects the files that a list of paths refers to.
class InputFinder {
 public:
  /// @param wanted kind of file to keep from folders; `unknown` keeps all known kinds
  InputFinder(InputKind wanted, std::vector<Error>& warnings) : wanted_(wanted), warnings_(warnings) {}

  void add(const std::string& path) {
    struct stat status = {};
    if (path.empty())
      errors_.push_back({.what = "an empty path"});  // a message with this path would have no subject
    else if (::stat(path.c_str(), &status) != 0)
      errors_.push_back(errno == ENOENT || errno == ENOTDIR
                            ? Error{.file = path, .what = "no such file or folder"}
                            : Error{.file = path, .what = "cannot be accessed", .value = std::strerror(errno)});
    else if (S_ISDIR(status.st_mode))
      add_folder(path);
    else if (const auto error = why_no_regular_file(path, status.st_mode))
      errors_.push_back(*error);
    else
      files_.push_back({path, wanted_ == InputKind::unknown ? classify_file(path) : wanted_});
  }

  void add_list(std::istream& list) {
    const std::size_t before = files_.size() + errors_.size();
    for (std::string line; std::getline(list, line);)
      if (const std::string_view path = trimmed(line); !path.empty()) add(std::string(path));
    if (files_.size() + errors_.size() == before)
      errors_.push_back({.what = "the list of paths on standard input is empty", .accepted = "one path per line"});
  }

  Result<std::vector<InputFile>> take() {
    if (!errors_.empty()) return std::move(errors_);
    return std::move(files_);
  }

 private:
  void add_folder(const std::string& path) {
    const Result<std::vector<std::string>> names = list_folder(path);
    if (!names) return errors_.push_back(names.error());
    const std::size_t before = files_.size() + errors_.size();
    for (const std::string& name : *names) {
      // A candidate must not be left out without a message.
      if (const auto error = why_unreadable(name)) {
        errors_.push_back(*error);
        continue;
      }
      const InputKind kind = classify_file(name);
      if (kind == InputKind::unknown)
        warnings_.push_back({.file = name, .what = "left out, neither a layout, nor an acceleration, nor a config"});
      else if (wanted_ == InputKind::unknown || wanted_ == kind)
        files_.push_back({name, kind});
    }
    if (files_.size() + errors_.size() == before)
      errors_.push_back({.file = path, .what = std::string("the folder has no ") + plural(wanted_)});
  }

  InputKind wanted_;
  std::vector<Error>& warnings_;
  std::vector<InputFile> files_;
  std::vector<Error> errors_;
};

Result<std::vector<InputFile>> find(InputKind wanted, std::span<const std::string> paths, std::istream& list,
                                    std::vector<Error>& warnings) {
  InputFinder finder(wanted, warnings);
  for (const std::string& path : paths) path == "-" ? finder.add_list(list) : finder.add(path);
  return finder.take();
}

Result<std::vector<std::string>> paths_of(const Result<std::vector<InputFile>>& files) {
  if (!files) return files.errors();
  std::vector<std::string> paths;
  for (const InputFile& file : *files) paths.push_back(file.path);
  return paths;
}

/// The kind of input that the beginning of a text indicates.
struct Look {
  InputKind kind = InputKind::unknown;
  bool decided = false;  ///< true: the rest of the text cannot change the kind
};

Look look_at(std::string_view text) {
  if (const auto utf8 = decoded(text); utf8 && text.find('\0') != std::string_view::npos)
    return utf8->text.find('\0') == std::string::npos ? look_at(utf8->text) : Look{InputKind::unknown, true};
  if (text.find('\0') != std::string_view::npos) return {InputKind::unknown, true};
  if (looks_like_json(text)) return {InputKind::layout, true};
  if (text.find('\n') != std::string_view::npos && load_syntax(text) == LoadSyntax::table)
    return {InputKind::layout, true};
  InputKind first = InputKind::unknown;
  bool is_second = false;
  LineReader lines(text);
  std::vector<Field> fields;
  while (lines.next()) {
    split_fields(lines.line(), fields);
    if (fields.empty() || fields[0].text.starts_with(';')) continue;
    if (fields[0].text.starts_with('[')) return {InputKind::config, true};
    const std::string_view data = lines.line().substr(0, lines.line().find('#'));
    const InputKind kind = data.find('=') == std::string_view::npos ? kind_of_line(fields) : InputKind::config;
    // The first line may be a layout's header, which can have any words, also `seed=5`.
    if (is_second) return {kind == InputKind::unknown ? first : kind, true};
    first = kind;
    is_second = true;
  }
  return {first, false};
}

}  // namespace

InputKind classify(std::string_view text) { return look_at(text).kind; }

InputKind classify_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head;
  // The first block shows the kind of most files; a long comment or line may be as long as the largest file.
  for (std::size_t size = 4096; size <= kMostTextBytes; size *= 8) {
    const std::size_t old_size = head.size();
    head.resize(size);
    file.read(head.data() + old_size, static_cast<std::streamsize>(size - old_size));
    head.resize(old_size + static_cast<std::size_t>(file.gcount()));
    // The last line may be incomplete.
    const bool whole = head.size() < size;
    const Look look = look_at(whole ? head : std::string_view(head).substr(0, head.rfind('\n') + 1));
    if (whole || look.decided) return look.kind;
  }
  return InputKind::unknown;
}

Result<std::vector<InputFile>> find_inputs(std::span<const std::string> paths, std::istream& list,
                                           std::vector<Error>& warnings) {
  return find(InputKind::unknown, paths, list, warnings);
}

Result<std::vector<std::string>> layout_paths(std::span<const std::string> paths, std::istream& list,
                                              std::vector<Error>& warnings) {
  return paths_of(find(InputKind::layout, paths, list, warnings));
}

Result<std::vector<std::string>> acceleration_paths(std::span<const std::string> paths, std::istream& list,
                                                    std::vector<Error>& warnings) {
  return paths_of(find(InputKind::acceleration, paths, list, warnings));
}

Result<BatchFolder> read_batch_folder(const std::string& path, bool needs_accelerations, std::vector<Error>& warnings) {
  std::error_code error;
  if (!fs::is_directory(path, error))
    return Error{.file = path,
                 .what = fs::exists(path, error) ? "not a folder" : "no such folder",
                 .accepted = "a batch is a folder with layouts and accelerations"};
  InputFinder finder(InputKind::unknown, warnings);
  finder.add(path);
  const Result<std::vector<InputFile>> files = finder.take();
  if (!files) return files.errors();

  BatchFolder folder;
  for (const InputFile& file : *files) {
    if (file.kind == InputKind::layout) folder.layouts.push_back(file.path);
    if (file.kind == InputKind::acceleration) folder.accelerations.push_back(file.path);
  }
  if (folder.layouts.empty()) return Error{.file = path, .what = "the folder has no layouts"};
  if (needs_accelerations && folder.accelerations.empty())
    return Error{.file = path, .what = "the folder has no accelerations"};
  return folder;
}

}  // namespace holdfast::internal
