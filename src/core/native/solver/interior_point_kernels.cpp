// Arithmetic of the interior point method, once for every instruction set, chosen at run time.
#include "core/native/solver/interior_point_kernels.hpp"

#include <limits>

#include "core/native/solver/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/native/solver/interior_point_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/native/solver/lorentz_cone-inl.hpp"
#include "core/native/solver/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE {
namespace {

HWY_INLINE Four load(const Lanes& lanes) { return Four::load(lanes.data()); }
HWY_INLINE Triple load(const ConstraintVector& vector) { return Triple::load(vector.row); }

HWY_INLINE Triple componentwise(const Triple& a, const Triple& b) {
  return {{a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2]}};
}

/// The smaller of two steps in each lane; not a number where one of them is none.
HWY_INLINE Four shorter(const Four& a, const Four& b) {
  return Four::map(a, b,
                   [](auto x, auto y) HWY_ATTR { return hn::IfThenElse(hn::Or(hn::Le(x, y), hn::IsNaN(x)), x, y); });
}

/// The largest α with x + α d ≥ 0.
HWY_INLINE Four longest_step(const Four& x, const Four& d) {
  return Four::map(x, d, [](auto from, auto change) HWY_ATTR {
    const auto zero = hn::Zero(Four::D());
    const auto infinity = hn::Set(Four::D(), std::numeric_limits<double>::infinity());
    return hn::IfThenElse(hn::Ge(change, zero), infinity, hn::Div(hn::Sub(zero, from), change));
  });
}

/// The variables of a constraint's points, and what leads from Lorentz coordinates to those of the constraint.
struct Variables {
  Triple y, s;
  Four p, l;
  Four friction, takes_part, is_bounded, bound;
  Triple d;  ///< the diagonal of D

  static HWY_INLINE Variables of(const InteriorPoints& points) {
    const Four tangential = load(points.has_friction);
    const Four normal = load(points.takes_part) * Four::all(points.inverse_friction);
    return {load(points.y),
            load(points.s),
            load(points.p),
            load(points.l),
            Four::all(points.friction),
            load(points.takes_part),
            load(points.is_bounded),
            load(points.bound),
            {{normal, tangential, tangential}}};
  }

  HWY_INLINE Triple impulse() const { return componentwise(d, y); }
  HWY_INLINE Triple velocity() const { return {{friction * s.at[0], s.at[1], s.at[2]}}; }
  /// r_p of p + y_n = bound.
  HWY_INLINE Four bound_residual() const { return is_bounded * (p - bound + d.at[0] * y.at[0]); }
  /// c_λ, the right-hand side of the Newton equation of p λ.
  HWY_INLINE Four bound_change(const InteriorTarget& target, const InteriorPoints& points) const {
    const Four change = is_bounded * Four::all(target.complementarity) - p * l;
    return target.corrects ? change - load(points.dp) * load(points.dl) : change;
  }
};

HWY_INLINE lorentz::Scaling scaling_of(const InteriorPoints& points) {
  return {load(points.scaling_square), load(points.scaling)};
}

HWY_INLINE Triple multiply(const ConstraintMatrix& matrix, const Triple& x) {
  Triple product;
  for (std::size_t i = 0; i < 3; ++i) product.at[i] = dot(Triple::load(matrix.entry[i]), x);
  return product;
}

/// Adds k e eᵀ, e the first unit vector, to the matrix whose inverse this is: by Sherman and Morrison, each minor of
/// W⁻² without a difference of large numbers, since R W⁻² may be larger than R by all digits.
HWY_INLINE void stiffen(const Four& k, const lorentz::Scaling& scaling, Four (&inverse)[3][3]) {
  const Four one = Four::all(1.0);
  const Triple& w = scaling.w;
  const Four over_square = one / scaling.square;
  const Four minor = k * over_square * over_square;
  const Four twice = Four::all(2.0) * minor;
  const Four shrink = one / (one + k * inverse[0][0]);
  inverse[1][1] = inverse[1][1] + (minor + twice * w.at[2] * w.at[2]);
  inverse[2][2] = inverse[2][2] + (minor + twice * w.at[1] * w.at[1]);
  inverse[1][2] = inverse[2][1] = inverse[1][2] - twice * w.at[1] * w.at[2];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) inverse[i][j] = inverse[j][i] = shrink * inverse[i][j];
}

HWY_ATTR double scale_kernel(InteriorPoints* all_points, std::size_t count, ConstraintMatrix* resistance) {
  Four sum = Four::all(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    InteriorPoints& points = all_points[i];
    const Variables now = Variables::of(points);
    sum = sum + (now.takes_part * dot(now.y, now.s) + now.p * now.l);
    const lorentz::Scaling scaling = lorentz::Scaling::of(now.y, now.s);
    scaling.square.store(points.scaling_square.data());
    scaling.w.store(points.scaling.row);
    Four inverse[3][3];
    scaling.inverse_square(inverse);
    const Four over_friction = Four::all(points.inverse_friction);
    stiffen(now.l / now.p * over_friction * over_friction, scaling, inverse);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        (now.d.at[r] * now.d.at[c] * inverse[r][c]).store(resistance[i].entry[r][c].data());
  }
  return total(sum);
}

