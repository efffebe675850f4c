#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/native/bodies.hpp"
#include "core/native/collision/manifold.hpp"

namespace holdfast::internal::native {

/// Whether two boxes overlap so little along a width of their contact that what they have sunk may have made all of it.
/// Thin plates side by side overlap by all of their height, and are none of these.
bool is_narrow(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
               const ContactSet& contact, const ContactWidth& width);

/// How far bodies have sunk into what carries them. Boxes that press on each other overlap a little, layer by layer,
/// more at one end than at the other, and positions are corrected from some overlap on only: tops that are level in the
/// layout are not exactly so on the way, and a box that slides over them would catch on edges that are not there.
class Sinking {
 public:
  /// Bodies have moved: what is asked for next is found anew.
  void forget() { known_ = {}; }

  /// Whether the boxes would slide past each other if nothing had sunk: without that, the contact is no wider than
  /// `kFlushWidth` along one of its widths. A step that the layout has keeps its height.
  bool is_flush(const Bodies& bodies, const std::vector<Side>& sides, const std::vector<Manifold>& manifolds,
                std::int32_t a, std::int32_t b, const ContactSet& contact);

  /// How far a body, as it is near a point, is below where it would be if nothing overlapped, along the container's
  /// axis k, m; negative where it is above. Overlaps are summed down to the container and fixed boxes, each where the
  /// body above is carried nearest to the point; what these do not hold has not sunk.
  double below(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k, std::int32_t body,
               const Vec3& point);

 private:
  /// A point at which a body is carried in one direction of an axis.
  struct Support {
    std::int32_t lower;  ///< what carries it
    std::int32_t next;   ///< support of the same body; none: -1
    Vec3 point;          ///< of the surface of the contact's body a
    double gap;          ///< m
  };

  /// The supports of all bodies in one direction of an axis.
  struct Supports {
    std::vector<std::int32_t> first;  ///< of a body; none: -1
    std::vector<Support> all;
  };

  void find_supports(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k);
  std::optional<double> sunk(const Bodies& bodies, int k, bool up, std::int32_t body, const Vec3& point,
                             double height) const;

  std::array<bool, 3> known_ = {};                   ///< along an axis
  std::array<std::array<Supports, 2>, 3> supports_;  ///< along an axis, down and up
};

}  // namespace holdfast::internal::native
