#pragma once

#include <cstddef>

#include "core/model/settings.hpp"

namespace holdfast::internal::native {

/// Islands of more bodies are crowds.
inline constexpr std::size_t kFewBodies = 8;

/// How hard the moving steps of an island are solved.
struct Effort {
  double tolerance = 1e-4;       ///< of a step's velocities, over |g − a| h
  double cold_tolerance = 1e-7;  ///< the same where the acceleration has just changed
  int iterations = 60;           ///< of a solve, at most, where what is left may pass
  int cold_iterations = 400;     ///< the same where the acceleration has just changed
  double mean_residual = 0.01;   ///< that may pass: root of the mean square over the points, over |g − a| h
  int impact_cuts = 8;           ///< times that impacts may cut a step
  double impact_length = 2e-4;   ///< impacts that move a body less than this within a step are not located, m
  int stop_cuts = 2;             ///< times that the end of a slip may cut a step
  double overlap = 1e-5;         ///< from which positions are corrected, m
  double late_overlap = 0.0;     ///< that bodies may end a step with before they are solved as in contact, m
};

/// Everything the native engine can be told, every choice made: the accuracy's set, and the keys that override it.
struct NativeOptions {
  double steps_per_second = 240.0;  ///< 1/s
  Effort few;                       ///< for islands of at most `kFewBodies`
  Effort crowd{.iterations = 30};   ///< for larger ones
  double rest_tolerance = 1e-8;     ///< imbalance of a body that counts as none, over its weight |g − a| m
  int rest_iterations = 3000;       ///< of a proof of rest, at most
  double deep_overlap = 2e-4;       ///< that bodies meet with unseen and still go on, instead of in half the step, m
  bool jump = true;                 ///< go to the end of the phase when all is at rest
  bool freeze = true;               ///< leave islands at rest alone until something touches them

  const Effort& effort(std::size_t bodies) const { return bodies > kFewBodies ? crowd : few; }
};

NativeOptions native_options(const Settings& settings);

}  // namespace holdfast::internal::native
