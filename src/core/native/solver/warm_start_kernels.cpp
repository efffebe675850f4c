// Arithmetic of start values, once for every instruction set, chosen at run time.
#include "core/native/solver/warm_start_kernels.hpp"

#include "core/native/constants.hpp"
#include "core/native/solver/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/native/solver/warm_start_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/native/solver/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE {
namespace {

/// The same vector for all points.
HWY_INLINE Triple all(const double* v) { return {{Four::all(v[0]), Four::all(v[1]), Four::all(v[2])}}; }

/// Inner product in the order in which Eigen sums.
HWY_INLINE Four inner(const Triple& a, const Triple& b) {
  return a.at[0] * b.at[0] + (a.at[1] * b.at[1] + a.at[2] * b.at[2]);
}

HWY_INLINE Triple rotated(const std::array<std::array<double, 3>, 3>& turn, const Triple& v) {
  return {{inner(all(turn[0].data()), v), inner(all(turn[1].data()), v), inner(all(turn[2].data()), v)}};
}

/// x where a > b, else 0.
HWY_INLINE Four where_greater(const Four& a, const Four& b, const Four& x) {
  Four p;
  for (std::size_t i = 0; i < Four::kVectors; ++i)
    p.part[i] = hn::IfThenElseZero(hn::Gt(a.part[i], b.part[i]), x.part[i]);
  return p;
}

HWY_INLINE Triple direction(const ContactConstraint& constraint, std::size_t i) {
  return all(constraint.directions[i].data());
}

/// Impulses and contact velocities from those of the last step. The bias is part of the contact velocity.
HWY_INLINE void start_one(double step, const ContactStart& start, ContactConstraint& constraint) {
  const Four length = Four::all(step);
  const Triple force = Triple::load(start.force.row);
  const Triple contact_velocity = Triple::load(start.contact_velocity.row);
  for (std::size_t i = 0; i < 3; ++i) {
    const Triple along = direction(constraint, i);
    const Four impulse = length * inner(force, along);
    const Four velocity = inner(contact_velocity, along);
    if (i == 0) {
      impulse.store(constraint.expected_impulse.data());
      max(impulse, Four::all(0.0)).store(constraint.impulse.row[i].data());
      velocity.store(constraint.contact_velocity.row[i].data());
    } else {
      impulse.store(constraint.impulse.row[i].data());
      (velocity + Four::load(constraint.velocity_bias.row[i].data())).store(constraint.contact_velocity.row[i].data());
    }
  }
}

HWY_INLINE Triple velocity_at(const BodyMotion& body, const Triple& arm) {
  return all(body.velocity.data()) + cross(all(body.angular_velocity.data()), arm);
}

/// Writes the biases. Returns whether a point closes faster than the step can follow.
HWY_INLINE bool set_bias(const StepScale& scale, const ContactStart& start, const BodyMotion& a, const BodyMotion& b,
                         ContactConstraint& constraint) {
  const Four used = used_lanes(constraint.count);
  const Four step = Four::all(scale.step);
  const Triple velocity =
      velocity_at(b, Triple::load(constraint.arms.b)) - velocity_at(a, Triple::load(constraint.arms.a));
  const Triple normal = direction(constraint, 0);
  const Four along_normal = inner(normal, velocity);
  const Four gap = Four::load(start.gap.data());
  where_greater(gap, Four::all(kTouch), gap / step).store(constraint.velocity_bias.row[0].data());
  // Friction along the mean slip makes curved paths second order in the step.
  const Triple slip = velocity - along_normal * normal;
  const Four lasting = Four::all(scale.lasting_slip * scale.lasting_slip);
  for (std::size_t i = 1; i < 3; ++i) {
    const Four bias = used * inner(slip, direction(constraint, i));
    where_greater(inner(slip, slip), lasting, bias).store(constraint.velocity_bias.row[i].data());
  }
  const Four ends_at = max(gap, Four::all(0.0)) + step * along_normal;
  return total(where_greater(Four::all(-kNoticeable * scale.velocity_unit * scale.step), ends_at, used)) > 0.0;
}

HWY_INLINE void turn(const BodyMotion& body, std::array<Lanes, 3>& at_end, std::array<Lanes, 3>& at_middle) {
  const Triple arm = Triple::load(at_end);
  if (body.turns) {
    rotated(body.turn_mid, arm).store(at_middle);
    rotated(body.turn_end, arm).store(at_end);
  } else {
    arm.store(at_middle);
  }
}

HWY_ATTR void start_from_last_kernel(double step, const ContactStart* start, ContactConstraint* constraints,
                                     std::size_t count) {
  for (std::size_t p = 0; p < count; ++p) start_one(step, start[p], constraints[p]);
}

HWY_ATTR bool start_step_kernel(const StepScale& scale, const ContactStart* start, const BodyMotion* motion,
                                ContactConstraint* constraints, std::size_t count, Arms* mid_arms,
                                std::uint8_t* late_impact) {
  bool any_late = false;
  for (std::size_t p = 0; p < count; ++p) {
    ContactConstraint& constraint = constraints[p];
    const BodyMotion& a = motion[constraint.a];
    const BodyMotion& b = motion[constraint.b];
    if (set_bias(scale, start[p], a, b, constraint)) {
      late_impact[constraint.a] = late_impact[constraint.b] = 1;
      any_late = true;
    }
    start_one(scale.step, start[p], constraint);
    if (mid_arms == nullptr) continue;
    turn(a, constraint.arms.a, mid_arms[p].a);
    turn(b, constraint.arms.b, mid_arms[p].b);
  }
  return any_late;
}

HWY_ATTR void to_container_frame_kernel(double step, const ContactConstraint* constraints, std::size_t count,
                                        ContactStart* next) {
  const Four length = Four::all(step);
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    Triple f, v;
    for (std::size_t i = 0; i < 3; ++i) {
      const Triple along = direction(constraint, i);
      const Four y = Four::load(constraint.impulse.row[i].data()) / length;
      const Four z = Four::load(constraint.contact_velocity.row[i].data());
      const Four bias = i > 0 ? Four::load(constraint.velocity_bias.row[i].data()) : Four::all(0.0);
      f = i > 0 ? f + y * along : y * along;
      v = i > 0 ? v + (z - bias) * along : (z - bias) * along;
    }
    f.store(next[p].force.row);
    v.store(next[p].contact_velocity.row);
  }
}

}  // namespace
}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::internal::native {

HWY_EXPORT(start_from_last_kernel);
HWY_EXPORT(start_step_kernel);
HWY_EXPORT(to_container_frame_kernel);

void start_from_last(double step, std::span<const ContactStart> start, std::span<ContactConstraint> constraints) {
  HWY_DYNAMIC_DISPATCH(start_from_last_kernel)(step, start.data(), constraints.data(), constraints.size());
}

bool start_step(const StepScale& scale, std::span<const ContactStart> start, std::span<const BodyMotion> motion,
                std::span<ContactConstraint> constraints, std::span<Arms> mid_arms,
                std::span<std::uint8_t> late_impact) {
  return HWY_DYNAMIC_DISPATCH(start_step_kernel)(scale, start.data(), motion.data(), constraints.data(),
                                                 constraints.size(), mid_arms.empty() ? nullptr : mid_arms.data(),
                                                 late_impact.data());
}

void to_container_frame(double step, std::span<const ContactConstraint> constraints, std::span<ContactStart> next) {
  HWY_DYNAMIC_DISPATCH(to_container_frame_kernel)(step, constraints.data(), constraints.size(), next.data());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
