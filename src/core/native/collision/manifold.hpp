#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/native/bodies.hpp"
#include "core/native/collision/box_box.hpp"

namespace holdfast::internal::native {

/// A side of the container as a body that does not move.
struct Side {
  HalfSpace space;
  Surface surface;
  std::vector<double> play;  ///< a body: how far behind its place the side stands for it, m
};

/// What a point's last solve left for the next to start from, container frame.
struct PointMemory {
  Vec3 force = Vec3::Zero();  ///< on b, N
  Vec3 slip = Vec3::Zero();   ///< m/s
  double pressed = 0.0;       ///< normal force of the last step, not of a proof of rest, N
};

/// A pair of bodies that touch or soon may, with the memory of its points.
struct Manifold {
  // First what is looked at where nothing else is: in one cache line.
  std::int32_t a = 0;  ///< body, or −1 − side of the container
  std::int32_t b = 0;  ///< body
  /// The pair is solved together. A pair that merely touches is not, as long as the solution without it keeps the
  /// two apart: islands stay small, and no pair carries what nothing pushes into it.
  bool active = false;
  int idle_steps = 0;  ///< solved steps since it last carried load
  double friction = 0.0;
  double restitution = 0.0;
  ContactSet contact;
  std::array<PointMemory, 8> memory;
  std::array<OrientedBox, 2> found_at;  ///< a and b where the contact was found; a side stays where it is

  void activate() {
    active = true;
    idle_steps = 0;
  }

  bool with_side() const { return a < 0; }
};

/// Whether an end of the manifold is among the marked bodies. What is fixed never is.
inline bool has_end_in(const Manifold& manifold, const std::vector<std::uint8_t>& marked) {
  return marked[static_cast<std::size_t>(manifold.b)] != 0 ||
         (!manifold.with_side() && marked[static_cast<std::size_t>(manifold.a)] != 0);
}

/// The manifold's directions: the normal and two tangents that depend on it alone.
std::array<Vec3, 3> directions_of(const Vec3& normal);

/// Takes the new contact, found where the bodies are now, and carries each point's memory over from the old point that,
/// as part of one of the bodies, has come nearest to it.
void renew_contact(Manifold& manifold, const ContactSet& contact, const Bodies& bodies);

/// Contact of two bodies where they are now; `a` as in `Manifold`, `margin` and `previous` as for `contact_of`.
ContactSet contact_now(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
                       double margin, const ContactAxis& previous);

}  // namespace holdfast::internal::native
