#include "io/input/layout_files.hpp"

#include <filesystem>
#include <utility>

#include "io/input/text_file.hpp"
#include "io/loads/load_file.hpp"
#include "io/loads/load_json.hpp"

namespace holdfast::internal {

namespace {

ReadLayout read_layout_of(ReadLoad load) {
  ReadLayout read{.layout = std::move(load.layout), .warnings = std::move(load.warnings)};
  if (!load.errors.empty()) read.error = summary_of(load.errors);
  return read;
}

/// A layout that cannot be used.
ReadLayout unusable(const std::string& name, const std::string& hash, const Error& error) {
  ReadLayout read;
  read.layout.name = name;
  read.layout.sha256 = hash;
  read.error = error.message();
  return read;
}

/// Reads a text again, whose hash is that of when the run began.
ReadLayout read_text(const std::string& path, const std::string& name, const std::string& hash,
                     const Settings& settings) {
  const Result<TextFile> file = read_text_file(path);
  if (!file) return unusable(name, hash, file.error());
  if (file->sha256 != hash)
    return unusable(name, hash,
                    {.file = path,
                     .what = "this layout has changed since the run began, and is left out",
                     .accepted = "screen it again by itself"});
  Result<LoadsOfFile> loads = read_loads(*file, settings);
  return loads ? read_layout_of(std::move(loads->loads.front())) : unusable(name, hash, loads.error());
}

}  // namespace

LayoutFiles::LayoutFiles(const std::vector<std::string>& paths, const Settings& settings) : settings_(settings) {
  for (const std::string& path : paths) add(path, settings);
}

void LayoutFiles::add(const std::string& path, const Settings& settings) {
  const std::string file_name = std::filesystem::path(path).filename().string();
  const auto add_place = [&](const std::string& name, const std::string& hash) -> Place& {
    Place& place = *places_.emplace_back(std::make_shared<Place>());
    place.path = path;
    place.name = name;
    place.hash = hash;
    place.label = path + name.substr(std::min(file_name.size(), name.size()));
    return place;
  };
  const Result<TextFile> file = read_text_file(path);
  if (!file || load_syntax(file->text) == LoadSyntax::text) {
    add_place(file_name, file ? file->sha256 : "");
    return;
  }
  const auto add_read = [&](ReadLayout layout) {
    Place& place = add_place(layout.layout.name, layout.layout.sha256);
    place.is_read = true;
    place.layout = std::make_shared<const ReadLayout>(std::move(layout));
  };
  Result<LoadsOfFile> loads = read_loads(*file, settings);
  if (!loads) {
    ReadLayout read = unusable(file_name, file->sha256, {});
    read.error = summary_of(loads.errors());
    return add_read(std::move(read));
  }
  for (ReadLoad& load : loads->loads) {
    load.layout.sha256 = sha256_of(canonical_json(load.layout));
    add_read(read_layout_of(std::move(load)));
  }
  for (Error& note : loads->notes) notes_.push_back(std::move(note));
}

std::shared_ptr<const ReadLayout> LayoutFiles::take(std::size_t layout, std::size_t takers) {
  Place& place = *places_[layout];
  const std::scoped_lock lock(place.mutex);
  if (place.takers == 0) place.takers = takers;
  if (!place.layout)
    place.layout = std::make_shared<const ReadLayout>(read_text(place.path, place.name, place.hash, settings_));
  std::shared_ptr<const ReadLayout> taken = place.layout;
  // Tables and JSON are not read again.
  if (--place.takers == 0 && !place.is_read) place.layout.reset();
  return taken;
}

std::vector<std::string> LayoutFiles::names() const {
  std::vector<std::string> names;
  for (const auto& place : places_) names.push_back(place->name);
  return names;
}

std::vector<std::string> LayoutFiles::hashes() const {
  std::vector<std::string> hashes;
  for (const auto& place : places_) hashes.push_back(place->hash);
  return hashes;
}

std::shared_ptr<LayoutFiles> LayoutFiles::chosen(std::span<const std::size_t> layouts) const {
  std::shared_ptr<LayoutFiles> some(new LayoutFiles(settings_));
  for (const std::size_t layout : layouts) some->places_.push_back(places_[layout]);
  return some;
}

}  // namespace holdfast::internal
