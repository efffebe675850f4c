#include "core/model/verdict.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace verdict_test {

using namespace holdfast::internal;

namespace {

constexpr float kNever = std::numeric_limits<float>::quiet_NaN();
constexpr Thresholds kThresholds{.drop = 0.05, .move = 0.10, .tilt = 10.0};

/// Boxes that went so far on their way, and have come back.
EndTable boxes_of(const std::vector<Excursion>& journeys) {
  const std::size_t count = journeys.size();
  EndTable end;
  visit_ends<EndTable>([&](const OutcomeField&, auto member) { (end.*member).resize(count); });
  end.first_beyond.assign(count, kNever);
  for (std::size_t i = 0; i < count; ++i) {
    end.peak_displacement[i] = journeys[i].displacement;
    end.peak_drop[i] = journeys[i].drop;
    end.peak_tilt[i] = journeys[i].tilt;
  }
  return end;
}

BoxVerdict box_of(const Excursion& journey, const Thresholds& thresholds = kThresholds) {
  return judge_box(boxes_of({journey}), 0, by_run(thresholds));
}

WorldVerdict world_of(const EndTable& end, const WorldRow& row = {.stop_reason = StopReason::sleeping}) {
  return judge_world(row, end, by_run(kThresholds));
}

}  // namespace

TEST_CASE("verdict: fallen is lower by more than the threshold", "[core][verdict]") {
  CHECK(is_fallen({0, 0, -0.051F}, kThresholds));
  CHECK_FALSE(is_fallen({0, 0, -0.049F}, kThresholds));
  CHECK_FALSE(is_fallen({1, 1, 0.2F}, kThresholds));
  CHECK_FALSE(is_fallen({0, 0, -0.5F}, {.drop = 0.5}));
  CHECK_FALSE(is_fallen({0, 0, NAN}, kThresholds));
}

TEST_CASE("verdict: a box is judged by how far it has ever been", "[core][verdict]") {
  const BoxVerdict stayed = box_of({.displacement = 0.09F, .drop = 0.049F, .tilt = 10.0F});
  CHECK_FALSE(stayed.fallen);
  CHECK_FALSE(stayed.moved);
  CHECK_FALSE(stayed.tilted);
  CHECK_FALSE(stayed.unstable);
  CHECK(box_of({.displacement = 0.11F}).moved);
  CHECK_FALSE(box_of({.displacement = 0.11F}, {.move = 0.2}).moved);
  CHECK(box_of({.drop = 0.051F}).fallen);
  CHECK(box_of({.tilt = 10.1F}).tilted);
}

TEST_CASE("verdict: where a box is at the end is told beside", "[core][verdict]") {
  EndTable end = boxes_of({{.displacement = 0.3F, .drop = 0.3F}, {.displacement = 0.3F, .drop = 0.3F}});
  end.end_displacement[1] = {0, 0, -0.2F};
  const WorldVerdict world = world_of(end);
  CHECK(world.fallen == 2);
  CHECK(world.fallen_at_end == 1);
  CHECK(world.peak_displacement == 0.3F);
  CHECK(world.end_displacement == 0.2F);
}

TEST_CASE("verdict: unstable is beyond any limit while settling", "[core][verdict]") {
  EndTable end = boxes_of({{}, {}, {}, {}});
  end.settling_peak_drop[0] = 0.06F;
  end.settling_peak_displacement[1] = 0.2F;
  end.settling_peak_tilt[2] = 11.0F;
  end.settling_peak_displacement[3] = 0.05F;
  for (std::size_t i = 0; i < 4; ++i) CHECK(judge_box(end, i, by_run(kThresholds)).unstable == (i < 3));
  CHECK(world_of(end).unstable == 3);
}

TEST_CASE("verdict: a world counts its boxes and has the largest of their values", "[core][verdict]") {
  EndTable end = boxes_of({{0.2F, 0.2F, 90.0F}, {0.5F, 0.0F, 0.0F}, {0.05F, 0.01F, 1.0F}});
  end.end_kinetic_energy = {1.5F, 2.0F, 0.0F};
  const WorldVerdict world = world_of(end, {.stop_reason = StopReason::timeout, .peak_total_kinetic_energy = 4.0});
  CHECK(world.fallen == 1);
  CHECK(world.moved == 2);
  CHECK(world.tilted == 1);
  CHECK(world.unstable == 0);
  CHECK(world.end_kinetic_energy == 3.5);
  CHECK(world.peak_kinetic_energy == 4.0);
  CHECK(world.peak_displacement == 0.5F);
  CHECK(world.peak_drop == 0.2F);
  CHECK(world.peak_tilt == 90.0F);
}

