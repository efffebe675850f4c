#pragma once

#include <span>

#include "core/model/acceleration.hpp"

// How much of a phase that is sampled a step may take with the mean of the samples.

namespace holdfast::internal::native {

/// A block that slides alone on a level surface of the container, by Coulomb's law: it tells what the samples within a
/// step do to a contact that their mean does not. What friction cannot hold for a moment is lost in the mean.
struct LoneBlock {
  double friction = 0.0;          ///< static coefficient; 0: nothing holds it
  double kinetic_friction = 0.0;  ///< coefficient while it slides
  Vec3 slip = Vec3::Zero();       ///< horizontal velocity at the begin of the step, m/s; zero: it sticks

  bool operator==(const LoneBlock&) const = default;
};

/// The phase from `begin` on, for as long as a step with the mean of its samples leads every block, and what moves
/// freely, to where the samples lead it, within `kSlack` and `kSampledShift`: all of it, or half of its samples,
/// a quarter, ..., or one.
/// @param phase   with samples
/// @param begin   s, within the phase
/// @param gravity without the acceleration, m/s²
/// @param blocks  one for each kind of contact; where a body turns, flies or is lifted also one that nothing
///                holds, since it follows each push, and not their mean
Phase next_part(const Phase& phase, double begin, const Vec3& gravity, std::span<const LoneBlock> blocks);

}  // namespace holdfast::internal::native
