#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/native/scene.hpp"
#include "core/native/solver/contact_solver.hpp"
#include "core/native/solver/warm_start_kernels.hpp"

namespace holdfast::internal::native {

/// Which contact points are solved in a step: those that are closed, or close slower than what is located in time.
struct PointFilter {
  double closed_gap = 0.0;     ///< gap that a contact closes in the step when it is as slow as that, m
  bool takes_closing = false;  ///< also those that are open and close in the step, however fast

  bool is_closed(double gap) const { return gap <= closed_gap; }
  bool takes(double gap, double normal_velocity, double step) const {
    return is_closed(gap) || (takes_closing && gap + step * normal_velocity < closed_gap);
  }
};

/// Points of the manifolds of a scene, a bit each.
using PointBits = std::vector<std::uint8_t>;

/// Writes an island as a contact problem, and takes the solution back. Geometry and masses are written by one function
/// for all kinds of problems; each kind chooses the points that take part, and fills in free velocities, biases and
/// start values.
class IslandProblem {
 public:
  ContactProblem problem;

  /// Where a constraint comes from: a manifold, and the points of its lanes.
  struct Source {
    std::uint32_t manifold;
    std::array<std::uint8_t, kLanes> point;
  };
  std::vector<Source> sources;

  /// For the velocities at the end of a step, and the impulses of the step.
  /// @param predicted points that are solved although the filter does not take them
  void prepare_step(const Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                    ContactSolver& solver, const PointFilter& filter, const PointBits& predicted);

  /// For the velocities after an impact.
  /// @param impacting of the points that the filter takes, those that take part
  void prepare_impact(const Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                      ContactSolver& solver, const PointFilter& filter, const PointBits& impacting);

  /// For impulses of a step that balance bodies at rest. Has bounds for the normal impulses.
  void prepare_rest(const Scene& scene, const IslandView& island, const StepTerms& terms, ContactSolver& solver);

  /// Starts the solve from these velocities of the bodies, in place of those that were prepared.
  /// @param velocity_of `BodyVector(std::uint32_t body)`
  template <class VelocityOf>
  void start_from(const IslandView& island, VelocityOf velocity_of) {
    for (const std::uint32_t body : island.bodies) problem.velocity[row_[body]] = velocity_of(body);
  }

  /// Caches impulses and contact velocities in their manifolds, for the next solve to start from. Points without a part
  /// in the problem have none.
  void store_step_impulses(Scene& scene, const IslandView& island, double step);
  void store_rest_impulses(Scene& scene, const IslandView& island, double step);

  /// Turns the problem of `prepare_rest` into that of the least force on the walls, in which these have no bounds.
  /// @param cost of an impulse on a wall, m/s
  void minimise_wall_forces(const Scene& scene, double cost);
  /// The cost of the impulses on the walls, kg m²/s².
  double wall_cost() const;

  /// Adds the impulses on the sides of the container, times a factor. What sleeping bodies take counts as the floor's.
  void add_pushes(const Scene& scene, double factor, std::vector<SidePush>& pushes) const;

  /// Sum of the impulses from outside in the step, as numbers, N s.
  double outside_impulse() const { return outside_impulse_; }

  /// Index of a body of the island in the problem.
  std::size_t row(std::uint32_t body) const { return row_[body]; }

  /// What is solved for, of a body of the island.
  const BodyVector& solution(std::uint32_t body) const { return problem.velocity[row_[body]]; }

  /// Makes the impulses y of the solution those that its velocities follow from, y + R (z − u), which are y once the
  /// solve has converged, and may lie outside of the cones.
  void complete_impulses();

  /// Finds what the velocities of the solution lack of those that its impulses give the bodies, for the next step.
  /// Where something hits, the impulses are completed first, and nothing but rounding and the turn of arms is missing:
  /// the impulses of an impact end with it, and what is left of them would drive bodies apart.
  void find_missing_velocities();
  /// That of a body of the island, after `find_missing_velocities`.
  const BodyVector& missing_velocity(std::uint32_t body) const { return missing_velocity_[row_[body]]; }

  /// Whether the body's moments of inertia in the problem are those of the end of the step, to which it turns.
  bool turns(std::uint32_t body) const { return motion_[row_[body]].turns; }

  /// Whether a contact of the step closes too fast for the step and too slow to be located, at any or at this body.
  bool has_late_impact() const { return has_late_impact_; }
  bool has_late_impact(std::uint32_t body) const { return late_impact_[row_[body]] != 0; }

 private:
  struct PointView;

  /// A body or side of a manifold, at the start of the step; without motion where it stays.
  struct End {
    std::int32_t row = 0;  ///< in the problem
    bool moves = false;
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 angular_velocity = Vec3::Zero();
    double inverse_mass = 0.0;

    Vec3 velocity_at(const Vec3& arm) const { return velocity + angular_velocity.cross(arm); }
  };

  void begin(const Scene& scene, const IslandView& island, const StepTerms& terms, double step, ContactSolver& solver);
  bool predict(const Scene& scene, const IslandView& island, const StepTerms& terms, double step);
  void push(const Bodies& bodies, std::uint32_t body, double step);
  template <class TakesPart, class FillPoint>
  void add_constraints(const Scene& scene, std::uint32_t index, TakesPart takes_part, FillPoint fill);
  template <class AddManifold>
  void for_each_active(const Scene& scene, const IslandView& island, AddManifold add);
  template <class Store>
  void store_impulses(Scene& scene, double step, Store store);
  End end_of(const Bodies& bodies, std::int32_t body) const;

  std::vector<std::uint32_t> row_;         ///< a body of the scene
  std::vector<BodyPair> pairs_;            ///< by position in the island
  std::vector<BodyMotion> motion_;         ///< a row
  std::vector<std::uint8_t> late_impact_;  ///< a row
  bool has_late_impact_ = false;
  double outside_impulse_ = 0.0;
  std::vector<LaneWrench> wrench_;
  std::vector<BodyVector> missing_velocity_;  ///< a row
  std::vector<ContactStart> start_;           ///< one per constraint: of this step, and after its solution of the next
};

}  // namespace holdfast::internal::native
