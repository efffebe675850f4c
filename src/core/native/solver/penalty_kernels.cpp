// Arithmetic of the penalty, once for every instruction set, chosen at run time.
#include "core/native/solver/penalty_kernels.hpp"

#include "core/native/constants.hpp"
#include "core/native/solver/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/native/solver/penalty_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/native/solver/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE {
namespace {

/// The ratio rounded up to a power of 4, at least 1.
HWY_INLINE Four round_up_to_power_of_4(const Four& ratio) {
  const Four::D d;
  const hn::RebindToUnsigned<Four::D> bits;
  const auto bias = hn::Set(bits, 1023);
  const auto one = hn::Set(bits, 1);
  Four power;
  for (std::size_t i = 0; i < Four::kVectors; ++i) {
    // The exponent of the number just below the ratio: a power of 4 itself stays.
    const auto below = hn::Sub(hn::BitCast(bits, ratio.part[i]), one);
    const auto exponent = hn::Sub(hn::ShiftRight<52>(below), bias);
    const auto even = hn::ShiftLeft<1>(hn::Add(hn::ShiftRight<1>(exponent), one));
    const auto rounded = hn::BitCast(d, hn::ShiftLeft<52>(hn::Add(even, bias)));
    const auto least = hn::Set(d, 1.0);
    power.part[i] = hn::IfThenElse(hn::Gt(ratio.part[i], least), rounded, least);
  }
  return power;
}

/// R of a constraint's points, kg; 0 in the lanes that hold none.
struct Penalty {
  Four normal, tangential;
};

HWY_INLINE Penalty wanted_penalty(const PenaltyFit& fit, const ContactConstraint& constraint) {
  const double mass = constraint.effective_mass;
  // Without friction nothing holds along the tangents: R would, until the solve has come to its end.
  const double held = constraint.friction > 0.0 ? 1.0 : 0.0;
  const Four zero = Four::all(0.0);
  const Four normal = Four::load(constraint.impulse.row[0].data());
  const Four expected = Four::load(constraint.expected_impulse.data());
  const Four first = Four::load(constraint.impulse.row[1].data());
  const Four second = Four::load(constraint.impulse.row[2].data());
  const Four ratio = max(normal, expected) / Four::all(mass * fit.impulse_per_mass);
  const Four carried = Four::all(mass) * round_up_to_power_of_4(min(Four::all(fit.heaviest / mass), ratio));
  const Four square = first * first + second * second;
  const Four limit = Four::all(kSlidingShare * constraint.friction) * normal;
  const Four limit_square = limit * limit;
  const Four used = used_lanes(constraint.count);
  const double idle = fit.idle * mass;
  Penalty wanted;
  for (std::size_t i = 0; i < Four::kVectors; ++i) {
    const Four::D d;
    const auto carries = hn::Gt(normal.part[i], zero.part[i]);
    const auto may_carry = fit.continues ? carries : hn::Or(carries, hn::Gt(expected.part[i], zero.part[i]));
    const auto slides = hn::And(carries, hn::Ge(square.part[i], limit_square.part[i]));
    const auto tangential = hn::IfThenElse(slides, hn::Set(d, held * fit.sliding), hn::Set(d, held * fit.sticking));
    const auto across =
        hn::IfThenElse(may_carry, hn::Mul(tangential, carried.part[i]), hn::Set(d, held * fit.sliding * idle));
    const auto along =
        hn::IfThenElse(may_carry, hn::Mul(hn::Set(d, fit.sticking), carried.part[i]), hn::Set(d, fit.sticking * idle));
    wanted.normal.part[i] = hn::Mul(used.part[i], along);
    wanted.tangential.part[i] = hn::Mul(used.part[i], across);
  }
  return wanted;
}

/// 1/R, and 0 where R is 0.
HWY_INLINE Four inverse(const Four& penalty) {
  return Four::map(penalty, Four::all(1.0), [](auto r, auto one) HWY_ATTR {
    const auto positive = hn::Gt(r, hn::Zero(Four::D()));
    return hn::IfThenElseZero(positive, hn::Div(one, hn::IfThenElse(positive, r, one)));
  });
}

HWY_ATTR double count_misfits_kernel(const PenaltyFit& fit, const ContactConstraint* constraints, std::size_t count) {
  Four misfits = Four::all(0.0);
  for (std::size_t p = 0; p < count; ++p) {
    const Penalty wanted = wanted_penalty(fit, constraints[p]);
    const Four normal = Four::load(constraints[p].penalty[0].data());
    const Four tangential = Four::load(constraints[p].penalty[1].data());
    for (std::size_t i = 0; i < Four::kVectors; ++i) {
      const auto fits =
          hn::And(hn::Eq(wanted.normal.part[i], normal.part[i]), hn::Eq(wanted.tangential.part[i], tangential.part[i]));
      misfits.part[i] = hn::Add(misfits.part[i], hn::IfThenZeroElse(fits, hn::Set(Four::D(), 1.0)));
    }
  }
  return total(misfits);
}

HWY_ATTR void fit_penalty_kernel(const PenaltyFit& fit, ContactConstraint* constraints, std::size_t count) {
  for (std::size_t p = 0; p < count; ++p) {
    ContactConstraint& constraint = constraints[p];
    const Penalty wanted = wanted_penalty(fit, constraint);
    wanted.normal.store(constraint.penalty[0].data());
    wanted.tangential.store(constraint.penalty[1].data());
    inverse(wanted.normal).store(constraint.inverse_penalty[0].data());
    inverse(wanted.tangential).store(constraint.inverse_penalty[1].data());
  }
}

}  // namespace
}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::internal::native {

HWY_EXPORT(count_misfits_kernel);
HWY_EXPORT(fit_penalty_kernel);

double count_misfits(const PenaltyFit& fit, std::span<const ContactConstraint> constraints) {
  return HWY_DYNAMIC_DISPATCH(count_misfits_kernel)(fit, constraints.data(), constraints.size());
}

void fit_penalty(const PenaltyFit& fit, std::span<ContactConstraint> constraints) {
  HWY_DYNAMIC_DISPATCH(fit_penalty_kernel)(fit, constraints.data(), constraints.size());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
