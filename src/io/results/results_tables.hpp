#pragma once

#include "core/engine/world_record.hpp"
#include "io/results/results_schema.hpp"

/// Which member is stored in which dataset, and what it means: defined once, for the schema, for writing and for
/// reading. The visitors call `visit(content, &Row::member)`. What an outcome consists of is in core/model/outcome.
namespace holdfast::internal {

/// Samples of a world, and of its boxes.
template <class Visit>
void visit_series(Visit&& visit) {
  visit(DatasetContent{"/series/time", Axis::samples, "s", "time of the sample"}, &Series::time);
  visit(
      DatasetContent{
          "/series/container_acceleration", Axis::samples, "m/s2",
          "acceleration of the container; at a breakpoint the value before it, and the mean of a step where resampled"},
      &Series::container_acceleration);
  visit(DatasetContent{"/series/total_kinetic_energy", Axis::samples, "J", "kinetic energy of all boxes together"},
        &Series::total_kinetic_energy);
  visit(DatasetContent{"/series/fallen_count", Axis::samples, "1",
                       "boxes lower than in the reference pose by more than the drop threshold of the run"},
        &Series::fallen_count);
  visit(DatasetContent{"/series/displacement", Axis::rows, "m",
                       "displacement x, y, z of the centre of mass from the reference pose"},
        &Series::displacement);
  visit(DatasetContent{"/series/orientation", Axis::rows, "1",
                       "unit quaternion w, x, y, z that rotates from the box's axes to the container's"},
        &Series::orientation);
  visit(DatasetContent{"/series/angular_velocity", Axis::rows, "rad/s", "angular velocity x, y, z"},
        &Series::angular_velocity);
  visit(DatasetContent{"/series/linear_acceleration", Axis::rows, "m/s2",
                       "acceleration x, y, z in the container's frame, mean over the last step"},
        &Series::linear_acceleration);
  visit(
      DatasetContent{"/series/force", Axis::rows, "N",
                     "external force x, y, z: minus mass times the container's acceleration; zero in a free container"},
      &Series::force);
  visit(DatasetContent{"/series/kinetic_energy", Axis::rows, "J", "kinetic energy in the container's frame"},
        &Series::kinetic_energy);
}

/// Constant properties of boxes.
template <class Visit>
void visit_boxes(Visit&& visit) {
  visit(DatasetContent{"/boxes/id", Axis::boxes, "1", "position among the boxes of the layout file, from 1"},
        &BoxTable::id);
  visit(DatasetContent{"/boxes/material", Axis::boxes, "1", "material of the box by number; -1 where it has a name"},
        &BoxTable::material);
  visit(DatasetContent{"/boxes/mass", Axis::boxes, "kg", "mass"}, &BoxTable::mass);
  visit(DatasetContent{"/boxes/size", Axis::boxes, "m", "edge lengths along x, y, z as loaded"}, &BoxTable::size);
  visit(DatasetContent{"/boxes/initial_position", Axis::boxes, "m", "centre of mass as loaded, container frame (z up)"},
        &BoxTable::initial_position);
}

}  // namespace holdfast::internal
