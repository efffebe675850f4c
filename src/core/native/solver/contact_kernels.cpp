// Arithmetic of the contacts, once for every instruction set, chosen at run time.
#include "core/native/solver/contact_kernels.hpp"

#include <algorithm>
#include <array>

#include "core/native/solver/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/native/solver/contact_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/native/solver/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE {
namespace {

/// limit / √square where that shortens, else 1.
HWY_INLINE Four shrink(const Four& limit, const Four& square) {
  Four p;
  const Four::D d;
  for (std::size_t i = 0; i < Four::kVectors; ++i) {
    const auto beyond = hn::Gt(square.part[i], hn::Mul(limit.part[i], limit.part[i]));
    // The square is positive wherever it is beyond the limit; elsewhere 1 keeps 0/0 out.
    const auto safe = hn::IfThenElse(beyond, square.part[i], hn::Set(d, 1.0));
    p.part[i] = hn::IfThenElse(beyond, hn::Div(limit.part[i], hn::Sqrt(safe)), hn::Set(d, 1.0));
  }
  return p;
}

/// Velocity of b's surface relative to a's at the points, container frame.
struct Relative {
  Four x, y, z;
};
HWY_INLINE Relative relative_velocity(const Arms& arms, const double* va, const double* vb) {
  const auto arm = [](const std::array<Lanes, 3>& from, int i)
                       HWY_ATTR { return Four::load(from[static_cast<std::size_t>(i)].data()); };
  const Four ax = arm(arms.a, 0), ay = arm(arms.a, 1), az = arm(arms.a, 2);
  const Four bx = arm(arms.b, 0), by = arm(arms.b, 1), bz = arm(arms.b, 2);
  const Four wax = Four::all(va[3]), way = Four::all(va[4]), waz = Four::all(va[5]);
  const Four wbx = Four::all(vb[3]), wby = Four::all(vb[4]), wbz = Four::all(vb[5]);
  return {Four::all(vb[0] - va[0]) + (wby * bz - wbz * by) - (way * az - waz * ay),
          Four::all(vb[1] - va[1]) + (wbz * bx - wbx * bz) - (waz * ax - wax * az),
          Four::all(vb[2] - va[2]) + (wbx * by - wby * bx) - (wax * ay - way * ax)};
}

HWY_INLINE Four along(const Relative& v, const std::array<double, 3>& direction) {
  return Four::all(direction[0]) * v.x + Four::all(direction[1]) * v.y + Four::all(direction[2]) * v.z;
}

/// Adds the wrench of the forces `f` (along the constraint's directions, on b) to b, and its opposite to a.
HWY_INLINE void add_wrench(const ContactConstraint& constraint, const Arms& arms, const Four (&f)[3],
                           LaneWrench* wrench) {
  Four force[3];
  for (std::size_t i = 0; i < 3; ++i) {
    force[i] = Four::all(constraint.directions[0][i]) * f[0] + Four::all(constraint.directions[1][i]) * f[1] +
               Four::all(constraint.directions[2][i]) * f[2];
  }
  LaneWrench& on_a = wrench[constraint.a];
  LaneWrench& on_b = wrench[constraint.b];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    (Four::load(on_a.row[i]) - force[i]).store(on_a.row[i]);
    (Four::load(on_b.row[i]) + force[i]).store(on_b.row[i]);
    const Four torque_a = Four::load(arms.a[j].data()) * force[k] - Four::load(arms.a[k].data()) * force[j];
    const Four torque_b = Four::load(arms.b[j].data()) * force[k] - Four::load(arms.b[k].data()) * force[j];
    (Four::load(on_a.row[3 + i]) - torque_a).store(on_a.row[3 + i]);
    (Four::load(on_b.row[3 + i]) + torque_b).store(on_b.row[3 + i]);
  }
}

HWY_INLINE Four load(const ConstraintVector& from, std::size_t row) { return Four::load(from.row[row].data()); }

/// The largest of the lanes.
HWY_INLINE double largest(const Four& four) {
  alignas(64) double lane[kLanes];
  four.store(lane);
  return std::max(std::max(lane[0], lane[1]), std::max(lane[2], lane[3]));
}

/// The primal residual u − z over the constraints that have been relaxed.
struct ResidualSum {
  Four worst;
  Four squares[3];

