#pragma once

#include <memory>

#include "peer_world.hpp"

namespace holdfast::peers {

/// How Box3D steps a world; what is not named here is as it is delivered.
struct Box3dOptions {
  double steps_per_second = 60.0;  ///< 1/s
  int substeps = 4;
  bool stiff = false;     ///< contacts as stiff as the rate of substeps allows: an eighth of it, instead of 30 Hz
  bool sleeping = false;  ///< boxes at rest sleep until the acceleration changes or something touches them
};

/// How Jolt steps a world; what is not named here is as it is delivered.
struct JoltOptions {
  double steps_per_second = 60.0;  ///< 1/s
  int velocity_iterations = 10;
  int position_iterations = 2;
  bool precise = false;   ///< boxes may sink into each other by 0.1 mm, instead of 20 mm
  bool sleeping = false;  ///< as above
};

// A world of a peer. The scene must outlive it. Each is there where the sources of its peer were given.
std::unique_ptr<PeerWorld> make_box3d_world(const Scene& scene, const Box3dOptions& options);
std::unique_ptr<PeerWorld> make_jolt_world(const Scene& scene, const JoltOptions& options);

}  // namespace holdfast::peers
