#include "analyses/bearing/linear_program.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "random.hpp"

namespace linear_program_test {

using namespace holdfast::internal;

namespace {

using Answer = LinearProgram::Answer;

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// The least c·x by trying all bases: nothing where there is no x.
std::optional<double> least_by_trying(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& side,
                                      const Eigen::VectorXd& cost) {
  std::optional<double> least;
  const auto columns = static_cast<unsigned>(matrix.cols());
  for (unsigned chosen = 0; chosen < (1U << columns); ++chosen) {
    std::vector<Eigen::Index> basis;
    for (unsigned column = 0; column < columns; ++column)
      if ((chosen >> column & 1U) != 0) basis.push_back(column);
    if (static_cast<Eigen::Index>(basis.size()) != matrix.rows()) continue;
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(matrix(Eigen::all, basis));
    if (!factors.isInvertible()) continue;
    const Eigen::VectorXd x = factors.solve(side);
    if (x.minCoeff() < -1e-12) continue;
    const double value = cost(basis).dot(x);
    if (!least || value < *least) least = value;
  }
  return least;
}

}  // namespace

TEST_CASE("linear_program: random programs have the least value of all bases", "[analyses][linear_program]") {
  Random random(20);
  int with_answer = 0;
  int without = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    // Positive entries in the first row bound every x.
    Eigen::MatrixXd matrix(4, 9);
    for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix(i) = random.below(3) == 0 ? 0.0 : random.between(-1, 1);
    matrix.row(0).setConstant(1.0);
    Eigen::VectorXd side(4);
    for (Eigen::Index i = 0; i < 4; ++i) side[i] = random.below(2) == 0 ? 0.0 : random.between(-0.2, 0.2);
    side[0] = 1.0;
    LinearProgram program(matrix.sparseView(), side);
    const Answer answer = program.find_feasible(1e-9);
    Eigen::VectorXd cost(9);
    for (int search = 0; search < 3; ++search) {
      for (Eigen::Index i = 0; i < 9; ++i) cost[i] = random.between(-1, 1);
      const std::optional<double> expected = least_by_trying(matrix, side, cost);
      const std::optional<double> found = program.minimise(cost);
      REQUIRE((answer == Answer::yes) == expected.has_value());
      REQUIRE(found.has_value() == expected.has_value());
      if (found) worst = std::max(worst, std::abs(*found - *expected));
    }
    ++(answer == Answer::yes ? with_answer : without);
    if (answer == Answer::yes) continue;
    const Eigen::VectorXd& why = program.certificate();
    CHECK((matrix.transpose() * why).maxCoeff() < 1e-8);
    CHECK(why.cwiseAbs().maxCoeff() < 1 + 1e-8);
    CHECK(why.dot(side) > 1e-9);
  }
  CAPTURE(worst, with_answer, without);
  CHECK(worst < 1e-10);
  CHECK(with_answer > 30);
  CHECK(without > 30);
}

TEST_CASE("linear_program: ends where a textbook's rule cycles", "[analyses][linear_program]") {
  // Beale, Naval Research Logistics Quarterly 2, 1955; the least value is -1/20.
  Eigen::MatrixXd matrix(3, 7);
  matrix << 1, 0, 0, 0.25, -60, -0.04, 9,  //
      0, 1, 0, 0.5, -90, -0.02, 3,         //
      0, 0, 1, 0, 0, 1, 0;
  LinearProgram program(matrix.sparseView(), vector({0, 0, 1}));
  REQUIRE(program.find_feasible(1e-9) == Answer::yes);
  const std::optional<double> least = program.minimise(vector({0, 0, 0, -0.75, 150, -0.02, 6}));
  REQUIRE(least.has_value());
  CHECK(*least == Approx(-0.05));
}

TEST_CASE("linear_program: without a least value there is no answer", "[analyses][linear_program]") {
  Eigen::MatrixXd matrix(1, 2);
  matrix << 1, -1;
  LinearProgram program(matrix.sparseView(), vector({1}));
  REQUIRE(program.find_feasible(1e-9) == Answer::yes);
  CHECK_FALSE(program.minimise(vector({-1, 0})).has_value());
  CHECK(program.minimise(vector({1, 0})).value_or(0.0) == Approx(1.0));
}

}  // namespace linear_program_test
