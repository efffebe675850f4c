// Arithmetic of the bodies, once for every instruction set, chosen at run time.
#include "core/native/solver/body_kernels.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/solver/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/native/solver/body_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/native/solver/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE {
namespace {

/// Three numbers, of which a fourth follows that may be read, and a zero.
HWY_INLINE Four load_three(const double* from) {
  Four four;
  for (std::size_t i = 0; i < Four::kVectors; ++i) {
    const std::size_t first = i * Four::kWidth;
    four.part[i] = hn::IfThenElseZero(hn::FirstN(Four::D(), 3 - first), hn::LoadU(Four::D(), from + first));
  }
  return four;
}

/// The sums over the lanes of three rows, and a zero.
HWY_INLINE Four totals_of(const double (*rows)[kLanes]) {
  return totals(Four::load(rows[0]), Four::load(rows[1]), Four::load(rows[2]), Four::all(0.0));
}

HWY_ATTR void momentum_residual_kernel(const ProblemBody* bodies, std::size_t count, const BodyVector* free_velocity,
                                       const BodyVector* velocity, const LaneWrench* wrench, BodyVector* out) {
  static constexpr BodyVector kRest;
  for (std::size_t i = 0; i < count; ++i) {
    const double* const v = velocity == nullptr ? kRest.row : velocity[i].row;
    const double* const free = free_velocity[i].row;
    const Four pushing = Four::all(bodies[i].mass) * (Four::load(free) - Four::load(v));
    (pushing + totals_of(wrench[i].row)).store(out[i].row);
    // The radius follows the last column.
    const double* const inertia = bodies[i].inertia.data();
    const auto column = [&](int k) HWY_ATTR {
      return load_three(inertia + 3 * k) * Four::all(free[kAngularRow + k] - v[kAngularRow + k]);
    };
    const Four turning = column(0) + (column(1) + column(2));
    (turning + totals_of(wrench[i].row + 3)).store(out[i].row + kAngularRow);
  }
}

/// The larger one; what is not a number stays.
HWY_INLINE double larger(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

HWY_ATTR double add_velocity_changes_kernel(const ProblemBody* bodies, std::size_t count, const BodyVector* change,
                                            BodyVector* velocity) {
  for (std::size_t i = 0; i < count; ++i)
    (Eight::load(velocity[i].row) + Eight::load(change[i].row)).store(velocity[i].row);
  Four largest = Four::all(0.0);
  for (std::size_t first = 0; first < count; first += kLanes) {
    // The last body several times, where they are no more.
    const auto body = [=](std::size_t lane) HWY_ATTR { return std::min(first + lane, count - 1); };
    const auto lengths = [&](std::size_t row) HWY_ATTR {
      const auto squares = [&](std::size_t lane) HWY_ATTR {
        const Four components = Four::load(change[body(lane)].row + row);
        return components * components;
      };
      return totals(squares(0), squares(1), squares(2), squares(3)).sqrt();
    };
    alignas(64) const double radius[kLanes] = {bodies[body(0)].radius, bodies[body(1)].radius, bodies[body(2)].radius,
                                               bodies[body(3)].radius};
    const Four speed = lengths(0) + Four::load(radius) * lengths(kAngularRow);
    largest = Four::map(largest, speed, [](auto most, auto now) HWY_ATTR {
      return hn::IfThenElse(hn::Or(hn::Lt(most, now), hn::IsNaN(now)), now, most);
    });
  }
  alignas(64) double lane[kLanes];
  largest.store(lane);
  return larger(larger(lane[0], lane[1]), larger(lane[2], lane[3]));
}

}  // namespace
}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::internal::native {

HWY_EXPORT(momentum_residual_kernel);
HWY_EXPORT(add_velocity_changes_kernel);

void momentum_residual(std::span<const ProblemBody> bodies, std::span<const BodyVector> free_velocity,
                       const BodyVector* velocity, std::span<const LaneWrench> wrench, std::span<BodyVector> out) {
  HWY_DYNAMIC_DISPATCH(momentum_residual_kernel)
  (bodies.data(), bodies.size(), free_velocity.data(), velocity, wrench.data(), out.data());
}

double add_velocity_changes(std::span<const ProblemBody> bodies, std::span<const BodyVector> change,
                            std::span<BodyVector> velocity) {
  return HWY_DYNAMIC_DISPATCH(add_velocity_changes_kernel)(bodies.data(), bodies.size(), change.data(),
                                                           velocity.data());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