TEST_CASE("verdict: a world is judged by the worst that ever happened in it", "[core][verdict]") {
  const auto verdict = [](const EndTable& end, Status status = Status::ok) {
    return to_string(world_of(end, {.status = status, .stop_reason = StopReason::timeout}).verdict);
  };
  EndTable end = boxes_of({{}, {}});
  CHECK(verdict(end) == "stayed");
  CHECK(verdict(end, Status::not_converged) == "failed");
  end.peak_tilt[1] = 11.0F;
  CHECK(verdict(end) == "moved");
  end.peak_tilt[1] = 0.0F;
  end.peak_displacement[1] = 0.2F;
  CHECK(verdict(end) == "moved");
  end.peak_drop[0] = 0.06F;
  CHECK(verdict(end) == "fell");
  // Peaks end where the solver fails: a limit came first.
  CHECK(verdict(end, Status::not_converged) == "fell");
  end.settling_peak_displacement[0] = 0.2F;
  CHECK(verdict(end) == "unstable");
  CHECK(verdict(end, Status::not_converged) == "unstable");
}

TEST_CASE("verdict: a world that ended by a limit keeps its verdict under looser ones", "[core][verdict]") {
  const EndTable end = boxes_of({{.displacement = 0.11F}});
  const auto verdict = [&](const Thresholds& thresholds, StopReason reason) {
    return to_string(judge_world({.stop_reason = reason}, end, {.thresholds = thresholds, .run = kThresholds}).verdict);
  };
  CHECK(verdict(kThresholds, StopReason::decided) == "moved");
  CHECK(verdict({.move = 0.5}, StopReason::decided) == "moved");
  CHECK(verdict({.move = 0.5}, StopReason::sleeping) == "stayed");
  CHECK(verdict({.move = 0.05}, StopReason::sleeping) == "moved");
}

TEST_CASE("verdict: a file of an earlier version is judged at the end", "[core][verdict]") {
  EndTable end = boxes_of({{.displacement = 0.3F, .drop = 0.3F, .tilt = 30.0F}});
  const auto verdict = [&](Status status = Status::ok, StopReason reason = StopReason::timeout) {
    return to_string(judge_world({.status = status, .stop_reason = reason}, end,
                                 {.thresholds = kThresholds, .run = kThresholds, .at_end = true})
                         .verdict);
  };
  CHECK(verdict() == "stayed");
  end.settling_displacement[0] = {0.2F, 0, 0};
  CHECK(verdict() == "unstable");
  end.end_tilt[0] = 11.0F;
  CHECK(verdict() == "moved");
  CHECK(verdict(Status::not_converged) == "failed");
  CHECK(verdict(Status::ok, StopReason::decided) == "moved");
  end.end_displacement[0] = {0, 0, -0.06F};
  CHECK(verdict() == "fell");
}

TEST_CASE("verdict: the critical box is the first beyond a limit, or the nearest to one", "[core][verdict]") {
  EndTable end = boxes_of({{.displacement = 0.9F}, {.displacement = 0.2F}, {.displacement = 0.3F}});
  end.first_beyond = {0.5F, 0.25F, 0.25F};
  CHECK(world_of(end).critical_box == 2);
  // Times are by the limits of the run.
  const Judging others{.thresholds = {.move = 0.15}, .run = kThresholds};
  CHECK(judge_world({.stop_reason = StopReason::sleeping}, end, others).critical_box == 1);
  CHECK(std::isnan(judge_box(end, 0, others).first_beyond));
  CHECK(judge_box(end, 0, by_run(kThresholds)).first_beyond == 0.5F);

  const EndTable near = boxes_of({{.displacement = 0.05F}, {.drop = 0.04F}, {.tilt = 7.9F}});
  CHECK(world_of(near).critical_box == 2);
  CHECK(world_of(boxes_of({{}, {}})).critical_box == 0);

  EndTable unstable = boxes_of({{}, {}});
  unstable.settling_peak_tilt = {20.0F, 30.0F};
  unstable.first_beyond = {-1.0F, -0.5F};
  CHECK(world_of(unstable).critical_box == 1);
}

TEST_CASE("verdict: a world that was not simulated has no counts", "[core][verdict]") {
  const WorldVerdict world = world_of({}, {.status = Status::bad_layout});
  CHECK(world.verdict == Verdict::failed);
  for (const std::uint32_t count : {world.fallen, world.moved, world.tilted, world.unstable, world.critical_box})
    CHECK(count == kNotCounted);
  CHECK(std::isnan(world.end_kinetic_energy));
  CHECK(std::isnan(world.peak_kinetic_energy));
  CHECK(std::isnan(world.end_displacement));
  CHECK(std::isnan(world.peak_displacement));
}

TEST_CASE("verdict: a world without boxes", "[core][verdict]") {
  const WorldVerdict world = world_of({});
  CHECK(to_string(world.verdict) == "stayed");
  CHECK(world.fallen == 0);
  CHECK(world.critical_box == 0);
  CHECK(world.peak_displacement == 0.0F);
}

}  // namespace verdict_test
