#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/engine/recorder.hpp"
#include "core/model/damage.hpp"
#include "core/model/replica_verdict.hpp"
#include "core/model/wall_forces.hpp"

namespace holdfast::internal {

/// A vector and a quaternion as the results file stores them: float32, the latter as w, x, y, z.
struct Float3 {
  float x = 0, y = 0, z = 0;
};
struct Float4 {
  float w = 1, x = 0, y = 0, z = 0;
};

/// Sampled time series of one world, as float32 columns that the file stores unchanged. Container frame. Sample columns
/// have one entry per sample; row columns have one per sample and box: row = sample * box_count + box.
struct Series {
  std::vector<double> time;  ///< s
  std::vector<Float3>
      container_acceleration;  ///< m/s²; at a breakpoint the value before it, and the mean of a step where resampled
  std::vector<float> total_kinetic_energy;  ///< J
  std::vector<std::uint32_t> fallen_count;  ///< boxes lower than in the reference pose by more than the drop threshold
  /// Outward force on each side, mean over the step that the sample lies in, N; empty where not asked for.
  std::vector<std::array<float, kSideCount>> side_force;

  std::vector<Float3> displacement;         ///< of the centre of mass from the reference pose, m
  std::vector<Float4> orientation;          ///< container_from_body
  std::vector<Float3> angular_velocity;     ///< rad/s
  std::vector<Float3> linear_acceleration;  ///< mean over the step that the sample lies in, m/s²
  std::vector<Float3> force;                ///< external: −m a(t), N; zero in a free container
  std::vector<float> kinetic_energy;        ///< in the container's frame, J
};

/// Constant properties of a world's boxes as the file stores them, one entry per box.
struct BoxTable {
  std::vector<std::uint32_t> id;         ///< position among the boxes of the layout, from 1
  std::vector<std::int32_t> material;    ///< id of the layout file
  std::vector<float> mass;               ///< kg
  std::vector<Float3> size;              ///< m
  std::vector<Float3> initial_position;  ///< of the centre of mass in the layout's pose, m
};

/// End and peak values of the boxes of a world, one entry per box: everything that verdicts depend on. The end values
/// have the same bits as those of the last sample.
struct EndTable {
  std::vector<Float3> displacement;           ///< from the reference pose, m
  std::vector<float> tilt;                    ///< angle of the rotation from the reference pose, degrees
  std::vector<float> kinetic_energy;          ///< J
  std::vector<float> peak_displacement;       ///< largest length of the displacement, over all steps, m
  std::vector<float> peak_kinetic_energy;     ///< over all steps, J
  std::vector<Float3> settling_displacement;  ///< of the settled pose from the layout's pose, m
};

/// Everything that the results file contains of one world.
struct WorldRecord {
  std::uint64_t layout = 0;        ///< index of the layout in the run
  std::uint64_t acceleration = 0;  ///< index of the acceleration in the run
  Outcome outcome;
  std::string status_text;                 ///< a sentence where the status is not ok
  double cpu_seconds = 0.0;                ///< to build and simulate the world, s
  double peak_total_kinetic_energy = 0.0;  ///< over all steps, J
  std::uint64_t state_hash = 0;            ///< of the final state, see `state_hash`
  BoxTable boxes;
  EndTable end;
  WallForces walls;
  WorldDamage damage;
  Series series;            ///< empty when not recorded
  ReplicaOutcome replicas;  ///< empty when not asked for
};

}  // namespace holdfast::internal
