#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace holdfast::peers {

// Plain types only: the source files of an adapter are compiled with its peer's flags, and share nothing else with
// ours.

using Vector = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  ///< w, x, y, z

/// Where a box is and how it moves, in the container's frame.
struct Motion {
  Vector position{};  ///< of the centre of mass, m
  Quaternion container_from_body{1.0, 0.0, 0.0, 0.0};
  Vector velocity{};          ///< of the centre of mass, m/s
  Vector angular_velocity{};  ///< rad/s
};

/// A box of the load or a side of the container.
struct Body {
  Motion start;
  Vector half_extents{};    ///< m
  Vector centroid{};        ///< from the centre of mass, body axes, m
  double mass = 0.0;        ///< kg; 0: fixed
  Vector inertia{};         ///< principal moments about the centre of mass, body axes, kg m²
  std::size_t surface = 0;  ///< index into `FrictionTable`
};

/// The coefficient of friction of every pair of surfaces. Rebound is 0 everywhere.
struct FrictionTable {
  std::size_t surfaces = 0;
  std::vector<double> coefficients;  ///< surfaces × surfaces

  double of(std::size_t a, std::size_t b) const { return coefficients[a * surfaces + b]; }
};

/// A loaded container: what a peer gets.
struct Scene {
  std::vector<Body> boxes;
  std::vector<Body> sides;  ///< of the container; fixed
  FrictionTable friction;
};

/// A world inside a peer. One thread uses all worlds of the program.
class PeerWorld {
 public:
  PeerWorld() = default;
  PeerWorld(const PeerWorld&) = delete;
  PeerWorld& operator=(const PeerWorld&) = delete;
  virtual ~PeerWorld() = default;

  /// Sets the effective gravity g − a of all boxes, m/s², and wakes them.
  virtual void set_gravity(const Vector& gravity) = 0;

  /// Takes a step of that length, s. False when the peer has left contacts out for want of memory.
  virtual bool step(double seconds) = 0;

  /// Writes the motion of every box.
  virtual void read(std::span<Motion> motions) const = 0;
};

}  // namespace holdfast::peers
