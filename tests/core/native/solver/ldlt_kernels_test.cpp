#include "core/native/solver/ldlt_kernels.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/native/solver/each_instruction_set.hpp"
#include "core/native/solver/random_contacts.hpp"
#include "same_bits.hpp"

namespace ldlt_kernels_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

/// What contacts add to the matrix, with a block for every pair of bodies: row · kBodies + column.
struct Penalty {
  std::vector<BodyBlock> diagonal, below;
};

/// Where constraints add to the blocks of `Penalty`.
struct Places {
  std::vector<std::uint32_t> pair, block;
};

Places places_of(const RandomContacts& contacts) {
  Places places;
  for (const ContactConstraint& constraint : contacts.constraints) {
    const auto [column, row] = std::minmax(constraint.a, constraint.b);
    const bool with_fixed = row == static_cast<std::int32_t>(kBodies);
    places.pair.push_back(with_fixed ? kNoPair : static_cast<std::uint32_t>(places.block.size()));
    if (!with_fixed)
      places.block.push_back(static_cast<std::uint32_t>(row * static_cast<std::int32_t>(kBodies) + column));
  }
  return places;
}

Penalty penalty_of(const RandomContacts& contacts, bool with_mid_arms) {
  Penalty out{std::vector<BodyBlock>(kBodies), std::vector<BodyBlock>(kBodies * kBodies)};
  const Places places = places_of(contacts);
  add_penalty(contacts.constraints, with_mid_arms ? contacts.mid_arms : std::vector<Arms>(),
              {places.pair, places.block, out.diagonal, out.below});
  return out;
}

Penalty resistance_of(const RandomContacts& contacts, const std::vector<ConstraintMatrix>& resistance) {
  Penalty out{std::vector<BodyBlock>(kBodies), std::vector<BodyBlock>(kBodies * kBodies)};
  const Places places = places_of(contacts);
  add_resistance(contacts.constraints, resistance, {places.pair, places.block, out.diagonal, out.below});
  return out;
}

Mat3 matrix_at(const ConstraintMatrix& matrix, std::size_t lane) {
  Mat3 out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matrix.entry[i][j][lane];
  return out;
}

/// A symmetric positive definite matrix of each point, of all orders of magnitude; 0 where there is none.
std::vector<ConstraintMatrix> random_resistance(const RandomContacts& contacts, std::uint32_t seed) {
  Random random(seed);
  std::vector<ConstraintMatrix> resistance(kConstraints);
  for (std::size_t p = 0; p < kConstraints; ++p) {
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(contacts.constraints[p].count); ++lane) {
      Mat3 root;
      for (double& number : root.reshaped()) number = random.between(-1, 1);
      const Mat3 matrix = std::pow(10.0, random.between(-2, 1)) * (root * root.transpose() + 0.1 * Mat3::Identity());
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          resistance[p].entry[i][j][lane] =
              matrix(static_cast<Eigen::Index>(std::max(i, j)), static_cast<Eigen::Index>(std::min(i, j)));
    }
  }
  return resistance;
}

/// The matrices of the penalty, normal and twice tangential.
std::vector<ConstraintMatrix> penalty_matrices(const RandomContacts& contacts) {
  std::vector<ConstraintMatrix> matrices(kConstraints);
  for (std::size_t p = 0; p < kConstraints; ++p)
    for (std::size_t i = 0; i < 3; ++i) matrices[p].entry[i][i] = contacts.constraints[p].penalty[i > 0];
  return matrices;
}

constexpr Eigen::Index kRows = kBodyRows * (kBodies + 1);

/// Σ J R Jᵀ over the points, J the wrenches of unit impulses along a constraint's directions.
Eigen::MatrixXd sum_over_points(const RandomContacts& contacts, const std::vector<ConstraintMatrix>& matrices,
                                bool with_mid_arms) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(kRows, kRows);
  for (std::size_t p = 0; p < kConstraints; ++p) {
    const ContactConstraint& constraint = contacts.constraints[p];
    const Arms& arms = with_mid_arms ? contacts.mid_arms[p] : constraint.arms;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane) {
      Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(kRows, 3);
      for (std::size_t d = 0; d < 3; ++d) {
        const Vec3 along(constraint.directions[d][0], constraint.directions[d][1], constraint.directions[d][2]);
        auto column = wrenches.col(static_cast<Eigen::Index>(d));
        column.segment<3>(kBodyRows * constraint.a) -= along;
        column.segment<3>(kBodyRows * constraint.a + 3) -= arm_of(arms.a, lane).cross(along);
        column.segment<3>(kBodyRows * constraint.b) += along;
        column.segment<3>(kBodyRows * constraint.b + 3) += arm_of(arms.b, lane).cross(along);
      }
      sum += wrenches * matrix_at(matrices[p], lane) * wrenches.transpose();
    }
  }
  return sum;
}

