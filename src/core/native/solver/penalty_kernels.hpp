#pragma once

#include <span>

#include "core/native/solver/contact_constraint.hpp"

// The inner loops that fit the penalty R of the splitting to what contacts carry.

namespace holdfast::internal::native {

/// How R is fitted: in proportion to the mass that a point carries, by its impulse, rounded up to a power of 4 times
/// the contact's effective mass. Scaling all masses by a power of 2 then scales R exactly.
struct PenaltyFit {
  double sticking = 0.0;          ///< R over the carried mass, where it sticks and along the normal
  double sliding = 0.0;           ///< the same along the tangents where it slides
  double idle = 0.0;              ///< mass that a point without impulse counts as carrying, over its effective mass
  double heaviest = 0.0;          ///< most mass that a point can carry, kg
  double impulse_per_mass = 0.0;  ///< impulse that a kilogram brings to bear, m/s
  bool continues = false;         ///< impulses are those of an iteration: none is expected where there is none
};

/// How many points call for another R than they have.
double count_misfits(const PenaltyFit& fit, std::span<const ContactConstraint> constraints);

/// Fits R, and sets its inverse.
void fit_penalty(const PenaltyFit& fit, std::span<ContactConstraint> constraints);

}  // namespace holdfast::internal::native
