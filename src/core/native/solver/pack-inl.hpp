// A few doubles in SIMD vectors, once for every instruction set. Operations go element by element, sums over lanes have
// a fixed order, and nothing is fused or estimated: the bits are the same on every instruction set.

// Highway has each instruction set include this file again.
#if defined(HOLDFAST_PACK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HOLDFAST_PACK_INL
#undef HOLDFAST_PACK_INL
#else
#define HOLDFAST_PACK_INL
#endif

#if defined(__GNUC__) && !defined(__clang__) && !defined(__OPTIMIZE__)
#error "compile this with -O1 at least, as src/core/CMakeLists.txt does: without, GCC 12 loses vectors"
#endif

#include <hwy/highway.h>
#include <array>
#include <cstddef>

#include "core/native/solver/body_block.hpp"
#include "core/native/solver/contact_constraint.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Groups of a fixed number of doubles, however many vectors they take. No two groups share a vector: they may lie
/// anywhere in memory. A processor that would wait for the results of one group has the others to work on.
template <std::size_t kSize, std::size_t kGroups = 1>
struct Pack {
  using D = hn::CappedTag<double, kSize>;
  static constexpr std::size_t kWidth = hn::MaxLanes(D());
  static constexpr std::size_t kVectorsOfGroup = kSize / kWidth;
  static constexpr std::size_t kVectors = kGroups * kVectorsOfGroup;
  hn::Vec<D> part[kVectors];

  /// @param from `const double*(std::size_t group)`
  template <class From>
  static HWY_INLINE Pack load_each(From from) {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i)
      p.part[i] = hn::Load(D(), from(i / kVectorsOfGroup) + i % kVectorsOfGroup * kWidth);
    return p;
  }
  /// The same number for a whole group.
  /// @param value `double(std::size_t group)`
  template <class Value>
  static HWY_INLINE Pack each(Value value) {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = hn::Set(D(), value(i / kVectorsOfGroup));
    return p;
  }
  /// @param to `double*(std::size_t group)`
  template <class To>
  HWY_INLINE void store_each(To to) const {
    for (std::size_t i = 0; i < kVectors; ++i)
      hn::Store(part[i], D(), to(i / kVectorsOfGroup) + i % kVectorsOfGroup * kWidth);
  }
  HWY_INLINE Pack<kSize> group(std::size_t n) const {
    Pack<kSize> p;
    for (std::size_t i = 0; i < kVectorsOfGroup; ++i) p.part[i] = part[n * kVectorsOfGroup + i];
    return p;
  }

  static HWY_INLINE Pack load(const double* from) {
    return load_each([from](std::size_t) HWY_ATTR { return from; });
  }
  static HWY_INLINE Pack all(double value) {
    return each([value](std::size_t) HWY_ATTR { return value; });
  }
  HWY_INLINE void store(double* to) const {
    store_each([to](std::size_t) HWY_ATTR { return to; });
  }

  template <class Operation>
  static HWY_INLINE Pack map(const Pack& a, const Pack& b, Operation operation) {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = operation(a.part[i], b.part[i]);
    return p;
  }
  friend HWY_INLINE Pack operator+(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Add(x, y); });
  }
  friend HWY_INLINE Pack operator-(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Sub(x, y); });
  }
  friend HWY_INLINE Pack operator*(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Mul(x, y); });
  }
  friend HWY_INLINE Pack operator/(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Div(x, y); });
  }
  friend HWY_INLINE Pack max(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Max(x, y); });
  }
  friend HWY_INLINE Pack min(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Min(x, y); });
  }
  HWY_INLINE Pack abs() const {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = hn::Abs(part[i]);
    return p;
  }
  HWY_INLINE Pack sqrt() const {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = hn::Sqrt(part[i]);
    return p;
  }
};

using Four = Pack<kLanes>;
using Eight = Pack<kPaddedRows>;

/// Three components of a vector at the points of constraints.
template <class P>
struct TripleOf {
  P at[3];

  static HWY_INLINE TripleOf load(const std::array<Lanes, 3>& rows) {
    return {{P::load(rows[0].data()), P::load(rows[1].data()), P::load(rows[2].data())}};
  }
  HWY_INLINE void store(std::array<Lanes, 3>& rows) const {
    for (std::size_t i = 0; i < 3; ++i) at[i].store(rows[i].data());
  }

  friend HWY_INLINE TripleOf operator+(const TripleOf& a, const TripleOf& b) {
    return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]}};
  }
  friend HWY_INLINE TripleOf operator-(const TripleOf& a, const TripleOf& b) {
    return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
  }
  friend HWY_INLINE TripleOf operator*(const P& s, const TripleOf& v) {
    return {{s * v.at[0], s * v.at[1], s * v.at[2]}};
  }
  friend HWY_INLINE P dot(const TripleOf& a, const TripleOf& b) {
    return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
  }
  friend HWY_INLINE TripleOf cross(const TripleOf& a, const TripleOf& b) {
    return {{a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
             a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
  }
};

using Triple = TripleOf<Four>;

/// 1 in the lanes of so many points, 0 in the others.
HWY_INLINE Four used_lanes(std::int32_t count) {
  alignas(64) static constexpr double kUsed[kLanes + 1][kLanes] = {
      {0, 0, 0, 0}, {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 0}, {1, 1, 1, 1}};
  return Four::load(kUsed[count]);
}

/// Sum over the lanes.
HWY_INLINE double total(const Four& four) {
  alignas(64) double lane[kLanes];
  four.store(lane);
  return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

/// The sums over the lanes of four, each in the order of `total`.
HWY_INLINE Four totals(const Four& a, const Four& b, const Four& c, const Four& d) {
#if HWY_TARGET == HWY_SCALAR
  alignas(64) const double sums[kLanes] = {total(a), total(b), total(c), total(d)};
  return Four::load(sums);
#else
  const Four::D lanes;
  // Of each two lanes of x the sum, and of the same of y, side by side.
  const auto neighbours = [lanes](const auto& x, const auto& y) HWY_ATTR {
    return hn::Add(hn::InterleaveLower(lanes, x, y), hn::InterleaveUpper(lanes, x, y));
  };
  constexpr std::size_t kLast = Four::kVectors - 1;
  Four sums;
  if constexpr (kLast == 0) {
    const auto of_ab = neighbours(a.part[0], b.part[0]);
    const auto of_cd = neighbours(c.part[0], d.part[0]);
    sums.part[0] = hn::Add(hn::ConcatLowerLower(lanes, of_cd, of_ab), hn::ConcatUpperUpper(lanes, of_cd, of_ab));
  } else {
    sums.part[0] = hn::Add(neighbours(a.part[0], b.part[0]), neighbours(a.part[kLast], b.part[kLast]));
    sums.part[kLast] = hn::Add(neighbours(c.part[0], d.part[0]), neighbours(c.part[kLast], d.part[kLast]));
  }
  return sums;
#endif
}

}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HOLDFAST_PACK_INL
