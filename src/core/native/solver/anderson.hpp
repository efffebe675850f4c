#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/native/constants.hpp"
#include "core/native/solver/contact_constraint.hpp"

namespace holdfast::internal::native {

/// Anderson acceleration of a fixed-point iteration x ← g(x) (Anderson 1965; Walker and Ni 2011, type II): the next
/// x mixes the last few g such that the residuals r = g − x that go with them cancel best. The iteration of hard
/// contacts has a few slow directions, force that moves from contact to contact; these are what it removes.
class Anderson {
 public:
  /// Drops all iterates: the map is a new one.
  void restart();

  /// The next x, in place of `g`.
  /// @param constraints     give the weights 1/R of the inner product
  /// @param largest_impulse of a point along its normal, up to which g is accelerated, N s
  /// @param r               residual that goes with `g`
  void accelerate(std::span<const ContactConstraint> constraints, double largest_impulse,
                  std::vector<ConstraintVector>& g, const std::vector<ConstraintVector>& r);

 private:
  void along_steps(std::span<const ContactConstraint> constraints, const std::vector<ConstraintVector>& r,
                   std::span<double, kAndersonDepth> out) const;
  void weigh(double (&weight)[kAndersonDepth]) const;

  int pause_ = 0;           ///< iterations until it acts again
  int next_pause_ = 0;      ///< the same of the next pause
  std::size_t stored_ = 0;  ///< differences that are kept
  std::size_t next_ = 0;    ///< the column that is written next
  double last_square_ = 0.0;
  std::vector<ConstraintVector> last_g_, last_r_;
  std::array<std::vector<ConstraintVector>, kAndersonDepth> g_step_, r_step_;  ///< differences of neighbouring iterates
  double gram_[kAndersonDepth][kAndersonDepth] = {};                           ///< inner products of r_step_
  double along_[kAndersonDepth] = {};                                          ///< of r with r_step_
  bool has_last_ = false;
};

}  // namespace holdfast::internal::native