  static HWY_INLINE ResidualSum zero() { return {Four::all(0.0), {Four::all(0.0), Four::all(0.0), Four::all(0.0)}}; }
  HWY_INLINE PrimalResidual result() const { return {largest(worst), total(squares[0] + (squares[1] + squares[2]))}; }
};

HWY_ATTR void contact_velocities_kernel(const ContactConstraint* constraints, std::size_t count,
                                        const BodyVector* velocity, ConstraintVector* out) {
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const Relative v = relative_velocity(constraint.arms, velocity[constraint.a].row, velocity[constraint.b].row);
    for (std::size_t i = 0; i < 3; ++i)
      (along(v, constraint.directions[i]) + load(constraint.velocity_bias, i)).store(out[p].row[i].data());
  }
}

/// What `relax` computes for a constraint.
struct Relaxed {
  Four u[3], g[3], r[3];
};
HWY_INLINE Relaxed relax_one(const ContactConstraint& constraint, const BodyVector* velocity, const Four& alpha,
                             ResidualSum& residual) {
  const Relative v = relative_velocity(constraint.arms, velocity[constraint.a].row, velocity[constraint.b].row);
  const Four penalty[2] = {Four::load(constraint.penalty[0].data()), Four::load(constraint.penalty[1].data())};
  const Four inverse_penalty[2] = {Four::load(constraint.inverse_penalty[0].data()),
                                   Four::load(constraint.inverse_penalty[1].data())};
  Relaxed out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.u[i] = along(v, constraint.directions[i]) + load(constraint.velocity_bias, i);
    const Four z = load(constraint.contact_velocity, i);
    const Four primal_residual = out.u[i] - z;
    out.r[i] = Four::all(0.0) - alpha * (penalty[i > 0] * primal_residual);
    out.g[i] = load(constraint.impulse, i) - penalty[i > 0] * z + out.r[i];
    // A lane without a point has no velocity to compare with.
    const Four counted = primal_residual * (inverse_penalty[i > 0] * penalty[i > 0]);
    residual.worst = max(residual.worst, counted.abs());
    residual.squares[i] = residual.squares[i] + counted * counted;
  }
  return out;
}

/// What `project` does with a constraint.
HWY_INLINE void project_one(Projection projection, ContactConstraint& constraint, const Arms& arms, const Four (&x)[3],
                            const Four (&u)[3], const NormalBounds* most, LaneWrench* wrench) {
  const Four friction = Four::all(constraint.friction);
  const Four square = x[1] * x[1] + x[2] * x[2];
  Four normal = max(x[0], Four::all(0.0));
  if (projection == Projection::orthogonal) {
    // Where x is outside the disc of radius μ x_n, the nearest point of the cone has this normal part, the larger
    // one.
    const Four raise = Four::all(1.0 / (1.0 + constraint.friction * constraint.friction));
    normal = max(normal, raise * (x[0] + friction * square.sqrt()));
    if (most != nullptr) normal = min(normal, Four::load(most->lane.data()));
  }
  const Four share = shrink(friction * normal, square);
  const Four y[3] = {normal, x[1] * share, x[2] * share};
  Four f[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Four z = (y[i] - x[i]) * Four::load(constraint.inverse_penalty[i > 0].data());
    y[i].store(constraint.impulse.row[i].data());
    z.store(constraint.contact_velocity.row[i].data());
    f[i] = y[i] + Four::load(constraint.penalty[i > 0].data()) * (z - u[i]);
  }
  add_wrench(constraint, arms, f, wrench);
}

HWY_ATTR PrimalResidual relax_kernel(const ContactConstraint* constraints, std::size_t count,
                                     const BodyVector* velocity, double relaxation, ConstraintVector* out_u,
                                     ConstraintVector* out_g, ConstraintVector* out_r) {
  const Four alpha = Four::all(relaxation);
  ResidualSum residual = ResidualSum::zero();
  for (std::size_t p = 0; p < count; ++p) {
    const Relaxed relaxed = relax_one(constraints[p], velocity, alpha, residual);
    for (std::size_t i = 0; i < 3; ++i) {
      relaxed.u[i].store(out_u[p].row[i].data());
      relaxed.g[i].store(out_g[p].row[i].data());
      relaxed.r[i].store(out_r[p].row[i].data());
    }
  }
  return residual.result();
}

