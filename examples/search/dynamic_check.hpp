#pragma once

#include <functional>
#include <holdfast/holdfast.hpp>
#include <span>
#include <string>
#include <vector>

#include "decoder.hpp"

/// What becomes of a loading.
struct Stability {
  bool holds = false;  ///< every box stays under every acceleration
  int boxes_out_of_place =
      0;  ///< how many fall, move, tilt or are unstable under the first acceleration that it does not hold
};

/// Asks holdfast which loadings hold.
class DynamicCheck {
 public:
  /// Throws holdfast::Error.
  /// @param accelerations paths of files
  /// @param threads 0: one per core
  DynamicCheck(const Instance& instance, const std::vector<std::string>& accelerations, int threads);

  /// Is called with every loading that is checked, and its number from 1; nothing at first.
  std::function<void(const Loading&, std::size_t)> on_loading;

  /// One answer per loading, in their order.
  std::vector<Stability> check(std::span<const Loading> loadings);

  std::size_t checked() const { return checked_; }     ///< number of loadings so far
  std::size_t held() const { return held_; }           ///< how many of these held
  double cpu_seconds() const { return cpu_seconds_; }  ///< processor time of all simulations so far

 private:
  holdfast::Layout layout_of(const Loading& loading) const;

  std::vector<BoxType> types_;
  holdfast::Screen screen_;
  std::size_t checked_ = 0, held_ = 0;
  double cpu_seconds_ = 0;
};
