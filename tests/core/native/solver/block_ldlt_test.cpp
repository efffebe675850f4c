#include "core/native/solver/block_ldlt.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include "random.hpp"
#include "same_bits.hpp"

namespace block_ldlt_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

using Block = Eigen::Matrix<double, kBodyRows, kBodyRows>;

/// Every pair with a probability; the order of pairs and of the two within a pair is random.
std::vector<BodyPair> random_pairs(Random& random, std::uint32_t count, double probability) {
  std::vector<BodyPair> pairs;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      if (random.between(0, 1) >= probability) continue;
      pairs.push_back(random.below(2) == 0 ? BodyPair(i, j) : BodyPair(j, i));
      std::swap(pairs[random.below(static_cast<std::uint32_t>(pairs.size()))], pairs.back());
    }
  }
  return pairs;
}

Block random_block(Random& random) {
  Block block;
  for (double& number : block.reshaped()) number = random.between(-1, 1);
  return block;
}

void put(const Block& from, BodyBlock& to) {
  for (int c = 0; c < kBodyRows; ++c)
    for (int r = 0; r < kBodyRows; ++r) to.column[c][padded_row(r)] = from(r, c);
}

/// A system with the graph of the factor: filled in, as a dense matrix with rows by elimination index, and its
/// right-hand side.
struct System {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

System fill(BlockLdlt& factor, std::size_t count, const std::vector<BodyPair>& pairs, Random& random) {
  const auto rows = static_cast<Eigen::Index>(count * kBodyRows);
  System system{Eigen::MatrixXd::Zero(rows, rows), Eigen::VectorXd(rows)};
  factor.clear();
  std::vector<Block> diagonal(count, Block(1e-3 * Block::Identity()));
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    // What a contact adds: G Gᵀ for the two bodies, of all orders of magnitude.
    const double scale = std::pow(10.0, random.between(-1, 2));
    const std::uint32_t first = factor.elimination_index(pairs[p].first);
    const std::uint32_t second = factor.elimination_index(pairs[p].second);
    const auto [column, row] = std::minmax(first, second);
    const Block on_row = random_block(random);
    const Block on_column = random_block(random);
    diagonal[row] += scale * on_row * on_row.transpose();
    diagonal[column] += scale * on_column * on_column.transpose();
    const Block below = scale * on_row * on_column.transpose();
    put(below, factor.below(p));
    system.matrix.block<kBodyRows, kBodyRows>(row * kBodyRows, column * kBodyRows) = below;
    system.matrix.block<kBodyRows, kBodyRows>(column * kBodyRows, row * kBodyRows) = below.transpose();
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Block own = random_block(random);
    diagonal[i] += own * own.transpose() + Block::Identity();
    put(diagonal[i], factor.diagonal(i));
    const auto begin = static_cast<Eigen::Index>(i * kBodyRows);
    system.matrix.block<kBodyRows, kBodyRows>(begin, begin) = diagonal[i];
  }
  for (double& number : system.right) number = random.between(-1, 1);
  return system;
}

std::vector<BodyVector> solution_of(BlockLdlt& factor, const System& system) {
  std::vector<BodyVector> x(static_cast<std::size_t>(system.right.size()) / kBodyRows);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < kBodyRows; ++k)
      x[i].row[padded_row(k)] = system.right[static_cast<Eigen::Index>(i * kBodyRows + k)];
  factor.factorise();
  factor.solve(x);
  return x;
}

/// Largest difference from the dense solution, over the largest number of that.
double error_of(const std::vector<BodyVector>& x, const System& system) {
  const Eigen::VectorXd exact = system.matrix.ldlt().solve(system.right);
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < kBodyRows; ++k)
      worst = std::max(worst, std::abs(x[i].row[padded_row(k)] - exact[static_cast<Eigen::Index>(i * kBodyRows + k)]));
  return worst / exact.cwiseAbs().maxCoeff();
}

