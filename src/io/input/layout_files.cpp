#include "io/input/layout_files.hpp"

#include <filesystem>
#include <utility>

#include "io/input/layout_reader.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal {

namespace {

/// @param hash of the file when the run began
ReadLayout read_layout(const std::string& path, const std::string& hash, const Settings& settings) {
  ReadLayout read;
  read.layout.name = std::filesystem::path(path).filename().string();
  const Result<TextFile> file = read_text_file(path);
  read.layout.sha256 = hash;
  if (!file) {
    read.error = file.error().message();
    return read;
  }
  if (file->sha256 != hash) {
    read.error = Error{.file = path,
                       .what = "this layout has changed since the run began, and is left out",
                       .accepted = "screen it again by itself"}
                     .message();
    return read;
  }
  Result<Layout> layout = parse_layout(*file, settings, read.warnings);
  if (layout) {
    read.layout = std::move(*layout);
  } else {
    read.error = summary_of(layout.errors());
  }
  return read;
}

}  // namespace

std::vector<std::string> hash_layouts(const std::vector<std::string>& paths) {
  std::vector<std::string> hashes;
  for (const std::string& path : paths) {
    const Result<TextFile> file = read_text_file(path);
    hashes.push_back(file ? file->sha256 : "");
  }
  return hashes;
}

std::shared_ptr<const ReadLayout> LayoutFiles::take(std::size_t layout, std::size_t takers) {
  std::shared_ptr<Entry> entry;
  {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<Entry>& kept = entries_[layout];
    if (!kept) {
      kept = std::make_shared<Entry>();
      kept->takers = takers;
    }
    entry = kept;
    if (--entry->takers == 0) entries_.erase(layout);
  }
  std::call_once(entry->read, [&] { entry->layout = read_layout(paths_[layout], hashes_[layout], settings_); });
  return {entry, &entry->layout};
}

}  // namespace holdfast::internal
