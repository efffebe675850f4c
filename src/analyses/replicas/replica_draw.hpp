#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Hash of the numbers of a layout's boxes (64-bit FNV-1a of their bits): what replicas of its worlds are seeded by, so
/// that they are the same from a file and from memory.
std::uint64_t boxes_hash(const Layout& layout);

/// What a replica of a world varies, each as a factor of the nominal value.
struct ReplicaDraw {
  std::map<MaterialName, double> materials;  ///< of the friction of boxes' surfaces; model `product`
  std::map<std::string, double> pairs;       ///< of rows of [Friction], by their keys; model `pairs`
  double mats = 1.0;                         ///< of anti-slip mats
  double container = 1.0;                    ///< of the friction of the container's surfaces; model `product`
  double box_box = 1.0;                      ///< of the coefficient of two boxes; model `pairs`, as are the next two
  double box_floor = 1.0;
  double box_wall = 1.0;
  double acceleration = 1.0;
};

/// The draw of a replica: a function of its arguments alone, with the same bits on every machine. It is the same for
/// all accelerations of a layout.
///
/// Each factor is normal with mean 1, and cut off at three standard deviations. The friction coefficient of two boxes
/// of one material, and of a box and the container, varies by `FrictionSpread`; of two boxes of different materials, by
/// 1/√2 of it, since both surfaces would have to be bad.
/// @param boxes  `boxes_hash` of the layout
/// @param number of the replica, from 1
/// @param pairs  of materials that have coefficients of their own
ReplicaDraw draw_replica(const Layout& layout, std::uint64_t boxes, std::uint32_t number,
                         const ScreeningSettings& spreads, std::span<const FrictionTable::Row> pairs = {});

/// Lowers every factor of friction to that of another draw of the same layout, where that is smaller.
void lower_friction(ReplicaDraw& draw, const ReplicaDraw& other);

/// The settings of a run with the friction of a replica.
Settings with_friction(const Settings& settings, const ReplicaDraw& draw);

}  // namespace holdfast::internal
