#include "core/native/splitting.hpp"

#include <algorithm>
#include <cmath>

namespace holdfast::native {

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

Vec3 arm(const std::array<Lanes, 3>& arms, std::size_t lane) { return {arms[0][lane], arms[1][lane], arms[2][lane]}; }

Mat3 cross_matrix(const Vec3& r) {
  Mat3 m;
  m << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  return m;
}

/// Adds a 3×3 part to a block.
void add(BodyBlock& block, int row, int column, const Mat3& part) {
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) block.column[column + c][row + r] += part(r, c);
}

/// Σ over a patch's points of Gᵢ R Gⱼᵀ, where G maps a force at the point to a wrench; see `Splitting::add_patch`.
struct PatchBlocks {
  Mat3 linear = Mat3::Zero();                                    ///< force from linear velocity
  Mat3 turning_a = Mat3::Zero(), turning_b = Mat3::Zero();       ///< torque from linear velocity
  Mat3 aa = Mat3::Zero(), bb = Mat3::Zero(), ab = Mat3::Zero();  ///< torque from angular velocity
};

PatchBlocks blocks_of(const Patch& patch, const Arms& arms) {
  PatchBlocks sum;
  const Vec3 n(patch.directions[0][0], patch.directions[0][1], patch.directions[0][2]);
  double tangential = 0.0;
  double extra = 0.0;
  Vec3 arm_a = Vec3::Zero(), arm_b = Vec3::Zero(), moment_a = Vec3::Zero(), moment_b = Vec3::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(patch.count); ++i) {
    // R = r_t I + (r_n − r_t) n nᵀ
    const double rt = patch.resistance[1][i];
    const double rd = patch.resistance[0][i] - rt;
    const Vec3 a = arm(arms.a, i);
    const Vec3 b = arm(arms.b, i);
    const Vec3 na = a.cross(n);
    const Vec3 nb = b.cross(n);
    tangential += rt;
    extra += rd;
    arm_a += rt * a;
    arm_b += rt * b;
    moment_a += rd * na;
    moment_b += rd * nb;
    // [p]ₓ [q]ₓᵀ = (p · q) I − q pᵀ
    sum.aa += rd * na * na.transpose() - rt * a * a.transpose();
    sum.bb += rd * nb * nb.transpose() - rt * b * b.transpose();
    sum.ab += rd * na * nb.transpose() - rt * b * a.transpose();
    sum.aa.diagonal().array() += rt * a.squaredNorm();
    sum.bb.diagonal().array() += rt * b.squaredNorm();
    sum.ab.diagonal().array() += rt * a.dot(b);
  }
  sum.linear = extra * n * n.transpose();
  sum.linear.diagonal().array() += tangential;
  sum.turning_a = cross_matrix(arm_a) + moment_a * n.transpose();
  sum.turning_b = cross_matrix(arm_b) + moment_b * n.transpose();
  return sum;
}

}  // namespace

bool Splitting::choose_resistance(const SplittingOptions& options, bool first) {
  bool changed = false;
  for (Patch& patch : patches) {
    const double unit = patch.base * load_unit;
    for (std::size_t i = 0; i < static_cast<std::size_t>(patch.count); ++i) {
      const double normal = patch.impulse.row[0][i];
      const double carried = patch.base * step_up(std::max(normal, patch.load[i]) / unit);
      double rn = patch.base;
      double rt = patch.base;
      if (normal > 0.0 || (first && patch.load[i] > 0.0)) {
        const double limit = kSlidingShare * patch.friction * normal;
        const double tangential =
            patch.impulse.row[1][i] * patch.impulse.row[1][i] + patch.impulse.row[2][i] * patch.impulse.row[2][i];
        rn = options.sticking * carried;
        rt = (normal > 0.0 && tangential >= limit * limit ? options.sliding : options.sticking) * carried;
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
    for (int k = 0; k < 3; ++k) block.column[k][k] = bodies[i].mass;
    add(block, 3, 3, bodies[i].inertia);
  }
  for (std::size_t p = 0; p < patches.size(); ++p) add_patch(p);
  factor.factorise();
}

void Splitting::add_patch(std::size_t p) {
  const Patch& patch = patches[p];
  const PatchBlocks sum = blocks_of(patch, mid_arms.empty() ? patch.arms : mid_arms[p]);
  const auto fixed = static_cast<std::int32_t>(bodies.size());
  const auto add_own = [&](std::int32_t body, const Mat3& turning, const Mat3& angular) {
    if (body == fixed) return;
    BodyBlock& block = factor.diagonal(static_cast<std::size_t>(body));
    add(block, 0, 0, sum.linear);
    add(block, 3, 0, turning);
    add(block, 0, 3, turning.transpose());
    add(block, 3, 3, angular);
  };
  add_own(patch.a, sum.turning_a, sum.aa);
  add_own(patch.b, sum.turning_b, sum.bb);
  if (patch_pair[p] == kNoPair) return;
  BodyBlock& block = factor.below(patch_pair[p]);
  const bool a_is_row = patch.a > patch.b;
  add(block, 0, 0, -sum.linear);
  add(block, 3, 0, -(a_is_row ? sum.turning_a : sum.turning_b));
  add(block, 0, 3, -(a_is_row ? sum.turning_b : sum.turning_a).transpose());
  add(block, 3, 3, a_is_row ? Mat3(-sum.ab) : Mat3(-sum.ab.transpose()));
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
  anderson_.restart();
  const double bad = options.bad_residual * velocity_unit;
  const int most = options.iterations + options.more_iterations;
  while (!result.converged &&
         (result.iterations < options.iterations || (result.iterations < most && result.residual > bad))) {
    const bool first = result.iterations == 0;
    if (result.iterations % options.reclassify_every == 0 && (choose_resistance(options, first) || first)) {
      assemble();
      anderson_.restart();
    }
    wrench_.assign(bodies.size() + 1, LaneWrench{});
    const double mismatch = aim(patches, velocity, options.relaxation, u_, g_, r_);
    if (options.accelerate || result.iterations >= options.iterations) anderson_.accelerate(patches, g_, r_);
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
