#include "app/layout_shelf.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "io/layout_reader.hpp"
#include "io/text_file.hpp"

namespace holdfast {

namespace {

ReadLayout read_layout(const std::string& path, const Settings& settings) {
  ReadLayout read;
  read.layout.name = std::filesystem::path(path).filename().string();
  const Result<TextFile> file = read_text_file(path);
  if (!file) {
    read.error = file.error().message();
    return read;
  }
  read.layout.sha256 = file->sha256;
  Result<Layout> layout = parse_layout(*file, settings, read.warnings);
  if (layout) {
    read.layout = std::move(*layout);
  } else {
    const std::size_t more = layout.errors().size() - 1;
    read.error = layout.error().message() + (more > 0 ? fmt::format(" (and {} more)", more) : "");
  }
  return read;
}

}  // namespace

std::shared_ptr<const ReadLayout> LayoutShelf::take(std::size_t layout, std::size_t takers) {
  std::shared_ptr<Place> place;
  {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<Place>& entry = places_[layout];
    if (!entry) {
      entry = std::make_shared<Place>();
      entry->takers = takers;
    }
    place = entry;
    if (--place->takers == 0) places_.erase(layout);
  }
  std::call_once(place->read, [&] {
    const StageTimer timer(costs_, Stage::read);
    place->layout = read_layout(paths_[layout], settings_);
  });
  return {place, &place->layout};
}

}  // namespace holdfast
