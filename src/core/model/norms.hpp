#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/push_direction.hpp"

namespace holdfast::internal {

/// The side of the container towards which an acceleration presses the load: braking presses it towards the front. The
/// order is that of `kMarginDirections`.
enum class LoadDirection { front, rear, left, right };

/// One acceleration of a norm.
struct NormAcceleration {
  LoadDirection direction = LoadDirection::front;
  double size = 0.0;              ///< along the floor, g; 1 in a norm whose size is K
  double weight_share = 1.0;      ///< c_z: what is left of the load's weight meanwhile, as a share
  std::string_view purpose = "";  ///< "sliding" or "tipping", where the norm states it for that alone
};

/// How an acceleration goes over time: it grows evenly, in short constant pieces, and is then held.
struct NormProfile {
  double rise = 0.0;  ///< s
  double hold = 1.0;  ///< s
};

/// A norm for cargo securing: its accelerations, and where its numbers are from.
struct Norm {
  std::string_view name;
  std::span<const NormAcceleration> accelerations;
  std::string_view source;
  NormProfile profile = {};
  bool takes_size = false;  ///< the user gives the size K of all accelerations, as `name:K`
};

/// All norms, in the order of the documentation.
std::span<const Norm> norms();

/// Least and largest K of a norm that takes one, g.
inline constexpr double kLeastNormSize = 0.01, kLargestNormSize = 2.0;

/// The accelerations of a norm in words: "front 0.8 g, rear 0.5 g, ...".
/// @param size what to write for K
std::string numbers_of(const Norm& norm, std::string_view size = "K");

/// A norm as a user chose it.
struct ChosenNorm {
  const Norm* norm = nullptr;
  std::optional<double> size;  ///< K, g, of a norm that takes one

  /// As the user writes it: `road`, `eumos-40509:0.5`. Equal choices have equal names.
  std::string name() const;
  /// Its accelerations in words.
  std::string numbers() const;
  /// What it asks of a margin in each direction of `kMarginDirections`, g: its largest size there among the
  /// accelerations that leave the load its full weight; 0 where there is none.
  std::array<double, kDirectionCount> needed_margins() const;
  /// Its accelerations, with names such as `road-front-0g8` and without a hash.
  std::vector<Acceleration> accelerations() const;
};

/// The names that `find_norm` knows, for messages.
std::string norm_names();

/// The norm of that name, with its K where it takes one; or an error that says what is accepted, and what was
/// probably meant.
Result<ChosenNorm> find_norm(std::string_view name);

}  // namespace holdfast::internal
