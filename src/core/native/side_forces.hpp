#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/native/bodies.hpp"

namespace holdfast::internal::native {

struct IslandView;
struct Scene;
struct StepTerms;

/// An impulse of a body on a side of the container.
struct SidePush {
  std::uint32_t body = 0;
  std::size_t side = 0;  ///< in `kPushedNames`
  Vec3 impulse;          ///< on the side, N s; of a body at rest, in a second
  Vec3 point;            ///< m
};

/// What the boxes of a world do to the sides of its container, where that is asked for. All sides together balance the
/// load.
class SideForces {
 public:
  explicit SideForces(bool wanted = false) : wanted_(wanted) {}

  /// Whether anybody asks for the forces on the sides. Else nothing is noted.
  bool wanted() const { return wanted_; }

  /// Sums of the steps since the last `begin_sum`.
  const SideImpulses& sum() const { return sum_; }
  void begin_sum() { sum_ = {}; }
  /// Takes the sums back to what they were.
  void set_sum(const SideImpulses& sum) { sum_ = sum; }

  /// Impulses of moving bodies in the step that is being taken, in its parts and impacts. They count when it is
  /// accepted.
  std::vector<SidePush>& of_step() { return of_step_; }
  /// Forgets those of the bodies that are marked.
  void forget(const std::vector<std::uint8_t>& bodies);
  void accept_step();

  /// Impulses in a second of the bodies of an island that rests, to be filled anew.
  std::vector<SidePush>& of_resting(const IslandView& island);
  /// Adds what resting bodies do.
  void add_resting(const Bodies& bodies, double duration);

  /// Adds what sleeping bodies do by themselves: what they did when they fell asleep. What moving bodies do to them
  /// counts as pushing the floor (`IslandProblem::add_pushes`) until they wake, as does what is left over.
  void add_sleeping(const Scene& scene, const StepTerms& terms, double duration);
  /// Adds the momentum of a body that is about to be stopped: it pushes the floor.
  void add_stopped(const Scene& scene, std::size_t body);

 private:
  void push_floor(const Scene& scene, std::size_t body, const Vec3& impulse);

  bool wanted_ = false;
  SideImpulses sum_;
  std::vector<SidePush> of_step_, of_resting_;
  std::vector<Vec3> left_;  ///< a body that sleeps: impulse that its contacts leave over in a step, N s
};

}  // namespace holdfast::internal::native
