#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/engine/findings.hpp"
#include "core/model/outcome.hpp"

namespace holdfast::internal {

/// Sampled time series of one world, as float32 columns that the file stores unchanged. Container frame. Sample columns
/// have one entry per sample; row columns have one per sample and box: row = sample * box_count + box.
struct Series {
  std::vector<double> time;  ///< s
  std::vector<Float3>
      container_acceleration;  ///< m/s²; at a breakpoint the value before it, and the mean of a step where resampled
  std::vector<float> total_kinetic_energy;  ///< J
  std::vector<std::uint32_t> fallen_count;  ///< boxes lower than in the reference pose by more than the drop threshold

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

/// Everything that the results file contains of one world.
struct WorldRecord {
  WorldRow row;  ///< without the places of its entries, which the writer gives it
  BoxTable boxes;
  EndTable end;
  Series series;   ///< empty when not recorded
  Findings found;  ///< by the analyses that were asked for
};

}  // namespace holdfast::internal
