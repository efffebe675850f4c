#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/convert.hpp"
#include "api/guarded.hpp"
#include "core/model/container_catalogue.hpp"
#include "holdfast/holdfast.hpp"
#include "io/input/config_reader.hpp"
#include "io/input/text_file.hpp"
#include "io/loads/load_choices.hpp"
#include "io/loads/load_file.hpp"

// Loads of files, and the containers that they may name.
namespace holdfast {

using internal::guarded;
using internal::value_or_throw;

namespace {

internal::Settings settings_of(const LoadFileOptions& options) {
  std::vector<internal::Error> ignored;
  const internal::TextFile text{.path = "config", .name = "config", .text = options.config};
  const internal::Config config = value_or_throw(internal::parse_config(text, ignored));
  internal::Settings settings = config.settings;
  const internal::LoadChoices choices{options.container, options.unit, options.axes, options.format, options.columns};
  if (const auto wrong = choices.apply_to(settings, config)) throw internal::exception_of({*wrong});
  return settings;
}

std::vector<Layout> loads_of(const internal::TextFile& file, const LoadFileOptions& options,
                             std::vector<Problem>* notes) {
  const internal::Settings settings = settings_of(options);
  const internal::LoadsOfFile found = value_or_throw(internal::read_loads(file, settings));
  std::vector<Layout> layouts;
  std::vector<Problem> problems;
  const auto append = [](std::vector<Problem>& to, const std::vector<internal::Error>& errors, std::ptrdiff_t load) {
    for (const internal::Error& error : errors) {
      to.push_back(internal::problem_of(error));
      to.back().layout = load;
    }
  };
  if (notes != nullptr) append(*notes, found.notes, -1);
  for (const internal::ReadLoad& load : found.loads) {
    const auto index = static_cast<std::ptrdiff_t>(layouts.size());
    append(problems, load.errors, index);
    if (notes != nullptr) append(*notes, load.warnings, index);
    internal::Layout layout = load.layout;
    if (options.container) layout.container = settings.container;
    layouts.push_back(internal::public_layout(layout, LengthUnit::metre));
    layouts.back().unit = LengthUnit::metre;
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return layouts;
}

}  // namespace

std::vector<Layout> read_loads(const std::string& path, const LoadFileOptions& options, std::vector<Problem>* notes) {
  return guarded([&] { return loads_of(value_or_throw(internal::read_text_file(path)), options, notes); });
}

std::vector<Layout> parse_loads(const std::string& text, const std::string& name, const LoadFileOptions& options,
                                std::vector<Problem>* notes) {
  return guarded([&] {
    const internal::TextFile file{
        .path = name, .name = name.substr(name.find_last_of('/') + 1), .text = text, .sha256 = {}};
    return loads_of(file, options, notes);
  });
}

std::vector<ContainerType> container_types() {
  return guarded([] {
    std::vector<ContainerType> types;
    for (const internal::ContainerType& type : internal::container_catalogue()) {
      const internal::ContainerShape shape = type.shape();
      types.push_back({.name = shape.type,
                       .sentence = std::string(type.what),
                       .size = {shape.size.x(), shape.size.y(), shape.size.z()},
                       .payload = type.payload,
                       .open_sides = shape.open_sides,
                       .bed_height = shape.bed_height});
    }
    return types;
  });
}

}  // namespace holdfast
