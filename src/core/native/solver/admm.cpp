#include "core/native/solver/admm.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

namespace {

/// Share of the disc's radius from which a contact counts as sliding.
constexpr double kSlidingShare = 0.999;

/// Iterations before a solve may stop: the first only meets the start values.
constexpr int kLeastIterations = 2;

/// The ratio rounded up to a power of 4, at least 1: scaling all masses by a power of 2 then scales R exactly.
double step_up(double ratio) {
  double power = 1.0;
  while (power < ratio) power *= 4.0;
  return power;
}

}  // namespace

Splitting::Resistance Splitting::wanted_resistance(const Patch& patch, std::size_t lane,
                                                   const SplittingOptions& options) const {
  const double normal = patch.impulse.row[0][lane];
  // Without friction nothing holds along the tangents: R would, until the solve has come to its end.
  const double held = patch.friction > 0.0 ? 1.0 : 0.0;
  if (normal <= 0.0 && (!begun_ || patch.load[lane] <= 0.0)) {
    const double ready = options.ready * patch.base;
    return {options.sticking * ready, held * options.sliding * ready};
  }
  const double load = std::max(normal, patch.load[lane]) / (patch.base * load_unit);
  const double carried = patch.base * step_up(std::min(heaviest_ / patch.base, load));
  const double limit = kSlidingShare * patch.friction * normal;
  const double tangential =
      patch.impulse.row[1][lane] * patch.impulse.row[1][lane] + patch.impulse.row[2][lane] * patch.impulse.row[2][lane];
  const bool slides = normal > 0.0 && tangential >= limit * limit;
  return {options.sticking * carried, held * (slides ? options.sliding : options.sticking) * carried};
}

/// Fits R to the loads that there are. False where it stays, because few points call for another: they are not worth
/// a factorisation.
bool Splitting::choose_resistance(const SplittingOptions& options) {
  // A point carries at most the whole island on a patch's four: what is more is a blow's impulse, not mass.
  heaviest_ = 0.0;
  for (const SolverBody& body : bodies) heaviest_ += body.mass;
  heaviest_ /= static_cast<double>(kLanes);
  const auto for_each_point = [&](auto&& visit) {
    for (Patch& patch : patches)
      for (std::size_t i = 0; i < static_cast<std::size_t>(patch.count); ++i)
        visit(patch, i, wanted_resistance(patch, i, options));
  };
  if (!begun_) {
    std::size_t points = 0;
    std::size_t others = 0;
    for_each_point([&](const Patch& patch, std::size_t i, const Resistance& wanted) {
      ++points;
      if (wanted.normal != patch.resistance[0][i] || wanted.tangential != patch.resistance[1][i]) ++others;
    });
    if (static_cast<double>(others) <= options.refit_share * static_cast<double>(points)) return false;
  }
  for_each_point([](Patch& patch, std::size_t i, const Resistance& wanted) {
    patch.resistance[0][i] = wanted.normal;
    patch.resistance[1][i] = wanted.tangential;
    patch.compliance[0][i] = 1.0 / wanted.normal;
    patch.compliance[1][i] = wanted.tangential > 0.0 ? 1.0 / wanted.tangential : 0.0;
  });
  begun_ = false;
  return true;
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

void Splitting::residual_force(bool at_rest) {
  change_.resize(bodies.size());
  const BodyVector rest;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double* v = (at_rest ? rest : velocity[i]).row;
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
  std::size_t points = 0;
  for (const Patch& patch : patches) points += static_cast<std::size_t>(patch.count);
  Mismatch mismatch;
  const auto may_pass = [&] {
    const double mean = options.mean_residual * velocity_unit;
    return mismatch.squares <= mean * mean * static_cast<double>(points) &&
           result.residual <= options.worst_residual * velocity_unit;
  };
  const int most = options.iterations + options.more_iterations;
  while (!result.converged && result.iterations < (may_pass() ? options.iterations : most)) {
    if (result.iterations % options.refit_every == 0 && choose_resistance(options)) {
      assemble();
      anderson_.restart();
    }
    wrench_.assign(bodies.size() + 1, LaneWrench{});
    mismatch = aim(patches, velocity, options.relaxation, u_, g_, r_);
    if (options.accelerate) anderson_.accelerate(patches, g_, r_);
    project(options.projection, patches, mid_arms, g_, u_, most_normal, wrench_);
    residual_force(false);
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
    result.residual = mismatch.largest > largest_change ? mismatch.largest : largest_change;
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

double Splitting::speed(std::size_t place) const {
  const double* v = velocity[place].row;
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) +
         bodies[place].radius * std::sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
}

double Splitting::largest_speed() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) largest = std::max(largest, speed(i));
  return largest;
}

bool Splitting::refutes_rest(double most) {
  const double fastest = largest_speed();
  // Every motion may be the proof: without those that hardly move it is one sooner.
  for (const double share : {0.0, 0.01, 0.1, 0.5}) {
    motion_ = velocity;
    double power = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (speed(i) < share * fastest) motion_[i] = BodyVector{};
      for (int k = 0; k < 3; ++k) power += bodies[i].mass * motion_[i].row[k] * free_velocity[i].row[k];
    }
    if (power > supported_power(motion_, most)) return true;
  }
  return false;
}

double Splitting::supported_power(std::span<const BodyVector> motion, double most) {
  aim(patches, motion, 1.0, u_, g_, r_);
  double power = 0.0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(patches[p].count); ++i) {
      const auto& u = u_[p].row;
      const double slip = std::sqrt(u[1][i] * u[1][i] + u[2][i] * u[2][i]);
      power += std::min(most, most_normal[p].lane[i]) * std::max(0.0, patches[p].friction * slip - u[0][i]);
    }
  }
  return power;
}

double Splitting::imbalance_at_rest(double velocity_unit) {
  wrench_.assign(bodies.size() + 1, LaneWrench{});
  add_impulses(patches, mid_arms, wrench_);
  double worst = 0.0;
  residual_force(true);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double* f = change_[i].row;
    const double force = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    const double torque = std::sqrt(f[3] * f[3] + f[4] * f[4] + f[5] * f[5]);
    worst = std::max(worst, std::max(force, torque / bodies[i].radius) / (bodies[i].mass * velocity_unit));
  }
  return worst;
}

}  // namespace holdfast::internal::native