/// Bodies of unit mass and inertia in a chain, each held to the next, and the last to what is fixed, by two points in
/// oblique directions that resist with `stiffness`: other motions meet the masses alone.
System stiff_chain(BlockLdlt& factor, double stiffness, Random& random) {
  constexpr std::uint32_t kCount = 6;
  constexpr Eigen::Index kRows = kCount * kBodyRows;
  std::vector<BodyPair> pairs;
  for (std::uint32_t i = 0; i + 1 < kCount; ++i) pairs.emplace_back(i, i + 1);
  factor.analyse(kCount, pairs);
  factor.clear();
  System system{Eigen::MatrixXd::Identity(kRows, kRows), Eigen::VectorXd(kRows)};
  const auto row_of = [&](std::uint32_t body) {
    return static_cast<Eigen::Index>(factor.elimination_index(body)) * kBodyRows;
  };
  for (std::uint32_t i = 0; i < kCount; ++i) {
    for (int point = 0; point < 2; ++point) {
      const Vec3 normal = random.vector(-1, 1).normalized();
      Eigen::VectorXd wrench = Eigen::VectorXd::Zero(kRows);
      wrench.segment<6>(row_of(i)) << normal, random.vector(-1, 1).cross(normal);
      if (i + 1 < kCount) wrench.segment<6>(row_of(i + 1)) << -normal, random.vector(-1, 1).cross(normal);
      system.matrix += stiffness * wrench * wrench.transpose();
    }
  }
  const auto block = [&](std::uint32_t row, std::uint32_t column) -> Block {
    return system.matrix.block<kBodyRows, kBodyRows>(row_of(row), row_of(column));
  };
  for (std::uint32_t i = 0; i < kCount; ++i) put(block(i, i), factor.diagonal(factor.elimination_index(i)));
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    const bool in_order = factor.elimination_index(a) < factor.elimination_index(b);
    put(in_order ? block(b, a) : block(a, b), factor.below(p));
  }
  for (double& number : system.right) number = random.between(-1, 1);
  return system;
}

/// Length of A x - b over that which A and x allow.
double backward_error(const std::vector<BodyVector>& x, const System& system) {
  using Exact = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  Exact solution(system.right.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < kBodyRows; ++k)
      solution[static_cast<Eigen::Index>(i * kBodyRows + k)] = static_cast<long double>(x[i].row[padded_row(k)]);
  const Exact left = system.matrix.cast<long double>() * solution - system.right.cast<long double>();
  return static_cast<double>(left.norm() / (static_cast<long double>(system.matrix.norm()) * solution.norm()));
}

}  // namespace

TEST_CASE("block_ldlt: any graph is solved as a dense matrix is", "[core][block_ldlt]") {
  Random random(3);
  // 64 and 65: a row of the graph takes one word of bits, and two.
  for (const std::uint32_t count : {1U, 2U, 3U, 9U, 30U, 64U, 65U, 70U}) {
    for (const double probability : {0.0, 3.0 / count, 0.3, 1.0}) {
      if (count > 30 && probability == 1.0) continue;
      const std::vector<BodyPair> pairs = random_pairs(random, count, probability);
      BlockLdlt factor;
      factor.analyse(count, pairs);
      const System system = fill(factor, count, pairs, random);
      const double error = error_of(solution_of(factor, system), system);
      CAPTURE(count, probability, pairs.size(), error);
      CHECK(error < 1e-11);
    }
  }
}

TEST_CASE("block_ldlt: every body has a elimination_index of its own", "[core][block_ldlt]") {
  Random random(4);
  for (const std::uint32_t count : {1U, 5U, 64U, 130U}) {
    BlockLdlt factor;
    factor.analyse(count, random_pairs(random, count, 4.0 / count));
    std::vector<std::uint32_t> places;
    for (std::size_t body = 0; body < count; ++body) places.push_back(factor.elimination_index(body));
    std::sort(places.begin(), places.end());
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    CAPTURE(count);
    CHECK(places == all);
  }
}

