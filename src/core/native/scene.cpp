#include "core/native/scene.hpp"

#include <algorithm>

#include "core/model/container_panels.hpp"
#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

std::vector<Side> sides_of(const ContainerSettings& container, const std::vector<OrientedBox>& boxes) {
  std::vector<Side> sides;
  for (const Panel& panel : container_panels(container, kWallThickness)) {
    Side& made = sides.emplace_back();
    made.index = panel.side;
    made.space = {panel.normal, panel.offset};
    made.surface = panel.surface;
    if (panel.ends) made.block = OrientedBox{.centre = panel.centre, .half_extents = panel.half_extents};
    made.play.assign(boxes.size(), 0.0);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const ContactSet contact =
          made.block ? contact_of(*made.block, boxes[i], kLeastPlay, {}) : contact_of(made.space, boxes[i], kLeastPlay);
      // A box on the edge of a wall is not beside it.
      if (contact.count > 0 && contact.normal.dot(panel.normal) > 0.5)
        made.play[i] = side_play(panel.side, contact.nearest_gap());
    }
  }
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
