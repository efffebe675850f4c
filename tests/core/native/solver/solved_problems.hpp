#pragma once

#include <memory>
#include <vector>

#include "core/native/native_world.hpp"
#include "core/native/solver/body_kernels.hpp"
#include "core/native/solver/contact_kernels.hpp"
#include "core/native/solver/problem_bytes.hpp"
#include "scenes.hpp"

namespace holdfast::internal::native {

/// A problem of a world, and what the world's solver made of it.
struct SolvedProblem {
  StoredProblem given;
  ContactProblem solved;
  SolveResult result;
};

/// As `find_missing_momentum`.
inline std::vector<BodyVector> missing_momentum(const ContactProblem& problem) {
  std::vector<LaneWrench> wrench;
  std::vector<BodyVector> missing;
  find_missing_momentum(problem, wrench, missing);
  return missing;
}

/// Keeps the problems that it is given, and has the engine's solver solve them. Those that go on from the solve before
/// are left out.
class KeepingSolver final : public ContactSolver {
 public:
  explicit KeepingSolver(std::vector<SolvedProblem>& kept) : kept_(kept) {}

  std::span<const std::uint32_t> order(std::size_t count, std::span<const BodyPair> pairs) override {
    return solver_->order(count, pairs);
  }

  SolveResult solve(ContactProblem& problem, const SolveLimits& limits) override {
    if (problem.continues) return solver_->solve(problem, limits);
    SolvedProblem& kept = kept_.emplace_back(SolvedProblem{{problem, limits}, {}, {}});
    kept.result = solver_->solve(problem, limits);
    kept.solved = problem;
    return kept.result;
  }

 private:
  std::vector<SolvedProblem>& kept_;
  std::unique_ptr<ContactSolver> solver_ = make_contact_solver();
};

/// The problems of a stack of boxes that leans, slides and comes back.
inline std::vector<SolvedProblem> problems_of_a_stack() {
  const Settings settings;
  const Layout layout = scenes::stack(6, {2, 1, 0}, {0.6, 0.5, 0.3});
  const Acceleration acceleration = scenes::acceleration_of({{0.1, Vec3(4, 6, 0)}, {0.1, Vec3(-3, 0, 1)}});
  const Acceleration* const accelerations[] = {&acceleration};
  const WorldBatch batch = scenes::batch_of(std::span(&layout, 1), accelerations, settings);
  std::vector<SolvedProblem> problems;
  const NativeOptions options = native_options(settings);
  NativeWorld world(batch, batch.worlds.front(), settings, options,
                    std::make_unique<WorldMemory>(options, std::make_unique<KeepingSolver>(problems)));
  for (const Phase& phase : phases_of(acceleration, 0.2))
    while (world.advance(phase) < phase.end) continue;
  return problems;
}

}  // namespace holdfast::internal::native
