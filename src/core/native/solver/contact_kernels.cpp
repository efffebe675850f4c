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

/// Constraints that go through an iteration together. One alone waits for the results of its square root and division
/// for most of the time: two take 0.7 of the time on a Zen 4 core, with AVX-512 and with AVX2; three or four take no
/// less. Where the lanes of one take two vectors, registers do not suffice for more.
constexpr std::size_t kTogether = Four::kVectors == 1 ? 2 : 1;

/// Constraints in a row, whose lanes are worked on together.
template <std::size_t kCount>
struct Together {
  using P = Pack<kLanes, kCount>;
  using Vector = TripleOf<P>;
  static constexpr std::size_t kConstraints = kCount;

  /// Of each item a number for each of its points.
  /// @param field `const Lanes&(const Item&)`
  template <class Item, class Field>
  static HWY_INLINE P lanes(const Item* items, Field field) {
    return P::load_each([&](std::size_t n) HWY_ATTR { return field(items[n]).data(); });
  }
  static HWY_INLINE P row(const ConstraintVector* items, std::size_t i) {
    return lanes(items, [i](const ConstraintVector& item) HWY_ATTR -> const Lanes& { return item.row[i]; });
  }
  static HWY_INLINE Vector load(const ConstraintVector* items) {
    return {{row(items, 0), row(items, 1), row(items, 2)}};
  }
  static HWY_INLINE P row(const ContactConstraint* items, ConstraintVector ContactConstraint::*member, std::size_t i) {
    return lanes(items, [=](const ContactConstraint& item) HWY_ATTR -> const Lanes& { return (item.*member).row[i]; });
  }
  static HWY_INLINE P penalty(const ContactConstraint* items, std::size_t i) {
    return lanes(items, [i](const ContactConstraint& item) HWY_ATTR -> const Lanes& { return item.penalty[i > 0]; });
  }
  static HWY_INLINE P inverse_penalty(const ContactConstraint* items, std::size_t i) {
    return lanes(items,
                 [i](const ContactConstraint& item) HWY_ATTR -> const Lanes& { return item.inverse_penalty[i > 0]; });
  }
  /// @param arms_of `const Arms&(std::size_t constraint)`
  template <class ArmsOf>
  static HWY_INLINE Vector arms(ArmsOf arms_of, std::array<Lanes, 3> Arms::*side) {
    const auto component = [&](std::size_t i) HWY_ATTR {
      return P::load_each([&](std::size_t n) HWY_ATTR { return (arms_of(n).*side)[i].data(); });
    };
    return {{component(0), component(1), component(2)}};
  }

  static HWY_INLINE P friction(const ContactConstraint* items) {
    return P::each([items](std::size_t n) HWY_ATTR { return items[n].friction; });
  }
  /// Component k of direction i.
  static HWY_INLINE P direction(const ContactConstraint* items, std::size_t i, std::size_t k) {
    return P::each([=](std::size_t n) HWY_ATTR { return items[n].directions[i][k]; });
  }
  static HWY_INLINE Vector angular_velocity(const ContactConstraint* items, std::int32_t ContactConstraint::*body,
                                            const BodyVector* velocity) {
    const auto component = [=](std::size_t i) HWY_ATTR {
      return P::each([=](std::size_t n) HWY_ATTR { return velocity[items[n].*body].row[kAngularRow + i]; });
    };
    return {{component(0), component(1), component(2)}};
  }
};

/// Calls `visit(Together, first)` for all constraints, as many together as there are.
template <class Visit>
HWY_INLINE void for_all(std::size_t count, Visit visit) {
  std::size_t first = 0;
  for (; first + kTogether <= count; first += kTogether) visit(Together<kTogether>(), first);
  for (; first < count; ++first) visit(Together<1>(), first);
}

/// limit / √square where that shortens, else 1.
template <class P>
HWY_INLINE P shrink(const P& limit, const P& square) {
  P p;
  const typename P::D d;
  for (std::size_t i = 0; i < P::kVectors; ++i) {
    const auto beyond = hn::Gt(square.part[i], hn::Mul(limit.part[i], limit.part[i]));
    // The square is positive wherever it is beyond the limit; elsewhere 1 keeps 0/0 out.
    const auto safe = hn::IfThenElse(beyond, square.part[i], hn::Set(d, 1.0));
    p.part[i] = hn::IfThenElse(beyond, hn::Div(limit.part[i], hn::Sqrt(safe)), hn::Set(d, 1.0));
  }
  return p;
}

/// Velocity of b's surface relative to a's at the points, container frame.
template <class T>
HWY_INLINE typename T::Vector relative_velocity(const ContactConstraint* constraints, const BodyVector* velocity) {
  using P = typename T::P;
  const auto arms_of = [=](std::size_t n) HWY_ATTR -> const Arms& { return constraints[n].arms; };
  const auto linear = [=](std::size_t i) HWY_ATTR {
    return P::each([=](std::size_t n)
                       HWY_ATTR { return velocity[constraints[n].b].row[i] - velocity[constraints[n].a].row[i]; });
  };
  return typename T::Vector{{linear(0), linear(1), linear(2)}} +
         cross(T::angular_velocity(constraints, &ContactConstraint::b, velocity), T::arms(arms_of, &Arms::b)) -
         cross(T::angular_velocity(constraints, &ContactConstraint::a, velocity), T::arms(arms_of, &Arms::a));
}

