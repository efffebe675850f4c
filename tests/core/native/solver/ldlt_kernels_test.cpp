#include "core/native/solver/ldlt_kernels.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/native/solver/each_instruction_set.hpp"
#include "core/native/solver/random_contacts.hpp"
#include "same_bits.hpp"

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

/// What contacts add to the matrix, with a block for every pair of bodies: row · kBodies + column.
struct Penalty {
  std::vector<BodyBlock> diagonal, below;
};

void add_penalty(const Contacts& contacts, Penalty& out, bool with_mid_arms) {
  out.diagonal.resize(kBodies);
  out.below.resize(kBodies * kBodies);
  std::vector<std::uint32_t> pair, block;
  for (const ContactConstraint& constraint : contacts.constraints) {
    const auto [column, row] = std::minmax(constraint.a, constraint.b);
    const bool with_fixed = row == static_cast<std::int32_t>(kBodies);
    pair.push_back(with_fixed ? kNoPair : static_cast<std::uint32_t>(block.size()));
    if (!with_fixed) block.push_back(static_cast<std::uint32_t>(row * static_cast<std::int32_t>(kBodies) + column));
  }
  native::add_penalty(contacts.constraints, with_mid_arms ? contacts.mid_arms : std::vector<Arms>(), pair, block,
                      out.diagonal, out.below);
}

/// A chain of bodies with a coupling two further, in order of elimination: its structure has fill.
struct Chain {
  LdltStructure shape;
  std::vector<BodyBlock> below, diagonal, scratch;
  std::vector<BodyVector> right;
  Eigen::MatrixXd matrix;
};

Chain random_chain(std::uint32_t seed) {
  constexpr std::uint32_t kColumns = 6;
  Random random(seed);
  Chain chain;
  chain.shape.column_begin = {0};
  chain.shape.update_begin = {0};
  for (std::uint32_t j = 0; j < kColumns; ++j) {
    for (std::uint32_t row = j + 1; row < std::min(j + 3, kColumns); ++row) chain.shape.block_row.push_back(row);
    chain.shape.column_begin.push_back(static_cast<std::uint32_t>(chain.shape.block_row.size()));
  }
  const auto below_count = static_cast<std::uint32_t>(chain.shape.block_row.size());
  for (std::uint32_t j = 0; j < kColumns; ++j) {
    for (std::uint32_t k = chain.shape.column_begin[j]; k < chain.shape.column_begin[j + 1]; ++k) {
      const std::uint32_t column = chain.shape.block_row[k];
      chain.shape.updates.push_back({below_count + column, k, k});
      // The two rows of a column are neighbours: their own block is the first of the earlier one's column.
      if (k + 1 < chain.shape.column_begin[j + 1])
        chain.shape.updates.push_back({chain.shape.column_begin[column], k + 1, k});
    }
    chain.shape.update_begin.push_back(static_cast<std::uint32_t>(chain.shape.updates.size()));
  }
  chain.below.resize(below_count);
  chain.diagonal.resize(kColumns);
  chain.scratch.resize(2);
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
        block.column[c][r] = chain.matrix(row * kBodyRows + r, column * kBodyRows + c);
  };
  for (std::uint32_t j = 0; j < kColumns; ++j) {
    put(j, j, chain.diagonal[j]);
    for (std::uint32_t k = chain.shape.column_begin[j]; k < chain.shape.column_begin[j + 1]; ++k)
      put(chain.shape.block_row[k], j, chain.below[k]);
    for (int k = 0; k < kBodyRows; ++k) chain.right[j].row[k] = random.between(-1, 1);
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
        right[static_cast<Eigen::Index>(j * kBodyRows + k)] = chain.right[j].row[k];
    const Eigen::VectorXd exact = chain.matrix.ldlt().solve(right);
    factorise(chain.shape, chain.below, chain.diagonal, chain.scratch);
    solve(chain.shape, chain.below, chain.diagonal, chain.right);
    double worst = 0.0;
    for (std::size_t j = 0; j < chain.right.size(); ++j)
      for (std::size_t k = 0; k < kBodyRows; ++k)
        worst = std::max(worst, std::abs(chain.right[j].row[k] - exact[static_cast<Eigen::Index>(j * kBodyRows + k)]));
    CAPTURE(seed, worst);
    CHECK(worst < 1e-13);
    // Rows that only pad stay zero, or they would end up in the next sweep's vectors.
    for (const BodyVector& x : chain.right) CHECK((x.row[6] == 0.0 && x.row[7] == 0.0));
  }
}

