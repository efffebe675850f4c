#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// Finds displacements of the bodies of an island that take its overlaps away.
///
/// Of all displacements d (shift and turn of each body) that leave no overlap, the smallest in the norm of the masses:
///   minimise ½ dᵀ M d  subject to  gap + J d ≥ 0
/// by the projected Gauss-Seidel iteration on the impulses y ≥ 0 of the points, d = M⁻¹ Jᵀ y. In the manner of
/// Southwell's relaxation it visits only contacts that overlap and those of bodies that it has moved: the cost follows
/// how far the displacements reach, not the size of the island.
class PositionCorrection {
 public:
  /// @param tolerance overlap that may be left, m
  void find(const Scene& scene, const IslandView& island, double tolerance);

  /// Whether the last `find` displaces a body; false for a side of the container, whose index is negative.
  bool moves(std::int32_t body) const { return body >= 0 && displacements_[static_cast<std::size_t>(body)].moves; }

  /// Displacement of the body's centre of mass, m, and rotation vector about it, rad.
  const Vec3& shift(std::uint32_t body) const { return displacements_[body].shift; }
  const Vec3& turn(std::uint32_t body) const { return displacements_[body].turn; }

 private:
  struct Displacement {
    bool moves = false;
    double inverse_mass = 0.0;  ///< 1/kg; 0: not looked up yet, or the body is fixed
    Mat3 inverse_inertia = Mat3::Zero();
    Vec3 shift = Vec3::Zero();
    Vec3 turn = Vec3::Zero();
  };

  void find_contacts_of_bodies(const Scene& scene, const IslandView& island);
  Displacement& displacement_of(const Bodies& bodies, std::int32_t body);
  bool separate(const Bodies& bodies, const Manifold& manifold, double tolerance, std::array<double, 8>& impulse);
  void visit_later(std::uint32_t contact);

  std::vector<Displacement> displacements_;      ///< a body of the scene
  Displacement fixed_;                           ///< of what is fixed: none
  std::vector<std::array<double, 8>> impulses_;  ///< a contact of the island: of its points, kg m
  std::vector<std::uint32_t> first_of_body_;     ///< a body of the scene: its range in `of_bodies_`
  std::vector<std::uint32_t> of_bodies_;         ///< contacts of the island, by body
  std::vector<std::uint32_t> visits_;            ///< contacts of the island in the order in which they are visited
  std::vector<std::uint8_t> waits_;              ///< a contact of the island: its next visit lies ahead
};

}  // namespace holdfast::internal::native