/// u = J v + velocity_bias, along the directions.
template <class T>
HWY_INLINE typename T::Vector contact_velocity(const ContactConstraint* constraints, const BodyVector* velocity) {
  const typename T::Vector v = relative_velocity<T>(constraints, velocity);
  typename T::Vector u;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto direction = [=](std::size_t k) HWY_ATTR { return T::direction(constraints, i, k); };
    u.at[i] = dot(typename T::Vector{{direction(0), direction(1), direction(2)}}, v) +
              T::row(constraints, &ContactConstraint::velocity_bias, i);
  }
  return u;
}

/// Adds the wrenches of the forces `f` (along the constraints' directions, on b) to b, and their opposites to a.
/// @param mid_arms arms of the constraints; null: those of their own
template <class T>
HWY_INLINE void add_wrench(const ContactConstraint* constraints, const Arms* mid_arms, const typename T::Vector& f,
                           LaneWrench* wrench) {
  using Vector = typename T::Vector;
  Vector force;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto direction = [=](std::size_t i) HWY_ATTR { return T::direction(constraints, i, k); };
    force.at[k] = dot(Vector{{direction(0), direction(1), direction(2)}}, f);
  }
  const auto arms_of = [=](std::size_t n)
                           HWY_ATTR -> const Arms& { return mid_arms == nullptr ? constraints[n].arms : mid_arms[n]; };
  const Vector torque_a = cross(T::arms(arms_of, &Arms::a), force);
  const Vector torque_b = cross(T::arms(arms_of, &Arms::b), force);
  // One after the other: they may share a body.
  for (std::size_t n = 0; n < T::kConstraints; ++n) {
    LaneWrench& on_a = wrench[constraints[n].a];
    LaneWrench& on_b = wrench[constraints[n].b];
    for (std::size_t i = 0; i < 3; ++i) {
      (Four::load(on_a.row[i]) - force.at[i].group(n)).store(on_a.row[i]);
      (Four::load(on_b.row[i]) + force.at[i].group(n)).store(on_b.row[i]);
      (Four::load(on_a.row[3 + i]) - torque_a.at[i].group(n)).store(on_a.row[3 + i]);
      (Four::load(on_b.row[3 + i]) + torque_b.at[i].group(n)).store(on_b.row[3 + i]);
    }
  }
}

HWY_INLINE Four load(const ConstraintVector& from, std::size_t row) { return Four::load(from.row[row].data()); }

template <class T>
HWY_INLINE void store(const typename T::Vector& vector, ConstraintVector* to) {
  for (std::size_t i = 0; i < 3; ++i)
    vector.at[i].store_each([=](std::size_t n) HWY_ATTR { return to[n].row[i].data(); });
}

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
  for_all(count, [=](auto together, std::size_t p) HWY_ATTR {
    using T = decltype(together);
    store<T>(contact_velocity<T>(constraints + p, velocity), out + p);
  });
}

/// What `relax` computes.
template <class T>
struct Relaxed {
  typename T::Vector u, g, r;
};
template <class T>
HWY_INLINE Relaxed<T> relax_together(const ContactConstraint* constraints, const BodyVector* velocity,
                                     ResidualSum& residual) {
  using P = typename T::P;
  Relaxed<T> out;
  out.u = contact_velocity<T>(constraints, velocity);
  for (std::size_t i = 0; i < 3; ++i) {
    const P penalty = T::penalty(constraints, i);
    const P z = T::row(constraints, &ContactConstraint::contact_velocity, i);
    const P primal_residual = out.u.at[i] - z;
    out.r.at[i] = P::all(0.0) - penalty * primal_residual;
    out.g.at[i] = T::row(constraints, &ContactConstraint::impulse, i) - penalty * z + out.r.at[i];
    // A lane without a point has no velocity to compare with.
    const P counted = primal_residual * (T::inverse_penalty(constraints, i) * penalty);
    const P square = counted * counted;
    for (std::size_t n = 0; n < T::kConstraints; ++n) {
      residual.worst = max(residual.worst, counted.group(n).abs());
      residual.squares[i] = residual.squares[i] + square.group(n);
    }
  }
  return out;
}

