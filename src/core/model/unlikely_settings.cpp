#include "core/model/unlikely_settings.hpp"

#include <algorithm>

#include "core/model/container_sides.hpp"

namespace holdfast::internal {

std::vector<UnlikelySetting> unlikely_settings(const ContainerSettings& container, const ScreeningSettings& screening) {
  std::vector<UnlikelySetting> unlikely;
  const Vec3& size = container.size;
  if (std::any_of(container.drop_sides.begin(), container.drop_sides.end(),
                  [&](const DropSide& drop) { return drop.height > size.z(); }))
    unlikely.push_back({"Container", "DropSides", "a drop side is higher than the container"});
  if (screening.move_threshold > std::min(size.x(), size.y()))
    unlikely.push_back({"Screening", "MoveThreshold",
                        "MoveThreshold, which is in m, is more than the width or length of the container"});
  if (screening.drop_threshold > size.z())
    unlikely.push_back({"Simulation Settings", "DropThreshold",
                        "DropThreshold, which is in m, is more than the height of the container"});
  else if (has_opening(container) && container.bed_height > 0.0 && container.bed_height <= screening.drop_threshold)
    unlikely.push_back({"Container", "BedHeight",
                        "BedHeight is not above DropThreshold, so that a box on the ground may be moved and not "
                        "fallen"});
  return unlikely;
}

}  // namespace holdfast::internal
