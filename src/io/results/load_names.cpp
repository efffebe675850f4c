#include "io/results/load_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/input/text_lines.hpp"
#include "io/results/results_columns.hpp"

namespace holdfast::internal {

std::string LoadNames::box_name(std::uint64_t layout, std::uint64_t box) {
  return text("/inputs/layouts/box_name", layout, box);
}

std::string LoadNames::material_name(std::uint64_t layout, std::uint64_t box) {
  return text("/inputs/layouts/material_name", layout, box);
}

std::string LoadNames::box_text(std::uint64_t layout, std::uint64_t box) {
  const std::string name = box_name(layout, box);
  if (name.empty() || name == std::to_string(box)) return fmt::format("box {}", box);
  return fmt::format("box {} ({})", box, printable(name));
}

std::string LoadNames::container(std::uint64_t layout) {
  const ResultsInfo& info = results_.info();
  if (!has_containers_) {
    has_containers_ = true;
    containers_ = texts("/inputs/layouts/container_type", 0, info.layouts.size());
    const std::string_view path = "/inputs/layouts/container_size";
    const auto stored = results_.has(path) ? results_.stored(path, 0, info.layouts.size())
                                           : Result<std::vector<std::byte>>(std::vector<std::byte>());
    const std::vector<Vec3> sizes = stored ? values_of<Vec3>(*stored) : std::vector<Vec3>();
    for (std::size_t i = 0; i < std::min(sizes.size(), containers_.size()); ++i)
      if (containers_[i].empty() && sizes[i].allFinite())
        containers_[i] = fmt::format("{} x {} x {} m", sizes[i].x(), sizes[i].y(), sizes[i].z());
  }
  const std::uint64_t i = layout - info.layout_begin;
  return layout >= info.layout_begin && i < containers_.size() ? containers_[i] : "";
}

const std::vector<std::string>& LoadNames::texts_of_layout(std::string_view path, std::uint64_t layout) {
  Column& column = columns_[path];
  if (column.layout != layout) {
    column = {.layout = layout};
    const ResultsInfo& info = results_.info();
    const bool is_here = layout >= info.layout_begin && layout - info.layout_begin < info.layouts.size();
    if (is_here && results_.has(path))
      if (const Result<EntryRange> boxes = results_.layout_boxes(layout - info.layout_begin, 1))
        column.texts = texts(path, boxes->begin, boxes->counts.front());
  }
  return column.texts;
}

std::string LoadNames::text(std::string_view path, std::uint64_t layout, std::uint64_t box) {
  const std::vector<std::string>& texts = texts_of_layout(path, layout);
  return box >= 1 && box <= texts.size() ? texts[box - 1] : "";
}

std::vector<std::string> LoadNames::texts(std::string_view path, std::uint64_t begin, std::uint64_t count) {
  if (count == 0 || !results_.has(path)) return {};
  const Result<std::vector<std::byte>> stored = results_.stored(path, begin, count);
  return stored ? texts_of(*stored, stored->size() / count) : std::vector<std::string>();
}

}  // namespace holdfast::internal
