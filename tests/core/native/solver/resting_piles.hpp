#pragma once

#include <limits>
#include <vector>

#include "core/native/solver/contact_problem.hpp"

namespace holdfast::internal::native {

inline constexpr double kStep = 0.01;
inline constexpr double kGravity = 9.81;
inline constexpr double kNoBound = std::numeric_limits<double>::infinity();

struct PileBox {
  double mass = 1.0;
  Vec3 centre = Vec3::Zero(), size = Vec3::Ones();
};

/// Boxes under gravity and a horizontal acceleration of the container, in their order of elimination.
struct Pile {
  std::vector<PileBox> boxes;
  ContactProblem problem;
  double unit = 0.0;  ///< speed that loads gain within the step

  Pile(const std::vector<PileBox>& given, const Vec3& load) : boxes(given), unit(kStep * load.norm()) {
    for (const PileBox& box : boxes) {
      ProblemBody& body = problem.bodies.emplace_back();
      body.mass = box.mass;
      body.radius = 0.5 * box.size.norm();
      for (int k = 0; k < 3; ++k)
        body.inertia(k, k) = box.mass / 12.0 * (box.size.squaredNorm() - box.size[k] * box.size[k]);
      const Vec3 free = kStep * load;
      problem.free_velocity.push_back({{free.x(), free.y(), free.z()}});
    }
    problem.velocity.resize(boxes.size() + 1);
  }

  int fixed() const { return static_cast<int>(boxes.size()); }

  /// Presses a whole face of box b, four corners of it, against a, which is another box or fixed.
  /// @param axis  of the normal, which points from a to b if `sign` is 1, and against the axis if it is -1
  void add_face(int a, int b, int axis, double sign, double friction, double bound = kNoBound) {
    const auto is_fixed = [&](int body) { return body == fixed(); };
    ContactConstraint& contact = problem.constraints.emplace_back();
    contact.a = a;
    contact.b = b;
    contact.count = kLanes;
    contact.friction = friction;
    const PileBox& box = boxes[static_cast<std::size_t>(b)];
    double inverse_masses = 1.0 / box.mass;
    if (!is_fixed(a)) inverse_masses += 1.0 / boxes[static_cast<std::size_t>(a)].mass;
    contact.effective_mass = 1.0 / (inverse_masses * kLanes);
    const int along[3] = {axis, (axis + 1) % 3, (axis + 2) % 3};
    for (std::size_t d = 0; d < 3; ++d) contact.directions[d][static_cast<std::size_t>(along[d])] = d == 0 ? sign : 1.0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      Vec3 arm = 0.5 * box.size;
      arm[along[0]] *= -sign;
      if (lane % 2 == 0) arm[along[1]] *= -1.0;
      if (lane / 2 == 0) arm[along[2]] *= -1.0;
      const Vec3 point = box.centre + arm;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        contact.arms.b[k][lane] = arm[row];
        if (!is_fixed(a)) contact.arms.a[k][lane] = (point - boxes[static_cast<std::size_t>(a)].centre)[row];
      }
    }
    problem.normal_bounds.push_back({{bound, bound, bound, bound}});
    problem.constraint_pair.push_back(is_fixed(a) ? kNoPair : static_cast<std::uint32_t>(problem.pairs.size()));
    if (!is_fixed(a)) problem.pairs.emplace_back(a, b);
  }
};

/// Gravity and what an acceleration of the container adds.
inline Vec3 load(double x, double y = 0.0, double z = -kGravity) { return {x, y, z}; }

/// A box on a floor.
inline Pile box_on_floor(const Vec3& size, double friction, const Vec3& load, double mass = 3.0) {
  Pile pile({{mass, Vec3(0, 0, 0.5 * size.z()), size}}, load);
  pile.add_face(pile.fixed(), 0, 2, 1.0, friction);
  return pile;
}

/// Boxes of 1 m x 1 m x 0.5 m upon each other, the uppermost first, as they are eliminated.
inline Pile stack(const std::vector<double>& masses, const std::vector<double>& frictions, const Vec3& load) {
  std::vector<PileBox> boxes;
  const auto count = static_cast<int>(masses.size());
  for (int i = 0; i < count; ++i)
    boxes.push_back({masses[static_cast<std::size_t>(i)], Vec3(0, 0, 0.5 * (count - i) - 0.25), Vec3(1, 1, 0.5)});
  Pile pile(boxes, load);
  for (int i = 0; i < count; ++i) pile.add_face(i + 1, i, 2, 1.0, frictions[static_cast<std::size_t>(i)]);
  return pile;
}

/// A box that is pushed against a wall, which pushes no more than `bound` at each of four points.
inline Pile box_at_wall(double push, double wall_friction, double bound, double floor_friction = 0.0) {
  Pile pile({{2.0, Vec3(0, 0, 0.5), Vec3(2, 2, 1)}}, load(push));
  pile.add_face(pile.fixed(), 0, 2, 1.0, floor_friction);
  pile.add_face(pile.fixed(), 0, 0, -1.0, wall_friction, bound);
  return pile;
}

}  // namespace holdfast::internal::native
