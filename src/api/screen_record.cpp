#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/apply_settings.hpp"
#include "api/guarded.hpp"
#include "api/memory_run.hpp"
#include "api/recorded_run.hpp"
#include "api/screen_state.hpp"
#include "holdfast/holdfast.hpp"
#include "io/input/text_file.hpp"
#include "io/loads/load_json.hpp"
#include "io/results/output_lock.hpp"

namespace holdfast {

namespace {

/// Whether a layout has more than corners and numbers of materials.
bool has_more(const internal::Layout& layout) {
  return layout.container || std::any_of(layout.boxes.begin(), layout.boxes.end(), [](const internal::Box& box) {
           return !box.material.is_number() || !box.name.empty() || box.mass || box.centre_of_mass || box.mat ||
                  box.fixed || box.order || box.bearing_limit;
         });
}

/// SHA-256 of a layout: of its canonical JSON, as of a load of a file, or of its numbers where it has nothing else.
std::string hash_of(const internal::Layout& layout) {
  if (has_more(layout)) return internal::sha256_of(internal::canonical_json(layout));
  std::string bytes;
  const auto append = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
  for (const internal::Box& box : layout.boxes) {
    append(box.corner_min.data(), 3 * sizeof(double));
    append(box.corner_max.data(), 3 * sizeof(double));
    const int material = box.material.id();
    append(&material, sizeof material);
  }
  return internal::sha256_of(bytes);
}

/// The text of a config.ini that sets the same keys: that of the options, or one of all keys where some are set beside
/// it.
std::string config_text_of(const ScreenOptions& options) {
  if (options.settings.empty()) return options.config;
  std::vector<Setting> all = read_settings(options.config);
  for (const Setting& given : options.settings) {
    Setting setting = internal::main_spelling(given);
    std::erase_if(all,
                  [&](const Setting& other) { return other.section == setting.section && other.key == setting.key; });
    all.push_back(std::move(setting));
  }
  std::string text;
  for (const auto& [section, key, value] : all) text += '[' + section + "]\n" + key + " = " + value + '\n';
  return text;
}

void check(const RecordOptions& options, const std::string& path, std::size_t layout_count) {
  if (path.empty())
    throw internal::exception_of({{.what = "an empty path", .accepted = "the name of the results file"}});
  if (layout_count == 0) throw internal::exception_of({{.file = path, .what = "a results file needs a layout"}});
  if (options.resume && options.overwrite)
    throw internal::exception_of({{.file = path, .what = "a run cannot both resume and overwrite"}});
}

}  // namespace

bool Screen::State::record(std::vector<internal::ReadLayout> read, const std::string& path,
                           const RecordOptions& record_options) {
  need_accelerations();
  std::vector<std::string> names;
  std::vector<std::string> hashes;
  for (internal::ReadLayout& layout : read) {
    if (layout.error.empty()) layout.layout.sha256 = hash_of(layout.layout);
    names.push_back(layout.layout.name);
    hashes.push_back(layout.layout.sha256);
  }
  for (internal::ReadAcceleration& acceleration : read_accelerations)
    acceleration.acceleration.sha256 = internal::hash_of(acceleration.acceleration);
  internal::Recording recording{.path = path,
                                .description = internal::describe_run(settings, std::move(names), std::move(hashes),
                                                                      read_accelerations, record_options.series)};
  recording.description.command_line = record_options.command_line;
  recording.description.config_text = config_text_of(options);
  if (record_options.resume) recording.existing = internal::ExistingResults::resume;
  if (record_options.overwrite) recording.existing = internal::ExistingResults::overwrite;
  std::optional<internal::Error> unprotected;
  const internal::OutputLock lock = internal::value_or_throw(internal::OutputLock::take(path, unprotected));
  internal::MemoryLayouts source(std::move(read));
  const internal::RecordedEnd end =
      internal::record_run(plan(source, record_options.series), recording, lock, observer, stop, costs);
  if (!end.errors.empty()) throw internal::exception_of(end.errors);
  return end.kind == internal::RecordedEnd::Kind::complete;
}

bool Screen::record(std::span<const Layout> layouts, const std::string& path, const RecordOptions& options) {
  return internal::guarded([&] {
    state_->forget_cancel();
    check(options, path, layouts.size());
    return state_->record(state_->read(layouts), path, options);
  });
}

bool Screen::record(std::span<const LayoutView> layouts, const std::string& path, const RecordOptions& options) {
  return internal::guarded([&] {
    state_->forget_cancel();
    check(options, path, layouts.size());
    return state_->record(state_->read(layouts), path, options);
  });
}

}  // namespace holdfast
