#pragma once

#include <cstdint>
#include <vector>

#include "core/native/contact_kinematics.hpp"
#include "core/native/island/island_problem.hpp"

namespace holdfast::internal::native {

/// How the bodies of an island move through the part of a step that has been solved: at its end, and on average.
class SolvedMotion {
 public:
  /// @param solved the problem whose solution is meant; it has to outlive this
  explicit SolvedMotion(const IslandProblem& solved) : solved_(solved) {}

  /// Finds the velocities that move the bodies through the part, where nothing cuts it.
  /// @param step length of the part, s
  void find(const Bodies& bodies, const IslandView& island, const StepTerms& terms, double step);

  /// How a body moves at the end; not at all where it stays.
  Twist at_end(const Bodies& bodies, std::int32_t body) const;

  /// How a body moves on average, after `find`.
  Twist mean(const Bodies& bodies, std::int32_t body) const;

  /// Velocity of b's surface relative to a's at the end, m/s.
  Vec3 end_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const;

  /// The same along the normal: positive where the surfaces separate, m/s.
  double end_normal_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const;

  /// Moves the bodies through a share of the part, after `find` and `IslandProblem::find_missing_velocities`.
  /// @param step  length of the part, s
  /// @param share of it, up to an impact; 1: all
  void move(Bodies& bodies, const IslandView& island, double step, double share) const;

 private:
  bool jumps(const Bodies& bodies, std::uint32_t body, const StepTerms& terms, double step) const;

  const IslandProblem& solved_;
  std::vector<std::uint8_t> jumps_;        ///< a body of the scene: see `jumps`
  std::vector<BodyVector> mean_velocity_;  ///< a body of the scene
};

}  // namespace holdfast::internal::native