TEST_CASE("block_ldlt: one object takes one system after another", "[core][block_ldlt]") {
  Random random(5);
  const std::vector<BodyPair> pairs = random_pairs(random, 20, 0.2);
  BlockLdlt factor;
  factor.analyse(20, pairs);
  const System first = fill(factor, 20, pairs, random);
  CHECK(error_of(solution_of(factor, first), first) < 1e-11);

  // The same pairs with other numbers; then with the first ones again, which the factor has overwritten meanwhile.
  const auto again = [&](std::uint32_t seed) {
    Random numbers(seed);
    factor.analyse(20, pairs);
    const System system = fill(factor, 20, pairs, numbers);
    std::vector<BodyVector> x = solution_of(factor, system);
    CHECK(error_of(x, system) < 1e-11);
    return x;
  };
  const std::vector<BodyVector> seventh = again(7);
  again(8);
  // Other graphs in between: fewer bodies, more bodies, and as many pairs between others.
  for (const auto& [count, probability] : {std::pair(6U, 0.5), std::pair(40U, 0.1), std::pair(20U, 0.2)}) {
    const std::vector<BodyPair> others = random_pairs(random, count, probability);
    factor.analyse(count, others);
    const System system = fill(factor, count, others, random);
    CHECK(error_of(solution_of(factor, system), system) < 1e-11);
  }
  CHECK(same_bits(again(7), seventh));
}

TEST_CASE("block_ldlt: the order of a pair does not matter to its elimination_index", "[core][block_ldlt]") {
  Random random(6);
  std::vector<BodyPair> pairs = random_pairs(random, 25, 0.15);
  BlockLdlt factor, other;
  factor.analyse(25, pairs);
  std::reverse(pairs.begin(), pairs.end());
  for (BodyPair& pair : pairs) std::swap(pair.first, pair.second);
  other.analyse(25, pairs);
  for (std::size_t body = 0; body < 25; ++body) CHECK(factor.elimination_index(body) == other.elimination_index(body));
}

TEST_CASE("block_ldlt: contacts much stiffer than masses leave a small backward error", "[core][block_ldlt]") {
  Random random(8);
  for (const double stiffness : {1.0, 1e5, 1e10, 1e13}) {
    for (int sample = 0; sample < 20; ++sample) {
      BlockLdlt factor;
      const System system = stiff_chain(factor, stiffness, random);
      const double error = backward_error(solution_of(factor, system), system);
      CAPTURE(stiffness, sample, error);
      // With the inverses of the diagonal blocks it is up to 1e-9.
      CHECK(error < 1e-14);
    }
  }
}

TEST_CASE("block_ldlt: bodies are eliminated in the order of least degree, of several the first",
          "[core][block_ldlt]") {
  Random random(5);
  for (const std::uint32_t count : {1U, 9U, 63U, 64U, 65U, 150U}) {
    const std::vector<BodyPair> pairs = random_pairs(random, count, 4.0 / count);
    std::vector<std::set<std::uint32_t>> neighbours(count);
    for (const auto& [a, b] : pairs) {
      neighbours[a].insert(b);
      neighbours[b].insert(a);
    }
    BlockLdlt ldlt;
    ldlt.analyse(count, pairs);
    std::vector<std::uint32_t> left(count);
    std::iota(left.begin(), left.end(), 0U);
    for (std::uint32_t step = 0; step < count; ++step) {
      const auto least = std::min_element(left.begin(), left.end(), [&](std::uint32_t a, std::uint32_t b) {
        return neighbours[a].size() < neighbours[b].size();
      });
      const std::uint32_t body = *least;
      left.erase(least);
      CAPTURE(count, step, body);
      REQUIRE(ldlt.elimination_index(body) == step);
      for (const std::uint32_t other : neighbours[body]) {
        neighbours[other].insert(neighbours[body].begin(), neighbours[body].end());
        neighbours[other].erase(other);
        neighbours[other].erase(body);
      }
    }
  }
}

}  // namespace block_ldlt_test
