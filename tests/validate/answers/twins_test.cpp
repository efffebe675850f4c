#include "validate/answers/twins.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace twins_test {

using namespace holdfast::internal;

namespace {

Snapshot start_of(const Scene& scene) {
  Snapshot snapshot;
  for (const SceneBox& box : scene.boxes) {
    snapshot.position.push_back(box.position);
    snapshot.orientation.push_back(box.orientation);
    snapshot.velocity.push_back(box.velocity);
    snapshot.angular_velocity.push_back(box.angular_velocity);
  }
  return snapshot;
}

}  // namespace

TEST_CASE("twins: mirroring, swapping and reversing twice gives the same bits", "[validate][twins]") {
  const Scene scene = assorted_scene();
  const Snapshot start = start_of(scene);
  for (const int axis : {0, 1}) {
    const Scene mirrored = mirrored_twin(scene, axis);
    CHECK_FALSE(same_bits(start, start_of(mirrored)));
    CHECK(same_bits(start, start_of(mirrored_twin(mirrored, axis))));
    CHECK(mirrored.acceleration.segments[0].acceleration[axis] == -scene.acceleration.segments[0].acceleration[axis]);
  }
  CHECK(same_bits(start, start_of(swapped_twin(swapped_twin(scene)))));
  CHECK(same_bits(start, start_of(reversed_twin(reversed_twin(scene)))));
}

TEST_CASE("twins: a world four times as large has twice the time and twice the step", "[validate][twins]") {
  const Scene scene = assorted_scene();
  const Scene twin = scaled_twin(scene, 4.0);
  CHECK(twin.acceleration.end_time() == 2.0 * scene.acceleration.end_time());
  CHECK(twin.step_factor == 2.0);
  CHECK(twin.boxes[0].size == 4.0 * scene.boxes[0].size);
  CHECK(twin.boxes[0].mass == scene.boxes[0].mass);
  CHECK(twin.acceleration.segments[0].acceleration == scene.acceleration.segments[0].acceleration);
}

TEST_CASE("twins: the distance is the largest of all boxes, infinite for different numbers", "[validate][twins]") {
  const Snapshot start = start_of(assorted_scene());
  Snapshot other = start;
  CHECK(distance_between(start, other) == 0.0);
  other.position[2].x() += 0.5;
  CHECK(distance_between(start, other) == 0.5);
  other.position.pop_back();
  CHECK(std::isinf(distance_between(start, other)));
  CHECK(std::isinf(distance_between({}, {})));
  CHECK_FALSE(same_bits({}, {}));
}

}  // namespace twins_test