/// What `project` does.
template <class T>
HWY_INLINE void project_together(Projection projection, ContactConstraint* constraints, const Arms* mid_arms,
                                 const typename T::Vector& x, const typename T::Vector& u, const NormalBounds* most,
                                 LaneWrench* wrench) {
  using P = typename T::P;
  const P friction = T::friction(constraints);
  const P square = x.at[1] * x.at[1] + x.at[2] * x.at[2];
  P normal = max(x.at[0], P::all(0.0));
  if (projection == Projection::orthogonal) {
    // Where x is outside the disc of radius μ x_n, the nearest point of the cone has this normal part, the larger
    // one.
    const P raise = P::each([=](std::size_t n)
                                HWY_ATTR { return 1.0 / (1.0 + constraints[n].friction * constraints[n].friction); });
    normal = max(normal, raise * (x.at[0] + friction * square.sqrt()));
    if (most != nullptr)
      normal =
          min(normal, T::lanes(most, [](const NormalBounds& bounds) HWY_ATTR -> const Lanes& { return bounds.lane; }));
  }
  const P share = shrink(friction * normal, square);
  const typename T::Vector y{{normal, x.at[1] * share, x.at[2] * share}};
  typename T::Vector f;
  for (std::size_t i = 0; i < 3; ++i) {
    const P z = (y.at[i] - x.at[i]) * T::inverse_penalty(constraints, i);
    y.at[i].store_each([=](std::size_t n) HWY_ATTR { return constraints[n].impulse.row[i].data(); });
    z.store_each([=](std::size_t n) HWY_ATTR { return constraints[n].contact_velocity.row[i].data(); });
    f.at[i] = y.at[i] + T::penalty(constraints, i) * (z - u.at[i]);
  }
  add_wrench<T>(constraints, mid_arms, f, wrench);
}

/// Where the entries of constraints begin in an array that may be missing.
template <class Entry>
HWY_INLINE const Entry* at_or_null(const Entry* entries, std::size_t first) {
  return entries == nullptr ? nullptr : entries + first;
}

HWY_ATTR PrimalResidual relax_kernel(const ContactConstraint* constraints, std::size_t count,
                                     const BodyVector* velocity, ConstraintVector* out_u, ConstraintVector* out_g,
                                     ConstraintVector* out_r) {
  ResidualSum residual = ResidualSum::zero();
  for_all(count, [&](auto together, std::size_t p) HWY_ATTR {
    using T = decltype(together);
    const Relaxed<T> relaxed = relax_together<T>(constraints + p, velocity, residual);
    store<T>(relaxed.u, out_u + p);
    store<T>(relaxed.g, out_g + p);
    store<T>(relaxed.r, out_r + p);
  });
  return residual.result();
}

HWY_ATTR void project_kernel(Projection projection, ContactConstraint* constraints, const Arms* mid_arms,
                             std::size_t count, const ConstraintVector* in_x, const ConstraintVector* in_u,
                             const NormalBounds* most, LaneWrench* wrench) {
  for_all(count, [=](auto together, std::size_t p) HWY_ATTR {
    using T = decltype(together);
    project_together<T>(projection, constraints + p, at_or_null(mid_arms, p), T::load(in_x + p), T::load(in_u + p),
                        at_or_null(most, p), wrench);
  });
}

HWY_ATTR PrimalResidual relax_and_project_kernel(Projection projection, ContactConstraint* constraints,
                                                 const Arms* mid_arms, std::size_t count, const BodyVector* velocity,
                                                 const NormalBounds* most, LaneWrench* wrench) {
  ResidualSum residual = ResidualSum::zero();
  for_all(count, [&](auto together, std::size_t p) HWY_ATTR {
    using T = decltype(together);
    const Relaxed<T> relaxed = relax_together<T>(constraints + p, velocity, residual);
    project_together<T>(projection, constraints + p, at_or_null(mid_arms, p), relaxed.g, relaxed.u, at_or_null(most, p),
                        wrench);
  });
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
  for_all(count, [=](auto together, std::size_t p) HWY_ATTR {
    using T = decltype(together);
    typename T::Vector y;
    for (std::size_t i = 0; i < 3; ++i) y.at[i] = T::row(constraints + p, &ContactConstraint::impulse, i);
    add_wrench<T>(constraints + p, at_or_null(mid_arms, p), y, wrench);
  });
}

HWY_ATTR double supported_power_kernel(const ContactConstraint* constraints, std::size_t count,
                                       const BodyVector* velocity, double largest_impulse, const NormalBounds* most) {
  const Four zero = Four::all(0.0);
  const Four largest_of_all = Four::all(largest_impulse);
  Four sum = zero;
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const Triple u = contact_velocity<Together<1>>(&constraint, velocity);
    const Four slip = (u.at[1] * u.at[1] + u.at[2] * u.at[2]).sqrt();
    const Four bound = most == nullptr ? largest_of_all : min(largest_of_all, Four::load(most[p].lane.data()));
    const Four taken = bound * max(zero, Four::all(constraint.friction) * slip - u.at[0]);
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
                     std::span<ConstraintVector> u, std::span<ConstraintVector> g, std::span<ConstraintVector> r) {
  return HWY_DYNAMIC_DISPATCH(relax_kernel)(constraints.data(), constraints.size(), velocity.data(), u.data(), g.data(),
                                            r.data());
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
                                 std::span<const NormalBounds> most, std::span<LaneWrench> wrench) {
  return HWY_DYNAMIC_DISPATCH(relax_and_project_kernel)(projection, constraints.data(), arms_or_null(mid_arms),
                                                        constraints.size(), velocity.data(),
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
