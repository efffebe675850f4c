#include "core/native/known_balances.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

constexpr int kMost = static_cast<int>(kKnownBalances);

bool are_same(std::span<const KnownBalances::Contact> a, std::span<const KnownBalances::Contact> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// The weights of a combination, and what they belong to.
struct Combination {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1> weights;
  std::array<std::size_t, kKnownBalances> of{};  ///< indices

  std::size_t size() const { return static_cast<std::size_t>(weights.size()); }
};

/// The smallest weights with Σ λ_k g_k = g and Σ λ_k = 1. False where there are none.
bool find_weights(const Vec3& gravity, std::span<const Vec3> known, Combination& combination) {
  const double unit = gravity == Vec3::Zero() ? 1.0 : gravity.norm();
  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, kMost> matrix(4, combination.weights.size());
  for (std::size_t k = 0; k < combination.size(); ++k)
    matrix.col(static_cast<Eigen::Index>(k)) << known[combination.of[k]], unit;
  const Eigen::Vector4d wanted(gravity.x(), gravity.y(), gravity.z(), unit);
  combination.weights = matrix.completeOrthogonalDecomposition().solve(wanted);
  return (matrix * combination.weights - wanted).norm() <= kRounding * unit;
}

/// Weights of which none is negative: leaves out the most negative one until none is. None where that ends without,
/// as it does where there are no such weights, and rarely where there are some.
std::optional<Combination> combination_of(const Vec3& gravity, std::span<const Vec3> known) {
  Combination combination;
  for (std::size_t k = 0; k < known.size(); ++k) combination.of[k] = k;
  for (std::size_t count = known.size(); count > 0; --count) {
    combination.weights.resize(static_cast<Eigen::Index>(count));
    if (!find_weights(gravity, known, combination)) return std::nullopt;
    Eigen::Index least = 0;
    if (combination.weights.minCoeff(&least) >= 0.0) return combination;
    std::copy(combination.of.begin() + least + 1, combination.of.begin() + static_cast<std::ptrdiff_t>(count),
              combination.of.begin() + least);
  }
  return std::nullopt;
}

}  // namespace

/// What is known of an island; null: nothing.
const KnownBalances::Record* KnownBalances::record_of(const Island& island) const {
  if (island.first_body >= records_.size()) return nullptr;
  const Record& record = records_[island.first_body];
  return !record.balances.empty() && are_same(record.contacts, island.contacts) ? &record : nullptr;
}

bool KnownBalances::combine(const Island& island, const Vec3& gravity, double step, ContactProblem& problem) const {
  const Record* const record = record_of(island);
  if (record == nullptr) return false;
  std::array<Vec3, kKnownBalances> known;
  for (std::size_t k = 0; k < record->balances.size(); ++k) known[k] = record->balances[k].gravity;
  const std::optional<Combination> found = combination_of(gravity, std::span(known).first(record->balances.size()));
  if (!found) return false;
  for (std::size_t p = 0; p < problem.constraints.size(); ++p) {
    ConstraintVector& impulse = problem.constraints[p].impulse;
    impulse = {};
    for (std::size_t k = 0; k < found->size(); ++k) {
      const double share = step * found->weights[static_cast<Eigen::Index>(k)];
      const ConstraintVector& force = record->balances[found->of[k]].force[p];
      for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t lane = 0; lane < kLanes; ++lane) impulse.row[d][lane] += share * force.row[d][lane];
    }
  }
  return true;
}

void KnownBalances::keep(const Island& island, const Vec3& gravity, double step, const ContactProblem& problem) {
  records_.resize(std::max<std::size_t>(records_.size(), island.first_body + 1));
  Record& record = records_[island.first_body];
  if (!are_same(record.contacts, island.contacts))
    record = {.contacts = {island.contacts.begin(), island.contacts.end()}};
  Balance kept{gravity, std::vector<ConstraintVector>(problem.constraints.size())};
  for (std::size_t p = 0; p < problem.constraints.size(); ++p)
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        kept.force[p].row[d][lane] = problem.constraints[p].impulse.row[d][lane] / step;
  std::vector<Balance>& balances = record.balances;
  if (balances.size() < kKnownBalances) {
    balances.push_back(std::move(kept));
    return;
  }
  // One that follows from the others makes room, or else the one that is most like the new one.
  auto least = std::find_if(balances.begin(), balances.end(), [&](const Balance& balance) {
    std::array<Vec3, kKnownBalances> others;
    for (std::size_t k = 0; k < balances.size(); ++k) others[k] = balances[k].gravity;
    others[static_cast<std::size_t>(&balance - balances.data())] = gravity;
    return combination_of(balance.gravity, others).has_value();
  });
  const auto is_nearer = [&](const Balance& a, const Balance& b) {
    return (a.gravity - gravity).squaredNorm() < (b.gravity - gravity).squaredNorm();
  };
  if (least == balances.end()) least = std::min_element(balances.begin(), balances.end(), is_nearer);
  *least = std::move(kept);
}

std::optional<Vec3> KnownBalances::beyond(const Island& island, const Vec3& gravity) const {
  const Record* const record = record_of(island);
  if (record == nullptr || record->reach < kLeastReach) return std::nullopt;
  Vec3 centre = Vec3::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Balance& balance : record->balances) {
    centre += balance.gravity / static_cast<double>(record->balances.size());
    nearest = std::min(nearest, (balance.gravity - gravity).norm());
  }
  if (nearest > kSmall * gravity.norm()) return std::nullopt;
  return gravity + record->reach * (gravity - centre);
}

void KnownBalances::note_beyond(const Island& island, bool balances) {
  Record& record = records_[island.first_body];
  record.reach *= balances ? 2.0 : 0.5;
}

}  // namespace holdfast::internal::native
