#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "free_spaces.hpp"
#include "instance.hpp"

/// A box in its place.
struct PlacedBox {
  Cuboid place;
  int type = 0;  ///< index into `Instance::types`

  bool operator<(const PlacedBox& other) const { return std::tie(place, type) < std::tie(other.place, other.type); }
};

/// A loaded container.
struct Loading {
  std::vector<PlacedBox> boxes;
  double fill = 0;  ///< volume of the boxes, as a share of the container's
};

/// Makes loadings of an instance from random keys: blocks of equal boxes are put into the corners of free spaces, one
/// after the other, in an order and in ways that the keys say (after Goncalves and Resende, Computers & Operations
/// Research 39, 2012).
class Decoder {
 public:
  explicit Decoder(Instance instance);

  const Instance& instance() const { return instance_; }

  /// Two per box: one for the order in which types of boxes have their turn, one for how the block stands.
  std::size_t key_count() const { return 2 * turns_.size(); }

  /// The loading that keys in [0, 1) stand for. Boxes do not overlap, are inside, and are each supported from below by
  /// `kLeastSupport` of their base. May be called from any thread.
  Loading decode(std::span<const double> keys) const;

  /// Share of a box's base that stands on the floor or on boxes. A box with three quarters of its base supported stands
  /// by itself, and a container is fuller than with full support.
  static constexpr double kLeastSupport = 0.75;

 private:
  Instance instance_;
  std::vector<int> turns_;                          ///< type of each box
  std::vector<std::vector<Extents>> orientations_;  ///< per type: extents along x, y and z that it may have
  int smallest_edge_ = 0;
};
