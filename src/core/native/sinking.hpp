#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/native/bodies.hpp"
#include "core/native/collision/manifold.hpp"

namespace holdfast::internal::native {

/// Whether two boxes overlap so little beside their contact that what they have sunk may have made all of it. Thin
/// plates side by side overlap by all of their height, and are none of these.
bool is_narrow(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
               const ContactSet& contact);

/// How far bodies have sunk into what carries them. Boxes that press on each other overlap a little, layer by layer,
/// and positions are corrected from some overlap on only: tops that are level in the layout are not exactly so on the
/// way, and a box that slides over them would catch on edges that are not there.
class Sinking {
 public:
  /// Bodies have moved: what is asked for next is found anew.
  void forget() { known_ = {}; }

  /// Whether the boxes would slide past each other if nothing had sunk: without that, the contact is no wider than
  /// `kFlushWidth`. A step that the layout has keeps its height.
  bool is_flush(const Bodies& bodies, const std::vector<Side>& sides, const std::vector<Manifold>& manifolds,
                std::int32_t a, std::int32_t b, const ContactSet& contact);

  /// How far a body is below where it would be if nothing overlapped, along the container's axis k, m; negative where
  /// it is above. Overlaps are summed up from the container and fixed boxes on; what these do not hold has not sunk.
  double below(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k, std::size_t body);

 private:
  void add_up(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k, double up);

  std::array<bool, 3> known_ = {};            ///< along an axis
  std::array<std::vector<double>, 3> below_;  ///< along an axis, a body each, m
  std::vector<double> sum_;                   ///< of overlaps below a body; negative where nothing holds it, m
  std::vector<std::pair<double, const Manifold*>> from_below_;
};

}  // namespace holdfast::internal::native
