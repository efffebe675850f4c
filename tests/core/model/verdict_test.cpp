#include "core/model/verdict.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace holdfast::internal;

namespace {

/// End values of boxes with these displacements, m; all other values are zero.
EndTable ends(std::vector<Float3> displacement) {
  const std::size_t count = displacement.size();
  EndTable end;
  end.displacement = std::move(displacement);
  end.tilt.assign(count, 0.0F);
  end.kinetic_energy.assign(count, 0.0F);
  end.peak_displacement.assign(count, 0.0F);
  end.peak_kinetic_energy.assign(count, 0.0F);
  end.settling_displacement.assign(count, {});
  return end;
}

constexpr Thresholds kThresholds{.drop = 0.05, .move = 0.10, .tilt = 10.0};

}  // namespace

TEST_CASE("verdict: fallen is lower by more than the threshold", "[core][verdict]") {
  CHECK(is_fallen({0, 0, -0.051F}, kThresholds));
  CHECK_FALSE(is_fallen({0, 0, -0.049F}, kThresholds));
  CHECK_FALSE(is_fallen({1, 1, 0.2F}, kThresholds));
  CHECK_FALSE(is_fallen({0, 0, -0.5F}, {.drop = 0.5}));
}

TEST_CASE("verdict: a box that stayed", "[core][verdict]") {
  const BoxVerdict box = judge_box(ends({{0.06F, 0.06F, -0.04F}}), 0, kThresholds);
  CHECK(box.drop == 0.04F);
  CHECK_FALSE(box.fallen);
  CHECK_FALSE(box.moved);
  CHECK_FALSE(box.tilted);
  CHECK_FALSE(box.unstable);
}

TEST_CASE("verdict: moved is displaced by more than the threshold in any direction", "[core][verdict]") {
  CHECK(judge_box(ends({{-0.11F, 0, 0}}), 0, kThresholds).moved);
  CHECK(judge_box(ends({{0.06F, 0.06F, 0.06F}}), 0, kThresholds).moved);
  CHECK(judge_box(ends({{0, 0, 0.11F}}), 0, kThresholds).moved);
  CHECK_FALSE(judge_box(ends({{0, 0, 0.11F}}), 0, kThresholds).fallen);
  CHECK_FALSE(judge_box(ends({{0.5F, 0, 0}}), 0, {.move = 0.5}).moved);
}

TEST_CASE("verdict: tilted is rotated by more than the threshold", "[core][verdict]") {
  EndTable end = ends({{}, {}});
  end.tilt = {10.0F, 10.1F};
  CHECK_FALSE(judge_box(end, 0, kThresholds).tilted);
  CHECK(judge_box(end, 1, kThresholds).tilted);
}

TEST_CASE("verdict: unstable is fallen or moved while settling", "[core][verdict]") {
  EndTable end = ends({{}, {}, {}});
  end.settling_displacement = {{0, 0, -0.06F}, {0.2F, 0, 0}, {0, 0.05F, 0}};
  CHECK(judge_box(end, 0, kThresholds).unstable);
  CHECK(judge_box(end, 1, kThresholds).unstable);
  CHECK_FALSE(judge_box(end, 2, kThresholds).unstable);
  CHECK_FALSE(judge_box(end, 0, kThresholds).fallen);
}

TEST_CASE("verdict: a NaN displacement is not a fall", "[core][verdict]") {
  CHECK_FALSE(is_fallen({0, 0, NAN}, kThresholds));
}

TEST_CASE("verdict: a box that is no lower has a drop of 0, not of -0", "[core][verdict]") {
  CHECK_FALSE(std::signbit(judge_box(ends({{}}), 0, kThresholds).drop));
  CHECK(judge_box(ends({{0, 0, 0.5F}}), 0, kThresholds).drop == -0.5F);
}

