#include "core/model/container_panels.hpp"

#include <algorithm>
#include <array>

#include "core/model/container_sides.hpp"

namespace holdfast::internal {

namespace {

/// @param face coordinate of the inner face along the axis, m
Panel panel_between(std::size_t side, int axis, bool far, double face, const Vec3& low, const Vec3& high) {
  Panel panel;
  panel.side = side;
  panel.normal = Vec3::Zero();
  panel.normal[axis] = far ? -1.0 : 1.0;
  panel.offset = far ? -face : face;
  panel.centre = 0.5 * (low + high);
  panel.half_extents = 0.5 * (high - low);
  return panel;
}

std::size_t axis_of(const Panel& panel) { return static_cast<std::size_t>(kContainerSides[panel.side].axis); }

}  // namespace

std::vector<Panel> container_panels(const ContainerSettings& container, double thickness) {
  const bool open = has_opening(container);
  const bool on_ground = open && container.bed_height > 0.0;
  const double wall = open ? kWallThickness : thickness;
  const double below = on_ground ? container.bed_height : thickness;
  // Panels extend over the edges that they have in common with others; at an open side they end at the edge.
  Vec3 from(0.0, 0.0, -below);
  Vec3 to = container.size;
  for (const ContainerSide& side : closed_sides(container))
    if (side.kind == SurfaceKind::wall) (side.far ? to : from)[side.axis] += side.far ? wall : -wall;

  std::vector<Panel> panels;
  for (const ContainerSide& side : closed_sides(container)) {
    Vec3 low = from;
    Vec3 high = to;
    if (side.kind == SurfaceKind::floor) {
      high.z() = 0.0;
      if (open && !on_ground) {
        low.head<2>().setConstant(-kEndless);
        high.head<2>().setConstant(kEndless);
      }
    } else {
      (side.far ? low : high)[side.axis] = side.far ? container.size[side.axis] : 0.0;
      if (const double height = wall_height(container, side); height < container.size.z()) high.z() = height;
    }
    const double face = side.far ? container.size[side.axis] : 0.0;
    Panel& panel = panels.emplace_back(panel_between(side.index, side.axis, side.far, face, low, high));
    panel.surface = {side.kind, container.friction, 0.0};
    panel.ends = open && (side.kind == SurfaceKind::wall || on_ground);
  }
  if (on_ground) {
    const Vec3 low(-kEndless, -kEndless, -below - thickness);
    const Vec3 high(kEndless, kEndless, -below);
    Panel& ground = panels.emplace_back(panel_between(kGround, 2, false, -below, low, high));
    ground.surface = {SurfaceKind::ground, container.ground_friction, 0.0};
  }
  return panels;
}

std::vector<std::vector<double>> panel_plays(const std::vector<Panel>& panels,
                                             const std::vector<std::vector<double>>& gaps) {
  std::array<int, 3> touched{};  // walls, by their axes
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const bool touches = std::any_of(gaps[k].begin(), gaps[k].end(), [](double gap) { return gap < kWallPlay; });
    if (panels[k].surface.kind == SurfaceKind::wall && touches) ++touched[axis_of(panels[k])];
  }
  std::vector<std::vector<double>> plays;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    std::vector<double>& play = plays.emplace_back(gaps[k].size(), 0.0);
    if (panels[k].surface.kind != SurfaceKind::wall) continue;
    const std::size_t axis = axis_of(panels[k]);
    const double most = axis == 2 ? kLeastPlay : touched[axis] == 2 ? kWallPlay : 0.0;
    std::transform(gaps[k].begin(), gaps[k].end(), play.begin(),
                   [most](double gap) { return std::max(0.0, most - gap); });
  }
  return plays;
}

}  // namespace holdfast::internal
