#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace holdfast::internal {

/// Two materials and the coefficient of static friction between them.
struct FrictionPair {
  std::string_view name;       ///< as a key takes it, such as `cardboard-pallet`
  std::string_view materials;  ///< in words
  double dry = 0.0;
  std::optional<double> wet;  ///< absent where the source has none
  bool same = false;          ///< both sides are of the same material
};

/// Coefficients above this are mistakes, such as percents.
inline constexpr double kLargestFriction = 10.0;

/// Where the coefficients are from.
inline constexpr std::string_view kFrictionSource = "CTU Code 2014, Annex 7, Appendix 2";

/// All pairs, in the order of the source.
std::span<const FrictionPair> friction_pairs();

/// The coefficient that a name stands for: `cardboard-pallet`, or `timber-steel-wet` where the source has a wet one.
std::optional<double> friction_of_pair_name(std::string_view name);

/// One factor of a product of two: the square root of the coefficient, for a pair of the same material alone. With two
/// different materials the factor of one side is not known.
std::optional<double> friction_factor_of_name(std::string_view name);

}  // namespace holdfast::internal