HWY_ATTR void find_drive_kernel(const InteriorTarget& target, InteriorPoints* all_points, std::size_t count,
                                const ConstraintMatrix* resistance, const ConstraintVector* u,
                                ContactConstraint* constraints) {
  const Four zero = Four::all(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    InteriorPoints& points = all_points[i];
    const Variables now = Variables::of(points);
    const lorentz::Scaling scaling = scaling_of(points);
    const Triple middle = scaling.scaled(now.y);
    Triple c =
        Triple{{Four::all(target.complementarity), zero, zero}} - scaling.square * lorentz::product(middle, middle);
    if (target.corrects) c = c - lorentz::product(scaling.scaled(load(points.dy)), scaling.unscaled(load(points.ds)));
    Triple centred = scaling.scaled(lorentz::quotient(c, middle));
    centred.at[0] = now.friction * centred.at[0];
    Triple drive = centred + now.velocity() - load(u[i]);
    const Four bound_change = now.bound_change(target, points);
    drive.at[0] = drive.at[0] - (now.l + (bound_change + now.l * now.bound_residual()) / now.p);
    drive.store(points.drive.row);
    (now.impulse() + multiply(resistance[i], drive)).store(constraints[i].impulse.row);
  }
}

HWY_ATTR double find_changes_kernel(const InteriorTarget& target, InteriorPoints* all_points, std::size_t count,
                                    const ConstraintMatrix* resistance, const ConstraintVector* u,
                                    const ConstraintVector* du) {
  Four longest = Four::all(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; ++i) {
    InteriorPoints& points = all_points[i];
    const Variables now = Variables::of(points);
    const Triple change = load(du[i]);
    const Triple impulse = multiply(resistance[i], load(points.drive) - change);
    Triple velocity = change + load(u[i]) - now.velocity();
    const Four bound_change = now.bound_change(target, points);
    const Four dp = Four::all(0.0) - (now.is_bounded * impulse.at[0] + now.bound_residual());
    const Four dl = (bound_change - now.l * dp) / now.p;
    velocity.at[0] = velocity.at[0] + (now.l + dl);
    const Triple dy = {{now.friction * impulse.at[0], impulse.at[1], impulse.at[2]}};
    const Triple ds = componentwise(now.d, velocity);
    dp.store(points.dp.data());
    dl.store(points.dl.data());
    dy.store(points.dy.row);
    ds.store(points.ds.row);
    longest = shorter(longest, shorter(longest_step(now.p, dp), longest_step(now.l, dl)));
    longest = shorter(longest, shorter(lorentz::longest_step(now.y, dy), lorentz::longest_step(now.s, ds)));
  }
  alignas(64) double lane[kLanes];
  longest.store(lane);
  return native::shorter(native::shorter(lane[0], lane[1]), native::shorter(lane[2], lane[3]));
}

HWY_ATTR void take_step_kernel(double step, InteriorPoints* all_points, std::size_t count) {
  const Four share = Four::all(step);
  for (std::size_t i = 0; i < count; ++i) {
    InteriorPoints& points = all_points[i];
    (load(points.y) + share * load(points.dy)).store(points.y.row);
    (load(points.s) + share * load(points.ds)).store(points.s.row);
    (load(points.p) + share * load(points.dp)).store(points.p.data());
    (load(points.l) + share * load(points.dl)).store(points.l.data());
  }
}

HWY_ATTR void write_back_kernel(const InteriorPoints* points, std::size_t count, ContactConstraint* constraints) {
  for (std::size_t i = 0; i < count; ++i) {
    const Variables now = Variables::of(points[i]);
    now.impulse().store(constraints[i].impulse.row);
    (now.takes_part * now.velocity()).store(constraints[i].contact_velocity.row);
  }
}

}  // namespace
}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::internal::native {

HWY_EXPORT(scale_kernel);
HWY_EXPORT(find_drive_kernel);
HWY_EXPORT(find_changes_kernel);
HWY_EXPORT(take_step_kernel);
HWY_EXPORT(write_back_kernel);

double scale(std::span<InteriorPoints> points, std::span<ConstraintMatrix> resistance) {
  return HWY_DYNAMIC_DISPATCH(scale_kernel)(points.data(), points.size(), resistance.data());
}

void find_drive(const InteriorTarget& target, std::span<InteriorPoints> points,
                std::span<const ConstraintMatrix> resistance, std::span<const ConstraintVector> u,
                std::span<ContactConstraint> constraints) {
  HWY_DYNAMIC_DISPATCH(find_drive_kernel)
  (target, points.data(), points.size(), resistance.data(), u.data(), constraints.data());
}

double find_changes(const InteriorTarget& target, std::span<InteriorPoints> points,
                    std::span<const ConstraintMatrix> resistance, std::span<const ConstraintVector> u,
                    std::span<const ConstraintVector> du) {
  return HWY_DYNAMIC_DISPATCH(find_changes_kernel)(target, points.data(), points.size(), resistance.data(), u.data(),
                                                   du.data());
}

void take_step(double step, std::span<InteriorPoints> points) {
  HWY_DYNAMIC_DISPATCH(take_step_kernel)(step, points.data(), points.size());
}

void write_back(std::span<const InteriorPoints> points, std::span<ContactConstraint> constraints) {
  HWY_DYNAMIC_DISPATCH(write_back_kernel)(points.data(), points.size(), constraints.data());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
