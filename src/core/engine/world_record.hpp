#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/engine/recorder.hpp"

namespace holdfast::internal {

/// A vector and a quaternion as the results file stores them: float32, the latter as w, x, y, z.
struct Float3 {
  float x = 0, y = 0, z = 0;
};
struct Float4 {
  float w = 1, x = 0, y = 0, z = 0;
};

/// Time series of one world, sampled; float32 columns ready for the file. Container frame.
/// Sample columns have an entry a sample; row columns one a sample and box: row = sample * box_count + box.
struct Series {
  std::vector<double> time;                    ///< s
  std::vector<Float3> container_acceleration;  ///< m/s²; at a breakpoint the value before it
  std::vector<float> total_kinetic_energy;     ///< J
  std::vector<std::uint32_t> fallen_count;     ///< boxes lower than in the reference pose by the drop threshold

  std::vector<Float3> displacement;         ///< of the centre of mass from the reference pose, m
  std::vector<Float4> orientation;          ///< container_from_body
  std::vector<Float3> angular_velocity;     ///< rad/s
  std::vector<Float3> linear_acceleration;  ///< mean over the step that the sample lies in, m/s²
  std::vector<Float3> force;                ///< external: −m a(t), N; zero in a free container
  std::vector<float> kinetic_energy;        ///< in the container's frame, J
};

/// Constant description of a world's boxes as the file stores it, an entry a box.
struct BoxTable {
  std::vector<std::uint32_t> id;         ///< place among the boxes of the layout, from 1
  std::vector<std::int32_t> material;    ///< id of the layout file
  std::vector<float> mass;               ///< kg
  std::vector<Float3> size;              ///< m
  std::vector<Float3> initial_position;  ///< of the centre of mass in the layout's pose, m
};

/// How the boxes of a world ended, an entry a box: all that verdicts are judged by. The end values are those of
/// the last sample, to the bit.
struct EndTable {
  std::vector<Float3> displacement;           ///< from the reference pose, m
  std::vector<float> tilt;                    ///< angle of the rotation from the reference pose, degrees
  std::vector<float> kinetic_energy;          ///< J
  std::vector<float> peak_displacement;       ///< largest length of the displacement, over all steps, m
  std::vector<float> peak_kinetic_energy;     ///< over all steps, J
  std::vector<Float3> settling_displacement;  ///< of the settled pose from the layout's pose, m
};

/// Everything the results file keeps of one world.
struct WorldRecord {
  std::uint64_t layout = 0;        ///< index of the layout in the run
  std::uint64_t acceleration = 0;  ///< index of the acceleration in the run
  Outcome outcome;
  std::string status_text;                 ///< a sentence where the status is not ok
  double cpu_seconds = 0.0;                ///< build and simulate
  double peak_total_kinetic_energy = 0.0;  ///< over all steps, J
  std::uint64_t state_hash = 0;            ///< of the final state, see `state_hash`
  BoxTable boxes;
  EndTable end;
  Series series;  ///< empty when not recorded
};

}  // namespace holdfast::internal
