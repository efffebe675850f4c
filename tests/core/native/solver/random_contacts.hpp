#pragma once

#include <vector>

#include "core/native/collision/oriented_box.hpp"
#include "core/native/solver/body_block.hpp"
#include "random.hpp"

namespace holdfast::internal::native {

inline constexpr std::size_t kBodies = 7;
inline constexpr std::size_t kConstraints = 40;

/// Patches between random bodies and what is fixed, some with unused lanes, some frictionless, with random impulses.
struct RandomContacts {
  std::vector<ContactConstraint> constraints = std::vector<ContactConstraint>(kConstraints);
  std::vector<Arms> mid_arms = std::vector<Arms>(kConstraints);
  std::vector<BodyVector> velocity = std::vector<BodyVector>(kBodies + 1);
};

inline Vec3 arm_of(const std::array<Lanes, 3>& arms, std::size_t lane) {
  return {arms[0][lane], arms[1][lane], arms[2][lane]};
}

inline RandomContacts random_contacts(std::uint32_t seed) {
  Random random(seed);
  RandomContacts contacts;
  for (std::size_t i = 0; i < kBodies; ++i)
    for (int k = 0; k < kBodyRows; ++k) contacts.velocity[i].row[padded_row(k)] = random.between(-1, 1);
  for (std::size_t p = 0; p < kConstraints; ++p) {
    ContactConstraint& constraint = contacts.constraints[p];
    constraint.b = static_cast<std::int32_t>(random.below(kBodies));
    constraint.a = static_cast<std::int32_t>(random.below(3) == 0 ? kBodies : random.below(kBodies));
    if (constraint.a == constraint.b) constraint.a = static_cast<std::int32_t>(kBodies);
    constraint.count = static_cast<std::int32_t>(1 + random.below(kLanes));
    constraint.friction = p % 5 == 0 ? 0.0 : random.between(0.1, 1.0);
    const Mat3 axes = random.rotation().toRotationMatrix();
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t i = 0; i < 3; ++i)
        constraint.directions[d][i] = axes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(d));
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane) {
      for (std::size_t i = 0; i < 3; ++i) {
        constraint.impulse.row[i][lane] = random.between(i == 0 ? 0 : -2, 2);
        constraint.contact_velocity.row[i][lane] = random.between(-1, 1);
        constraint.velocity_bias.row[i][lane] = random.between(-0.5, 0.5);
        constraint.arms.b[i][lane] = random.between(-1, 1);
        contacts.mid_arms[p].b[i][lane] = constraint.arms.b[i][lane] + random.between(-0.1, 0.1);
        if (constraint.a == static_cast<std::int32_t>(kBodies)) continue;
        constraint.arms.a[i][lane] = random.between(-1, 1);
        contacts.mid_arms[p].a[i][lane] = constraint.arms.a[i][lane] + random.between(-0.1, 0.1);
      }
      for (std::size_t k = 0; k < 2; ++k) {
        constraint.penalty[k][lane] = random.between(0.5, 3);
        constraint.inverse_penalty[k][lane] = 1.0 / constraint.penalty[k][lane];
      }
    }
  }
  return contacts;
}

}  // namespace holdfast::internal::native