/// The blocks as a matrix. Of those on the diagonal only the lower triangle is used; above it is zero.
Eigen::MatrixXd lower_matrix(const Penalty& penalty) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kBodyRows * kBodies, kBodyRows * kBodies);
  for (std::size_t i = 0; i < kBodies; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      for (std::size_t c = 0; c < kBodyRows; ++c)
        for (std::size_t r = i == j ? c : 0; r < kBodyRows; ++r)
          matrix(static_cast<Eigen::Index>(kBodyRows * i + r), static_cast<Eigen::Index>(kBodyRows * j + c)) =
              (i == j ? penalty.diagonal[i] : penalty.below[i * kBodies + j]).column[c][padded_row(r)];
  return matrix;
}

/// Difference of the blocks from those of a symmetric matrix, over the size of that.
double difference(const Penalty& penalty, const Eigen::MatrixXd& expected) {
  // What is fixed has no blocks.
  constexpr Eigen::Index kUsed = kBodyRows * kBodies;
  const Eigen::MatrixXd lower = expected.topLeftCorner(kUsed, kUsed).triangularView<Eigen::Lower>();
  return (lower_matrix(penalty) - lower).norm() / lower.norm();
}

/// A chain of bodies with a coupling two further, in order of elimination: its structure has fill.
struct Chain {
  LdltStructure shape;
  std::vector<BodyBlock> below, diagonal, scratch;
  std::vector<DiagonalFactor> factor;
  std::vector<std::uint32_t> block_at_row;
  std::vector<BodyVector> right;
  Eigen::MatrixXd matrix;
};

Chain random_chain(std::uint32_t seed) {
  constexpr std::uint32_t kColumns = 6;
  Random random(seed);
  Chain chain;
  chain.shape.column_begin = {0};
  for (std::uint32_t j = 0; j < kColumns; ++j) {
    for (std::uint32_t row = j + 1; row < std::min(j + 3, kColumns); ++row) chain.shape.block_row.push_back(row);
    chain.shape.column_begin.push_back(static_cast<std::uint32_t>(chain.shape.block_row.size()));
  }
  chain.below.resize(chain.shape.block_row.size());
  chain.diagonal.resize(kColumns);
  chain.factor.resize(kColumns);
  chain.scratch.resize(2);
  chain.block_at_row.resize(kColumns);
  chain.right.resize(kColumns);

  const Eigen::Index rows = kColumns * kBodyRows;
  Eigen::MatrixXd root(rows, rows);
  for (double& number : root.reshaped()) number = random.between(-1, 1);
  chain.matrix = root * root.transpose() / static_cast<double>(rows);
  // Only the blocks of the structure are kept; twice the largest row sum keeps what is left positive definite.
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < rows; ++j)
      if (std::abs(i / kBodyRows - j / kBodyRows) > 2) chain.matrix(i, j) = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) chain.matrix(i, i) += 4.0;
  const auto put = [&](Eigen::Index row, Eigen::Index column, BodyBlock& block) {
    for (Eigen::Index c = 0; c < kBodyRows; ++c)
      for (Eigen::Index r = 0; r < kBodyRows; ++r)
        block.column[c][padded_row(r)] = chain.matrix(row * kBodyRows + r, column * kBodyRows + c);
  };
  for (std::uint32_t j = 0; j < kColumns; ++j) {
    put(j, j, chain.diagonal[j]);
    for (std::uint32_t k = chain.shape.column_begin[j]; k < chain.shape.column_begin[j + 1]; ++k)
      put(chain.shape.block_row[k], j, chain.below[k]);
    for (int k = 0; k < kBodyRows; ++k) chain.right[j].row[padded_row(k)] = random.between(-1, 1);
  }
  return chain;
}

}  // namespace

TEST_CASE("ldlt_kernels: what is factorised is solved", "[core][ldlt_kernels]") {
  for (const std::uint32_t seed : {21U, 22U, 23U}) {
    Chain chain = random_chain(seed);
    Eigen::VectorXd right(chain.matrix.rows());
    for (std::size_t j = 0; j < chain.right.size(); ++j)
      for (std::size_t k = 0; k < kBodyRows; ++k)
        right[static_cast<Eigen::Index>(j * kBodyRows + k)] = chain.right[j].row[padded_row(k)];
    const Eigen::VectorXd exact = chain.matrix.ldlt().solve(right);
    factorise(chain.shape, chain.below, chain.diagonal, chain.factor, chain.scratch, chain.block_at_row);
    solve(chain.shape, chain.below, chain.factor, chain.right);
    double worst = 0.0;
    for (std::size_t j = 0; j < chain.right.size(); ++j)
      for (std::size_t k = 0; k < kBodyRows; ++k)
        worst = std::max(
            worst, std::abs(chain.right[j].row[padded_row(k)] - exact[static_cast<Eigen::Index>(j * kBodyRows + k)]));
    CAPTURE(seed, worst);
    CHECK(worst < 1e-13);
    // Rows that only pad stay zero, or they would end up in the next sweep's vectors.
    for (const BodyVector& x : chain.right) CHECK((x.row[3] == 0.0 && x.row[7] == 0.0));
  }
}

