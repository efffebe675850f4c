#include "core/native/solver/problem_bytes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/native/solver/admm.hpp"
#include "core/native/solver/solved_problems.hpp"
#include "same_bits.hpp"

namespace problem_bytes_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

TEST_CASE("problem_bytes: a problem that is written and read again is solved to the same bits",
          "[core][problem_bytes]") {
  const std::vector<SolvedProblem> problems = problems_of_a_stack();
  REQUIRE(problems.size() > 50);
  AdmmSolver solver;
  int with_rest = 0, with_turning = 0;
  for (const SolvedProblem& expected : problems) {
    Result<StoredProblem> read = problem_from(bytes_of(expected.given));
    REQUIRE(read);
    with_rest += read->limits.projection == Projection::orthogonal ? 1 : 0;
    with_turning += read->problem.mid_arms.empty() ? 0 : 1;
    const SolveResult result = solver.solve(read->problem, read->limits);
    REQUIRE(result.iterations == expected.result.iterations);
    REQUIRE(result.factorisations == expected.result.factorisations);
    REQUIRE(result.residual == expected.result.residual);
    REQUIRE(same_bits(read->problem.velocity, expected.solved.velocity));
    for (std::size_t p = 0; p < expected.solved.constraints.size(); ++p)
      REQUIRE(same_bits(std::vector{read->problem.constraints[p].impulse},
                        std::vector{expected.solved.constraints[p].impulse}));
  }
  CAPTURE(problems.size(), with_rest, with_turning);
  CHECK(with_rest > 0);
  CHECK(with_turning > 0);
}

TEST_CASE("problem_bytes: what is no problem is refused", "[core][problem_bytes]") {
  const StoredProblem stored = problems_of_a_stack().front().given;
  const std::string bytes = bytes_of(stored);
  REQUIRE(problem_from(bytes));
  CHECK_FALSE(problem_from(""));
  CHECK_FALSE(problem_from("HFCP0001" + bytes.substr(8)));
  CHECK_FALSE(problem_from(bytes + "x"));
  for (std::size_t length = 8; length < bytes.size(); length += bytes.size() / 97 + 1)
    CHECK_FALSE(problem_from(std::string_view(bytes).substr(0, length)));
  const auto is_refused = [&](auto change) {
    StoredProblem wrong = stored;
    change(wrong.problem);
    return !problem_from(bytes_of(wrong));
  };
  CHECK(is_refused([](ContactProblem& p) { p.constraints[0].a = static_cast<std::int32_t>(p.bodies.size()) + 1; }));
  CHECK(is_refused([](ContactProblem& p) { p.constraints[0].count = kLanes + 1; }));
  CHECK(is_refused([](ContactProblem& p) { p.constraint_pair[0] = static_cast<std::uint32_t>(p.pairs.size()); }));
  CHECK(is_refused([](ContactProblem& p) { p.velocity.pop_back(); }));
  CHECK(is_refused([](ContactProblem& p) { p.pairs.emplace_back(0, 1000); }));
}

}  // namespace problem_bytes_test