HWY_ATTR void project_kernel(Projection projection, ContactConstraint* constraints, const Arms* mid_arms,
                             std::size_t count, const ConstraintVector* in_x, const ConstraintVector* in_u,
                             const NormalBounds* most, LaneWrench* wrench) {
  for (std::size_t p = 0; p < count; ++p) {
    const Four x[3] = {load(in_x[p], 0), load(in_x[p], 1), load(in_x[p], 2)};
    const Four u[3] = {load(in_u[p], 0), load(in_u[p], 1), load(in_u[p], 2)};
    project_one(projection, constraints[p], mid_arms == nullptr ? constraints[p].arms : mid_arms[p], x, u,
                most == nullptr ? nullptr : most + p, wrench);
  }
}

HWY_ATTR PrimalResidual relax_and_project_kernel(Projection projection, ContactConstraint* constraints,
                                                 const Arms* mid_arms, std::size_t count, const BodyVector* velocity,
                                                 double relaxation, const NormalBounds* most, LaneWrench* wrench) {
  const Four alpha = Four::all(relaxation);
  ResidualSum residual = ResidualSum::zero();
  for (std::size_t p = 0; p < count; ++p) {
    const Relaxed relaxed = relax_one(constraints[p], velocity, alpha, residual);
    project_one(projection, constraints[p], mid_arms == nullptr ? constraints[p].arms : mid_arms[p], relaxed.g,
                relaxed.u, most == nullptr ? nullptr : most + p, wrench);
  }
  return residual.result();
}

/// `kMany` inner products in one pass.
template <std::size_t kMany>
HWY_INLINE void dot_all(const ContactConstraint* constraints, std::size_t count, const ConstraintVector* a,
                        const ConstraintVector* const* b, double* out) {
  Four sum[kMany][3];
  for (Four(&of_one)[3] : sum)
    for (Four& row : of_one) row = Four::all(0.0);
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Four x = load(a[p], i);
      const Four inverse_penalty = Four::load(constraints[p].inverse_penalty[i > 0].data());
      for (std::size_t k = 0; k < kMany; ++k) sum[k][i] = sum[k][i] + x * load(b[k][p], i) * inverse_penalty;
    }
  }
  for (std::size_t k = 0; k < kMany; ++k) out[k] = total(sum[k][0] + (sum[k][1] + sum[k][2]));
}

HWY_ATTR void dot_kernel(const ContactConstraint* constraints, std::size_t count, const ConstraintVector* a,
                         const ConstraintVector* const* b, std::size_t many, double* out) {
  // Five is what the accelerated iteration asks for; more would not fit into the registers of most instruction sets.
  for (; many >= 5; many -= 5, b += 5, out += 5) dot_all<5>(constraints, count, a, b, out);
  if (many == 4) dot_all<4>(constraints, count, a, b, out);
  if (many == 3) dot_all<3>(constraints, count, a, b, out);
  if (many == 2) dot_all<2>(constraints, count, a, b, out);
  if (many == 1) dot_all<1>(constraints, count, a, b, out);
}

HWY_ATTR void take_difference_kernel(std::size_t count, const ConstraintVector* now, ConstraintVector* last,
                                     ConstraintVector* step) {
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Four x = load(now[p], i);
      (x - load(last[p], i)).store(step[p].row[i].data());
      x.store(last[p].row[i].data());
    }
  }
}

HWY_ATTR void subtract_kernel(std::size_t count, const std::vector<ConstraintVector>* history, const double* weight,
                              std::size_t depth, ConstraintVector* x) {
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      Four sum = load(x[p], i);
      for (std::size_t k = 0; k < depth; ++k) sum = sum - Four::all(weight[k]) * load(history[k].data()[p], i);
      sum.store(x[p].row[i].data());
    }
  }
}

HWY_ATTR void add_impulses_kernel(const ContactConstraint* constraints, const Arms* mid_arms, std::size_t count,
                                  LaneWrench* wrench) {
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const Four y[3] = {load(constraint.impulse, 0), load(constraint.impulse, 1), load(constraint.impulse, 2)};
    add_wrench(constraint, mid_arms == nullptr ? constraint.arms : mid_arms[p], y, wrench);
  }
}

