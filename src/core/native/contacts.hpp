#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/model/contact_law.hpp"
#include "core/native/collision/broad_phase.hpp"
#include "core/native/collision/pair_table.hpp"
#include "core/native/connectivity.hpp"
#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// The pairs of a world that are near each other: finds them, and keeps the scene's manifolds. Notes which bodies have
/// met in a step although no contact had shown it.
class Contacts {
 public:
  /// @param law    coefficients of the surfaces
  /// @param missed overlap of a missed contact from which its bodies count as missed, m
  Contacts(const ContactSettings& law, double missed) : law_(law), missed_overlap_(missed) {}

  /// Finds the contacts of bodies that have moved, from where they are now.
  /// @param islands of the last step
  /// @param moved   a body: not 0 where it has moved
  void find(Scene& scene, const StepTerms& terms, const Connectivity& islands, const std::vector<std::uint8_t>& moved);

  /// Ends the contacts of bodies that have just fallen asleep with what stays, where the position correction before has
  /// separated them: `find` looks at those of moving bodies only.
  void end_separated_from_sleeping(Scene& scene);

  /// Marks bodies that have passed through others in the step. Contacts are looked for along the velocities at its
  /// start: a body that an impact deflects may be beyond another at the end, where no contact shows.
  /// @param before state at the start of the step
  void find_tunnelled(const Scene& scene, const StepTerms& terms, const StateColumns& before);

  /// A contact that showed too late in a step, when its bodies overlapped already.
  struct Late {
    std::int32_t a, b;
    ContactSet contact;
    std::array<OrientedBox, 2> found_at;
  };

  /// Bodies that have met since `forget_missed` although no contact had shown it, by body: 1 or 0. A body that has
  /// taken the whole step is no obstacle to one that takes half of it.
  const std::vector<std::uint8_t>& missed() const { return missed_; }
  void forget_missed(std::size_t bodies);

  /// The late contacts since then, taken back to where their bodies are now, at the start of the step. None where one
  /// overlaps there: its normal is not that along which the bodies met.
  std::vector<Late> late_at_start(const Scene& scene) const;

  /// Gives the pairs these contacts.
  void set(Scene& scene, const std::vector<Late>& contacts);

  /// Changes the coefficients of all surfaces.
  void set_law(Scene& scene, const ContactSettings& law);

  const PairTable& pairs() const { return pairs_; }

 private:
  /// A contact whose bodies may be flush, see `is_narrow`.
  struct Narrow {
    std::int32_t a, b;
    ContactSet contact;
  };

  void update_pair(Scene& scene, const StepTerms& terms, const Connectivity& islands, std::int32_t a, std::int32_t b);
  void update_sides(Scene& scene, const StepTerms& terms, const Connectivity& islands, std::size_t body, double margin);
  void take(Scene& scene, const Connectivity& islands, std::int32_t a, std::int32_t b, const ContactSet& contact);
  void set_contact(Scene& scene, std::int32_t a, std::int32_t b, const ContactSet& contact);
  void end_manifold(Scene& scene, std::size_t index);
  void set_surfaces(const Scene& scene, Manifold& manifold, const Vec3& normal) const;
  void turn_surfaces(const Scene& scene, Manifold& manifold, const Vec3& normal) const;
  void mark_missed(const Bodies& bodies, std::int32_t a, std::int32_t b);

  ContactSettings law_;
  double missed_overlap_;
  PairTable pairs_;  ///< the manifold of body or side a and body b; of two bodies a < b
  BroadPhase broad_phase_;
  std::vector<std::uint8_t> missed_;
  std::vector<Late> late_;
  // Work buffers of `find`.
  std::vector<Narrow> narrow_;
  std::vector<std::uint8_t> near_sides_;  ///< a body that has moved: the sides that it is near, a bit each
  std::vector<Vec3> lower_, upper_;       ///< bounds of the bodies, grown by their speculative margins, m
};

}  // namespace holdfast::internal::native