TEST_CASE("ldlt_kernels: what contacts resist is the sum over their points of J R J transposed",
          "[core][ldlt_kernels]") {
  const bool with_mid_arms = GENERATE(false, true);
  const RandomContacts contacts = random_contacts(61);
  const double error = difference(penalty_of(contacts, with_mid_arms),
                                  sum_over_points(contacts, penalty_matrices(contacts), with_mid_arms));
  CAPTURE(with_mid_arms, error);
  CHECK(error < 1e-14);
}

TEST_CASE("ldlt_kernels: points that resist with a matrix each add up to J R J transposed", "[core][ldlt_kernels]") {
  const RandomContacts contacts = random_contacts(62);
  const std::vector<ConstraintMatrix> resistance = random_resistance(contacts, 63);
  const double error = difference(resistance_of(contacts, resistance), sum_over_points(contacts, resistance, false));
  CAPTURE(error);
  CHECK(error < 1e-14);
}

TEST_CASE("ldlt_kernels: a penalty is a diagonal matrix of each point", "[core][ldlt_kernels]") {
  const RandomContacts contacts = random_contacts(64);
  const Eigen::MatrixXd penalty = lower_matrix(penalty_of(contacts, false));
  const Eigen::MatrixXd resistance = lower_matrix(resistance_of(contacts, penalty_matrices(contacts)));
  const double error = (penalty - resistance).norm() / penalty.norm();
  CAPTURE(error);
  CHECK(error < 1e-14);
}

TEST_CASE("ldlt_kernels: resistance is added to what is there, and pads stay zero", "[core][ldlt_kernels]") {
  const RandomContacts contacts = random_contacts(65);
  const std::vector<ConstraintMatrix> resistance = random_resistance(contacts, 66);
  const Penalty once = resistance_of(contacts, resistance);
  Penalty twice = once;
  const Places places = places_of(contacts);
  add_resistance(contacts.constraints, resistance, {places.pair, places.block, twice.diagonal, twice.below});
  const Eigen::MatrixXd single = lower_matrix(once);
  CHECK((lower_matrix(twice) - 2.0 * single).norm() < 1e-14 * single.norm());
  for (const std::vector<BodyBlock>* blocks : {&twice.diagonal, &twice.below})
    for (const BodyBlock& block : *blocks)
      for (const auto& column : block.column) REQUIRE((column[3] == 0.0 && column[7] == 0.0));
}

TEST_CASE("ldlt_kernels: every instruction set computes the same bits", "[core][ldlt_kernels]") {
  const RandomContacts contacts = random_contacts(31);
  const std::vector<ConstraintMatrix> resistance = random_resistance(contacts, 33);
  const Chain chain = random_chain(32);
  struct Output {
    Penalty penalty, resisting;
    Chain chain;
  };
  std::vector<Output> outputs;
  for_each_instruction_set([&](std::int64_t) {
    Output& out = outputs.emplace_back(Output{penalty_of(contacts, true), resistance_of(contacts, resistance), chain});
    factorise(out.chain.shape, out.chain.below, out.chain.diagonal, out.chain.factor, out.chain.scratch,
              out.chain.block_at_row);
    solve(out.chain.shape, out.chain.below, out.chain.factor, out.chain.right);
  });
  REQUIRE_FALSE(outputs.empty());
  for (const Output& out : outputs) {
    const Output& first = outputs.front();
    CAPTURE(&out - &first);
    CHECK(same_bits(out.penalty.diagonal, first.penalty.diagonal));
    CHECK(same_bits(out.penalty.below, first.penalty.below));
    CHECK(same_bits(out.resisting.diagonal, first.resisting.diagonal));
    CHECK(same_bits(out.resisting.below, first.resisting.below));
    CHECK(same_bits(out.chain.below, first.chain.below));
    CHECK(same_bits(out.chain.factor, first.chain.factor));
    CHECK(same_bits(out.chain.right, first.chain.right));
  }
}

}  // namespace ldlt_kernels_test