TEST_CASE("ldlt_kernels: what contacts resist is the sum over their points of J R J transposed",
          "[core][ldlt_kernels]") {
  const bool with_mid_arms = GENERATE(false, true);
  const Contacts contacts = random_contacts(61);
  Penalty penalty;
  add_penalty(contacts, penalty, with_mid_arms);

  constexpr Eigen::Index kRows = kBodyRows * (kBodies + 1);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(kRows, kRows);
  for (std::size_t p = 0; p < kConstraints; ++p) {
    const ContactConstraint& constraint = contacts.constraints[p];
    const Arms& arms = with_mid_arms ? contacts.mid_arms[p] : constraint.arms;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane) {
      for (std::size_t d = 0; d < 3; ++d) {
        const Vec3 along(constraint.directions[d][0], constraint.directions[d][1], constraint.directions[d][2]);
        Eigen::VectorXd row = Eigen::VectorXd::Zero(kRows);
        row.segment<3>(kBodyRows * constraint.a) -= along;
        row.segment<3>(kBodyRows * constraint.a + 3) -= arm_of(arms.a, lane).cross(along);
        row.segment<3>(kBodyRows * constraint.b) += along;
        row.segment<3>(kBodyRows * constraint.b + 3) += arm_of(arms.b, lane).cross(along);
        expected += constraint.penalty[d > 0][lane] * row * row.transpose();
      }
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < kBodies; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const BodyBlock& block = i == j ? penalty.diagonal[i] : penalty.below[i * kBodies + j];
      for (std::size_t c = 0; c < kBodyRows; ++c) {
        // Of blocks on the diagonal only the lower triangle is used.
        for (std::size_t r = i == j ? c : 0; r < kBodyRows; ++r) {
          worst =
              std::max(worst, std::abs(block.column[c][r] - expected(static_cast<Eigen::Index>(kBodyRows * i + r),
                                                                     static_cast<Eigen::Index>(kBodyRows * j + c))));
        }
      }
    }
  }
  CAPTURE(with_mid_arms, worst);
  CHECK(worst < 1e-12);
}

TEST_CASE("ldlt_kernels: every instruction set computes the same bits", "[core][ldlt_kernels]") {
  const Contacts contacts = random_contacts(31);
  const Chain chain = random_chain(32);
  struct Output {
    Penalty resisting;
    Chain chain;
  };
  std::vector<Output> outputs;
  for_each_instruction_set([&](std::int64_t) {
    Output& out = outputs.emplace_back(Output{{}, chain});
    add_penalty(contacts, out.resisting, true);
    factorise(out.chain.shape, out.chain.below, out.chain.diagonal, out.chain.scratch);
    solve(out.chain.shape, out.chain.below, out.chain.diagonal, out.chain.right);
  });
  REQUIRE_FALSE(outputs.empty());
  for (const Output& out : outputs) {
    const Output& first = outputs.front();
    CAPTURE(&out - &first);
    CHECK(same_bits(out.resisting.diagonal, first.resisting.diagonal));
    CHECK(same_bits(out.resisting.below, first.resisting.below));
    CHECK(same_bits(out.chain.below, first.chain.below));
    CHECK(same_bits(out.chain.diagonal, first.chain.diagonal));
    CHECK(same_bits(out.chain.right, first.chain.right));
  }
}