TEST_CASE("verdict: a world counts its boxes and has the largest of their values", "[core][verdict]") {
  EndTable end = ends({{0, 0, -0.2F}, {0.3F, 0.4F, 0}, {}});
  end.tilt = {90.0F, 0.0F, 0.0F};
  end.kinetic_energy = {1.5F, 2.0F, 0.0F};
  end.peak_displacement = {0.2F, 0.5F, 0.7F};
  end.settling_displacement[2] = {0, 0, -0.06F};
  const WorldVerdict world =
      judge_world({.stop_reason = StopReason::timeout, .peak_total_kinetic_energy = 4.0}, end, kThresholds);
  CHECK(world.fallen == 1);
  CHECK(world.moved == 2);
  CHECK(world.tilted == 1);
  CHECK(world.unstable == 1);
  CHECK(world.total_kinetic_energy == 3.5);
  CHECK(world.peak_kinetic_energy == 4.0);
  CHECK(world.max_displacement == 0.5F);
  CHECK(world.peak_displacement == 0.7F);
}

TEST_CASE("verdict: a world is judged by the worst that happened in it", "[core][verdict]") {
  const auto verdict = [](const EndTable& end, Status status = Status::ok) {
    return to_string(judge_world({.status = status, .stop_reason = StopReason::timeout}, end, kThresholds).verdict);
  };
  EndTable end = ends({{}, {}});
  CHECK(verdict(end) == "stayed");
  end.settling_displacement[0] = {0.2F, 0, 0};
  CHECK(verdict(end) == "unstable");
  end.tilt[1] = 11.0F;
  CHECK(verdict(end) == "moved");
  end.tilt[1] = 0.0F;
  end.displacement[1] = {0.2F, 0, 0};
  CHECK(verdict(end) == "moved");
  end.displacement[0] = {0, 0, -0.06F};
  CHECK(verdict(end) == "fell");
  CHECK(verdict(end, Status::not_converged) == "failed");
}

TEST_CASE("verdict: a world that ended early gave way, whatever the thresholds", "[core][verdict]") {
  const EndTable end = ends({{0.2F, 0, 0}});
  const auto verdict = [&](Status status, const Thresholds& thresholds) {
    return to_string(judge_world({.status = status, .stop_reason = StopReason::decided}, end, thresholds).verdict);
  };
  CHECK(verdict(Status::ok, kThresholds) == "gave_way");
  CHECK(verdict(Status::ok, {.move = 0.5}) == "gave_way");
  CHECK(verdict(Status::not_converged, kThresholds) == "failed");
  CHECK(judge_world({.stop_reason = StopReason::decided}, end, kThresholds).moved == 1);
}

TEST_CASE("verdict: a world that was not simulated has no counts", "[core][verdict]") {
  const WorldVerdict world = judge_world({.status = Status::bad_layout}, {}, kThresholds);
  CHECK(world.verdict == Verdict::failed);
  for (const std::uint32_t count : {world.fallen, world.moved, world.tilted, world.unstable})
    CHECK(count == kNotCounted);
  CHECK(std::isnan(world.total_kinetic_energy));
  CHECK(std::isnan(world.peak_kinetic_energy));
  CHECK(std::isnan(world.max_displacement));
  CHECK(std::isnan(world.peak_displacement));
}

TEST_CASE("verdict: a world without boxes", "[core][verdict]") {
  const WorldVerdict world = judge_world({.stop_reason = StopReason::timeout}, {}, kThresholds);
  CHECK(world.fallen == 0);
  CHECK(world.max_displacement == 0.0F);
}

TEST_CASE("verdict: first time beyond the move threshold", "[core][verdict]") {
  const std::vector<double> time = {0.0, 0.1, 0.2};
  const std::vector<Float3> displacement = {{}, {}, {0.05F, 0, 0}, {0, -0.2F, 0}, {0.11F, 0, 0}, {}};
  const std::vector<float> times = first_move_times(time, displacement, 2, kThresholds);
  REQUIRE(times.size() == 2);
  CHECK(times[0] == 0.2F);
  CHECK(times[1] == 0.1F);
  CHECK(std::isnan(first_move_times(time, displacement, 2, {.move = 1.0})[0]));
  CHECK(std::isnan(first_move_times({}, {}, 1, kThresholds)[0]));
}
