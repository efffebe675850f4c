#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/native/collision/oriented_box.hpp"
#include "core/native/solver/contact_problem.hpp"

namespace holdfast::internal::native {

/// Impulses that have balanced the islands of a world where they rest, under earlier effective gravities.
///
/// Balance is linear: where impulses y_k balance an island under g_k, Σ λ_k y_k balances it under Σ λ_k g_k, if the
/// weights λ_k add up to 1. Where none of them is negative, the sum is in the contacts' cones and below their bounds
/// too, since these are convex. So under an acceleration between others a proof of rest is a sum in place of a solve.
/// Whether it does balance is for the caller to check: bodies may have moved, and friction, bounds or forces from
/// outside may have changed.
class KnownBalances {
 public:
  /// The contact of two bodies that a constraint of a problem belongs to, as in `Manifold`.
  struct Contact {
    std::int32_t a = 0, b = 0;
    std::int32_t points = 0;

    bool operator==(const Contact&) const = default;
  };

  /// What an island is known by.
  struct Island {
    std::uint32_t first_body = 0;
    std::span<const Contact> contacts;  ///< a constraint of its problem
  };

  /// Replaces the problem's impulses by a sum of known ones that balances it under `gravity`. False, and nothing
  /// changes, where none is known.
  /// @param gravity effective, m/s²
  /// @param step    of the problem, s
  bool combine(const Island& island, const Vec3& gravity, double step, ContactProblem& problem) const;

  /// Forgets the island, where a sum did not balance it.
  void forget(const Island& island) { records_[island.first_body] = {}; }

  /// Keeps the problem's impulses, which balance it under `gravity`.
  void keep(const Island& island, const Vec3& gravity, double step, const ContactProblem& problem);

  /// An effective gravity beyond `gravity` and what is known, for a try: a balance that is found there also decides
  /// those that come next, where accelerations are samples of a curve. None where they change by more than that, or
  /// tries have failed.
  std::optional<Vec3> beyond(const Island& island, const Vec3& gravity) const;

  /// Takes down how that try ended: the next goes twice as far, or half as far where it failed.
  void note_beyond(const Island& island, bool balances);

 private:
  struct Balance {
    Vec3 gravity;
    std::vector<ConstraintVector> force;  ///< a constraint, along its directions, N
  };
  struct Record {
    std::vector<Contact> contacts;
    std::vector<Balance> balances;
    double reach = 1.0;  ///< how far `beyond` goes, over the distance from the centre of what is known
  };

  const Record* record_of(const Island& island) const;

  std::vector<Record> records_;  ///< by an island's first body
};

}  // namespace holdfast::internal::native