HWY_ATTR double supported_power_kernel(const ContactConstraint* constraints, std::size_t count,
                                       const BodyVector* velocity, double largest_impulse, const NormalBounds* most) {
  const Four zero = Four::all(0.0);
  const Four largest_of_all = Four::all(largest_impulse);
  Four sum = zero;
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const Relative v = relative_velocity(constraint.arms, velocity[constraint.a].row, velocity[constraint.b].row);
    Four u[3];
    for (std::size_t i = 0; i < 3; ++i) u[i] = along(v, constraint.directions[i]) + load(constraint.velocity_bias, i);
    const Four slip = (u[1] * u[1] + u[2] * u[2]).sqrt();
    const Four bound = most == nullptr ? largest_of_all : min(largest_of_all, Four::load(most[p].lane.data()));
    const Four taken = bound * max(zero, Four::all(constraint.friction) * slip - u[0]);
    sum = sum + used_lanes(constraint.count) * taken;
  }
  return total(sum);
}

}  // namespace
}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::internal::native {

HWY_EXPORT(contact_velocities_kernel);
HWY_EXPORT(relax_kernel);
HWY_EXPORT(project_kernel);
HWY_EXPORT(relax_and_project_kernel);
HWY_EXPORT(dot_kernel);
HWY_EXPORT(take_difference_kernel);
HWY_EXPORT(subtract_kernel);
HWY_EXPORT(add_impulses_kernel);
HWY_EXPORT(supported_power_kernel);

void find_contact_velocities(std::span<const ContactConstraint> constraints, std::span<const BodyVector> velocity,
                             std::span<ConstraintVector> u) {
  HWY_DYNAMIC_DISPATCH(contact_velocities_kernel)(constraints.data(), constraints.size(), velocity.data(), u.data());
}

PrimalResidual relax(std::span<const ContactConstraint> constraints, std::span<const BodyVector> velocity,
                     double relaxation, std::span<ConstraintVector> u, std::span<ConstraintVector> g,
                     std::span<ConstraintVector> r) {
  return HWY_DYNAMIC_DISPATCH(relax_kernel)(constraints.data(), constraints.size(), velocity.data(), relaxation,
                                            u.data(), g.data(), r.data());
}

void project(Projection projection, std::span<ContactConstraint> constraints, std::span<const Arms> mid_arms,
             std::span<const ConstraintVector> x, std::span<const ConstraintVector> u,
             std::span<const NormalBounds> most, std::span<LaneWrench> wrench) {
  HWY_DYNAMIC_DISPATCH(project_kernel)
  (projection, constraints.data(), arms_or_null(mid_arms), constraints.size(), x.data(), u.data(),
   most.empty() ? nullptr : most.data(), wrench.data());
}

PrimalResidual relax_and_project(Projection projection, std::span<ContactConstraint> constraints,
                                 std::span<const Arms> mid_arms, std::span<const BodyVector> velocity,
                                 double relaxation, std::span<const NormalBounds> most, std::span<LaneWrench> wrench) {
  return HWY_DYNAMIC_DISPATCH(relax_and_project_kernel)(projection, constraints.data(), arms_or_null(mid_arms),
                                                        constraints.size(), velocity.data(), relaxation,
                                                        most.empty() ? nullptr : most.data(), wrench.data());
}

void dot(std::span<const ContactConstraint> constraints, std::span<const ConstraintVector> a,
         std::span<const ConstraintVector* const> b, std::span<double> out) {
  HWY_DYNAMIC_DISPATCH(dot_kernel)(constraints.data(), constraints.size(), a.data(), b.data(), b.size(), out.data());
}

void take_difference(std::span<const ConstraintVector> now, std::span<ConstraintVector> last,
                     std::span<ConstraintVector> step) {
  HWY_DYNAMIC_DISPATCH(take_difference_kernel)(now.size(), now.data(), last.data(), step.data());
}

void subtract(std::span<const std::vector<ConstraintVector>> history, std::span<const double> weight,
              std::span<ConstraintVector> x) {
  HWY_DYNAMIC_DISPATCH(subtract_kernel)(x.size(), history.data(), weight.data(), weight.size(), x.data());
}

void add_impulses(std::span<const ContactConstraint> constraints, std::span<const Arms> mid_arms,
                  std::span<LaneWrench> wrench) {
  HWY_DYNAMIC_DISPATCH(add_impulses_kernel)
  (constraints.data(), arms_or_null(mid_arms), constraints.size(), wrench.data());
}

double supported_power(std::span<const ContactConstraint> constraints, std::span<const BodyVector> velocity,
                       double largest, std::span<const NormalBounds> most) {
  return HWY_DYNAMIC_DISPATCH(supported_power_kernel)(constraints.data(), constraints.size(), velocity.data(), largest,
                                                      most.empty() ? nullptr : most.data());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
