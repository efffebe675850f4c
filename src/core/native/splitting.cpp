#include "core/native/splitting.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/contact_kernels.hpp"

namespace holdfast::native {

namespace {

/// Share of the disc's radius from which a contact counts as sliding.
constexpr double kSlidingShare = 0.999;

/// R of the iterations beyond the cap over that of those before: slower, but steadier where load moves to and fro.
constexpr double kLateShare = 0.3;

/// Iterations before a solve may stop: the first only meets the start values.
constexpr int kLeastIterations = 2;

/// The ratio rounded up to a power of 4, at least 1: scaling all masses by a power of 2 then scales R exactly.
double step_up(double ratio) {
  double power = 1.0;
  while (power < ratio) power *= 4.0;
  return power;
}

}  // namespace

bool Splitting::choose_resistance(double sticking, double sliding) {
  // A point carries at most the whole island on a patch's four: what is more is a blow's impulse, not mass.
  double heaviest = 0.0;
  for (const SolverBody& body : bodies) heaviest += body.mass;
  heaviest /= static_cast<double>(kLanes);
  bool changed = false;
  for (Patch& patch : patches) {
    const double unit = patch.base * load_unit;
    const double most = heaviest / patch.base;
    for (std::size_t i = 0; i < static_cast<std::size_t>(patch.count); ++i) {
      const double normal = patch.impulse.row[0][i];
      const double carried = patch.base * step_up(std::min(most, std::max(normal, patch.load[i]) / unit));
      double rn = patch.base;
      double rt = patch.base;
      if (normal > 0.0 || (begun_ && patch.load[i] > 0.0)) {
        const double limit = kSlidingShare * patch.friction * normal;
        const double tangential =
            patch.impulse.row[1][i] * patch.impulse.row[1][i] + patch.impulse.row[2][i] * patch.impulse.row[2][i];
        rn = sticking * carried;
        rt = (normal > 0.0 && tangential >= limit * limit ? sliding : sticking) * carried;
      }
      changed = changed || patch.resistance[0][i] != rn || patch.resistance[1][i] != rt;
      patch.resistance[0][i] = rn;
      patch.resistance[1][i] = rt;
      patch.compliance[0][i] = 1.0 / rn;
      patch.compliance[1][i] = 1.0 / rt;
    }
  }
  return changed;
}

void Splitting::assemble() {
  factor.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyBlock& block = factor.diagonal(i);
    for (int k = 0; k < 3; ++k) {
      block.column[k][k] = bodies[i].mass;
      for (int row = 0; row < 3; ++row) block.column[3 + k][3 + row] = bodies[i].inertia(row, k);
    }
  }
  factor.add(patches, mid_arms, patch_pair);
  factor.factorise();
}

void Splitting::residual_force() {
  change_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double* v = velocity[i].row;
    const double* free = free_velocity[i].row;
    const LaneWrench& w = wrench_[i];
    const auto total = [&](std::size_t row) {
      const double* lane = w.row[row];
      return (lane[0] + lane[1]) + (lane[2] + lane[3]);
    };
    const Vec3 turn(free[3] - v[3], free[4] - v[4], free[5] - v[5]);
    const Vec3 angular = bodies[i].inertia * turn;
    for (std::size_t k = 0; k < 3; ++k) {
      change_[i].row[k] = bodies[i].mass * (free[k] - v[k]) + total(k);
      change_[i].row[3 + k] = angular[static_cast<Eigen::Index>(k)] + total(3 + k);
    }
  }
}

SplittingResult Splitting::solve(const SplittingOptions& options, double velocity_unit) {
  const double tolerance = options.tolerance * velocity_unit;
  SplittingResult result;
  u_.resize(patches.size());
  g_.resize(patches.size());
  r_.resize(patches.size());
  const double bad = options.bad_residual * velocity_unit;
  const int most = options.iterations + options.more_iterations;
  while (!result.converged &&
         (result.iterations < options.iterations || (result.iterations < most && result.residual > bad))) {
    const int late = result.iterations - options.iterations;
    const double share = late >= 0 ? kLateShare : 1.0;
    const bool due =
        (begun_ || !options.keep_resistance) && (late >= 0 ? late : result.iterations) % options.reclassify_every == 0;
    if (due && (choose_resistance(share * options.sticking, share * options.sliding) || begun_)) {
      begun_ = false;
      assemble();
      anderson_.restart();
    }
    wrench_.assign(bodies.size() + 1, LaneWrench{});
    const double mismatch = aim(patches, velocity, options.relaxation, u_, g_, r_);
    if (options.accelerate) anderson_.accelerate(patches, g_, r_);
    project(patches, mid_arms, g_, u_, wrench_);
    residual_force();
    factor.solve(change_);
    double largest_change = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      double linear = 0.0, angular = 0.0;
      for (int k = 0; k < 3; ++k) {
        velocity[i].row[k] += change_[i].row[k];
        velocity[i].row[3 + k] += change_[i].row[3 + k];
        linear += change_[i].row[k] * change_[i].row[k];
        angular += change_[i].row[3 + k] * change_[i].row[3 + k];
      }
      const double change = std::sqrt(linear) + bodies[i].radius * std::sqrt(angular);
      // Not std::max, which would lose what is not a number.
      if (!(change <= largest_change)) largest_change = change;
    }
    ++result.iterations;
    result.residual = mismatch > largest_change ? mismatch : largest_change;
    result.converged = result.iterations >= kLeastIterations && result.residual <= tolerance;
  }
  return result;
}

void Splitting::restart(std::span<const BodyVector> start) {
  std::copy(start.begin(), start.end(), velocity.begin());
  mid_arms.clear();
  begin();
  for (Patch& patch : patches) {
    patch.impulse = PatchVector{};
    patch.slip = PatchVector{};
    patch.load = Lanes{};
  }
}

double Splitting::imbalance_at_rest(double velocity_unit) {
  wrench_.assign(bodies.size() + 1, LaneWrench{});
  add_impulses(patches, mid_arms, wrench_);
  double worst = 0.0;
  std::fill(velocity.begin(), velocity.end(), BodyVector{});
  residual_force();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double* f = change_[i].row;
    const double force = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    const double torque = std::sqrt(f[3] * f[3] + f[4] * f[4] + f[5] * f[5]);
    worst = std::max(worst, std::max(force, torque / bodies[i].radius) / (bodies[i].mass * velocity_unit));
  }
  return worst;
}

}  // namespace holdfast::native
