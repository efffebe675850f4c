#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/native/bodies.hpp"
#include "core/native/collision/box_box.hpp"

namespace holdfast::internal::native {

/// A side of the container as a body that does not move.
struct Side {
  std::size_t index = 0;             ///< in `kPushedNames`
  HalfSpace space;                   ///< beyond its inner face
  std::optional<OrientedBox> block;  ///< what there is of it, where it ends and boxes can get round its edges
  Surface surface;
  std::vector<double> play;  ///< a body: how far the side stands back for it, m
};

/// What the last solve found at a point, from which the next one starts; container frame.
struct CachedImpulse {
  Vec3 force = Vec3::Zero();             ///< on b, N
  Vec3 contact_velocity = Vec3::Zero();  ///< m/s
  double pressed = 0.0;                  ///< normal force of the last step, not of a proof of rest, N
};

/// A pair of bodies that touch or soon may, with the impulses of its points.
struct alignas(64) Manifold {
  // First what most loops read, and nothing else: in one cache line.
  std::int32_t a = 0;  ///< body, or −1 − side of the container
  std::int32_t b = 0;  ///< body
  /// The pair is part of a solve. A pair that merely touches is not, as long as the solution without it keeps the two
  /// apart: islands stay small, and no pair carries a force that nothing pushes into it.
  bool active = false;
  bool slides = false;           ///< in the part of the step that is solved, or at its end: friction is kinetic
  std::uint32_t idle_steps = 0;  ///< solved steps since it last carried a force
  double friction = 0.0;         ///< static
  double kinetic_friction = 0.0;
  double restitution = 0.0;
  double nearest_gap = std::numeric_limits<double>::infinity();  ///< of the contact's points, m
  ContactSet contact;
  std::array<CachedImpulse, 8> cached;  ///< zero where the pair is not active
  std::array<OrientedBox, 2> found_at;  ///< a and b where the contact was found; a side stays where it is

  void activate() {
    active = true;
    idle_steps = 0;
  }

  void deactivate() {
    active = false;
    cached = {};
  }

  bool with_side() const { return a < 0; }

  /// Whether the last solve has found a force at a point that pushes its bodies apart.
  bool carries(int point) const { return cached[static_cast<std::size_t>(point)].force.dot(contact.normal) > 0.0; }

  /// Whether it has found one at any point.
  bool carries() const {
    for (int i = 0; i < contact.count; ++i)
      if (carries(i)) return true;
    return false;
  }

  /// Coefficient of friction, as it sticks or slides.
  double friction_now() const { return slides ? kinetic_friction : friction; }
};

/// Forgets the forces of a manifold whose friction has changed: those that balanced may lie outside of the new cones,
/// and would pass as a proof of rest.
inline void forget_forces(Manifold& manifold) {
  for (CachedImpulse& cached : manifold.cached) cached = {.pressed = cached.pressed};
}

/// Which of the scene's sides a manifold with one is at.
inline std::size_t side_of(const Manifold& manifold) { return static_cast<std::size_t>(-1 - manifold.a); }

/// Whether a body of the manifold is among the marked ones. Fixed bodies never are.
inline bool has_end_in(const Manifold& manifold, const std::vector<std::uint8_t>& marked) {
  return marked[static_cast<std::size_t>(manifold.b)] != 0 ||
         (!manifold.with_side() && marked[static_cast<std::size_t>(manifold.a)] != 0);
}

/// Whether a body of the manifold does this.
inline bool has_end_in(const Manifold& manifold, const Bodies& bodies, Activity what) {
  return bodies.activity[static_cast<std::size_t>(manifold.b)] == what ||
         (!manifold.with_side() && bodies.activity[static_cast<std::size_t>(manifold.a)] == what);
}

/// The normal and two tangents that depend on it alone.
std::array<Vec3, 3> directions_of(const Vec3& normal);

/// Takes the new contact, found where the bodies are now, and carries each point's cached impulse over from the old
/// point that, as part of one of the bodies, has come nearest to it.
void update_contact(Manifold& manifold, const ContactSet& contact, const Bodies& bodies);

/// The contact of two bodies as it is when they have moved, with the same normal and the same points of their surfaces.
/// @param then,now a and b where the contact was found, and where they are
ContactSet carried_along(const ContactSet& contact, const std::array<OrientedBox, 2>& then,
                         const std::array<OrientedBox, 2>& now);

/// Where the bodies of a pair are; a side stays where it is.
std::array<OrientedBox, 2> poses_of(const Bodies& bodies, std::int32_t a, std::int32_t b);

/// Contact of two bodies where they are now; `a` as in `Manifold`, `margin` and `previous` as for `contact_of`.
ContactSet contact_now(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
                       double margin, const ContactAxis& previous);

}  // namespace holdfast::internal::native
