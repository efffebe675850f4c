#include "core/native/solver/anderson.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

namespace {

/// The longest pause, longer than any solve: doubled for ever it would overflow.
constexpr int kLongestPause = 1 << 20;

/// A direction is used where this share of its square is independent of the others.
constexpr double kIndependent = 1e-8;

}  // namespace

void Anderson::restart() {
  has_last_ = false;
  pause_ = 0;
  next_pause_ = kAndersonPause;
}

void Anderson::accelerate(std::span<const ContactConstraint> constraints, double largest_impulse,
                          std::vector<ConstraintVector>& g, const std::vector<ConstraintVector>& r) {
  double square = 0.0;
  dot(constraints, r, std::array{r.data()}, std::span(&square, 1));
  const bool known = has_last_ && last_g_.size() == g.size();
  if (!known || square > kAndersonGrowth * last_square_) {
    stored_ = next_ = 0;
    if (known) {
      pause_ = next_pause_;
      next_pause_ = std::min(2 * next_pause_, kLongestPause);
    }
  } else {
    const std::size_t column = next_;
    g_step_[column].resize(g.size());
    r_step_[column].resize(g.size());
    take_difference(g, last_g_, g_step_[column]);
    take_difference(r, last_r_, r_step_[column]);
    stored_ = std::min(stored_ + 1, kAndersonDepth);
    next_ = (next_ + 1) % kAndersonDepth;
    along_steps(constraints, r_step_[column], gram_[column]);
    for (std::size_t i = 0; i < stored_; ++i) gram_[i][column] = gram_[column][i];
  }
  if (stored_ == 0) {
    last_g_ = g;
    last_r_ = r;
  }
  has_last_ = true;
  last_square_ = square;
  along_steps(constraints, r, along_);
  if (pause_ > 0) {
    --pause_;
    return;
  }
  if (stored_ == 0) return;
  double weight[kAndersonDepth];
  weigh(weight);
  subtract(std::span(g_step_).first(stored_), std::span(weight).first(stored_), g);
  // The residual hardly sees impulses that press bodies against each other and move none.
  const auto is_beyond = [&](const ConstraintVector& x) {
    return std::any_of(x.row[0].begin(), x.row[0].end(), [&](double normal) { return !(normal <= largest_impulse); });
  };
  if (std::any_of(g.begin(), g.end(), is_beyond)) g = last_g_;
}

/// The inner products of `r` with all of `r_step_`.
void Anderson::along_steps(std::span<const ContactConstraint> constraints, const std::vector<ConstraintVector>& r,
                           std::span<double, kAndersonDepth> out) const {
  std::array<const ConstraintVector*, kAndersonDepth> steps{};
  for (std::size_t i = 0; i < stored_; ++i) steps[i] = r_step_[i].data();
  dot(constraints, r, std::span(steps).first(stored_), out);
}

/// Solves gram · weight = along by L D Lᵀ; directions that depend on the others get no weight.
void Anderson::weigh(double (&weight)[kAndersonDepth]) const {
  double l[kAndersonDepth][kAndersonDepth] = {};
  double d[kAndersonDepth] = {};
  for (std::size_t j = 0; j < stored_; ++j) {
    d[j] = gram_[j][j];
    for (std::size_t k = 0; k < j; ++k) d[j] -= l[j][k] * l[j][k] * d[k];
    if (!(d[j] > kIndependent * gram_[j][j])) d[j] = 0.0;
    for (std::size_t i = j + 1; i < stored_; ++i) {
      double sum = gram_[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k] * d[k];
      l[i][j] = d[j] > 0.0 ? sum / d[j] : 0.0;
    }
  }
  for (std::size_t i = 0; i < stored_; ++i) {
    weight[i] = along_[i];
    for (std::size_t k = 0; k < i; ++k) weight[i] -= l[i][k] * weight[k];
  }
  for (std::size_t i = 0; i < stored_; ++i) weight[i] = d[i] > 0.0 ? weight[i] / d[i] : 0.0;
  for (std::size_t i = stored_; i-- > 0;)
    for (std::size_t k = i + 1; k < stored_; ++k) weight[i] -= d[i] > 0.0 ? l[k][i] * weight[k] : 0.0;
}

}  // namespace holdfast::internal::native
