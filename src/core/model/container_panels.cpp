#include "core/model/container_panels.hpp"

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

}  // namespace holdfast::internal
