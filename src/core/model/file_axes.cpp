#include "core/model/file_axes.hpp"

namespace holdfast::internal {

namespace {

constexpr std::string_view kAxisNames = "xyz";

}  // namespace

Vec3 FileAxes::extents(const Vec3& of_file) const {
  return {of_file[static_cast<Eigen::Index>(axes[0].of_file)], of_file[static_cast<Eigen::Index>(axes[1].of_file)],
          of_file[static_cast<Eigen::Index>(axes[2].of_file)]};
}

std::pair<Vec3, Vec3> FileAxes::corners(const Vec3& low, const Vec3& high, const Vec3& container_size) const {
  Vec3 min = extents(low);
  Vec3 max = extents(high);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!axes[i].from_end) continue;
    const auto k = static_cast<Eigen::Index>(i);
    const double far = min[k];
    min[k] = container_size[k] - max[k];
    max[k] = container_size[k] - far;
  }
  return {min, max};
}

std::optional<FileAxes> parse_axes(std::string_view text) {
  FileAxes read;
  std::array<bool, 3> seen{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ' || text[i] == '\t' || text[i] == ',') {
      ++i;
      continue;
    }
    const bool from_end = text[i] == '-';
    if (from_end) ++i;
    const std::size_t axis = i < text.size() ? kAxisNames.find(text[i]) : std::string_view::npos;
    if (axis == std::string_view::npos || count == 3 || seen[axis]) return std::nullopt;
    seen[axis] = true;
    read.axes[count++] = {axis, from_end};
    ++i;
  }
  return count == 3 ? std::optional(read) : std::nullopt;
}

std::string axes_text(const FileAxes& axes) {
  std::string text;
  for (const FileAxes::Axis& axis : axes.axes) {
    if (!text.empty()) text += ' ';
    if (axis.from_end) text += '-';
    text += kAxisNames[axis.of_file];
  }
  return text;
}

}  // namespace holdfast::internal
