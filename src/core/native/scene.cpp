#include "core/native/scene.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/model/container_panels.hpp"
#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// Gaps of a side to the boxes beside it; infinite to the others.
std::vector<double> gaps_to(const Side& side, const std::vector<OrientedBox>& boxes) {
  std::vector<double> gaps(boxes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const ContactSet contact =
        side.block ? contact_of(*side.block, boxes[i], kLeastPlay, {}) : contact_of(side.space, boxes[i], kLeastPlay);
    // A box on the edge of a wall is not beside it.
    if (contact.count > 0 && contact.normal.dot(side.space.normal) > 0.5) gaps[i] = contact.nearest_gap();
  }
  return gaps;
}

std::vector<Side> sides_of(const ContainerSettings& container, const std::vector<OrientedBox>& boxes) {
  const std::vector<Panel> panels = container_panels(container, kWallThickness);
  std::vector<Side> sides;
  std::vector<std::vector<double>> gaps;
  for (const Panel& panel : panels) {
    Side& made = sides.emplace_back();
    made.index = panel.side;
    made.space = {panel.normal, panel.offset};
    made.surface = panel.surface;
    if (panel.ends) made.block = OrientedBox{.centre = panel.centre, .half_extents = panel.half_extents};
    gaps.push_back(gaps_to(made, boxes));
  }
  std::vector<std::vector<double>> plays = panel_plays(panels, gaps);
  for (std::size_t k = 0; k < sides.size(); ++k) sides[k].play = std::move(plays[k]);
  return sides;
}

}  // namespace

Scene scene_of(const WorldBatch& batch, const World& world, const Settings& settings) {
  Scene scene;
  scene.bodies = bodies_of(batch, world);
  scene.sides = sides_of(world.container, scene.bodies.shape);
  scene.side_forces = SideForces(settings.screening.measures_walls());
  return scene;
}

const Side* floor_of(const Scene& scene) {
  const auto floor = std::find_if(scene.sides.begin(), scene.sides.end(),
                                  [](const Side& side) { return side.surface.kind == SurfaceKind::floor; });
  return floor == scene.sides.end() ? nullptr : &*floor;
}

}  // namespace holdfast::internal::native
