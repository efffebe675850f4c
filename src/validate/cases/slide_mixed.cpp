#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "validate/cases/slide_cases.hpp"

namespace holdfast::internal {

namespace {

constexpr double kGravity = 9.81;    ///< m/s²
const Vec3 kContainer(40, 20, 5);    ///< so large that nothing reaches a wall, m
const Vec3 kFlat(1.0, 1.0, 0.2);     ///< slides and does not tip, m
const Vec3 kBase(3.0, 1.0, 0.3);     ///< a box that another one slides on, m
const Vec3 kOnBase(0.6, 0.6, 0.15);  ///< that other one, m
constexpr double kFarEnd = 2.2;      ///< of it from the end of the base that it slides to, m
constexpr double kNearLimit = 0.02;  ///< of accelerations below and above a limit, relative
constexpr double kDuration = 1.0;    ///< of the accelerations, s

/// The way of a box from rest whose acceleration is `excess` g beyond what friction takes, m.
double path_of(double excess) { return 0.5 * excess * kGravity * kDuration * kDuration; }

/// How far each box of the scene has gone under an acceleration of so many g along x, m; nothing where the engine
/// cannot model the scene.
std::optional<std::vector<Vec3>> moved_by(Laboratory& laboratory, Scene scene, double acceleration) {
  scene.then(kDuration, {acceleration * kGravity, 0, 0});
  const std::optional<Snapshot> end = final_state_if_any(laboratory, scene);
  if (!end) return std::nullopt;
  std::vector<Vec3> moved;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) moved.emplace_back(end->position[i] - scene.boxes[i].position);
  return moved;
}

Measurement creep_of(std::string metric, const Vec3& moved) {
  return scaled(std::move(metric), moved.norm(), 0.0, 1.0, ToleranceClass::exact);
}

/// Two equal boxes apart from each other, one of them on a mat of 0.6, on a floor of 0.3, under 0.45 g: it stays, and
/// the other one moves by ½ (0.45 − 0.3) g t².
std::vector<Measurement> one_on_mat(Laboratory& laboratory) {
  Scene scene = empty_scene(kContainer, 0.3);
  scene.boxes = {standing_box(kFlat, {20, 5, 0}), standing_box(kFlat, {20, 10, 0})};
  scene.boxes[0].mat = 0.6;
  const auto moved = moved_by(laboratory, scene, 0.45);
  if (!moved) return {};
  return {creep_of("creep of the box on the mat (m)", (*moved)[0]),
          relative("displacement of the other one (m)", (*moved)[1].x(), -path_of(0.15), ToleranceClass::exact)};
}

/// A mat of 0.6 beneath the lower of two boxes does nothing between them: there the limit is 0.3. Beneath the upper one
/// it holds that.
std::vector<Measurement> mat_between(Laboratory& laboratory) {
  const auto moved_with = [&](std::size_t on_mat) {
    Scene scene = scene_of_pairs(kContainer, 0.8, 0.3, 0.0);
    scene.boxes = {standing_box(kBase, {20, 10, 0}), standing_box(kOnBase, {20 + kFarEnd, 10.2, kBase.z()})};
    scene.boxes[on_mat].mat = 0.6;
    return moved_by(laboratory, scene, 0.45);
  };
  const auto beneath_lower = moved_with(0);
  const auto beneath_upper = moved_with(1);
  if (!beneath_lower || !beneath_upper) return {};
  return {
      relative("displacement off the box on a mat (m)", (*beneath_lower)[1].x(), -path_of(0.15), ToleranceClass::good),
      creep_of("creep of the box on a mat on the other (m)", (*beneath_upper)[1])};
}

/// A carton on the floor, and one on a pallet: each slides at the limit of its pair. Two hundredths below it stays,
/// and two hundredths above it moves by ½ 0.02 μ g t².
std::vector<Measurement> pairs_of_materials(Laboratory& laboratory) {
  Scene scene = scene_of_pairs(kContainer, 0.9, 0.9, 0.0);
  constexpr double kOnFloor = 0.35, kOnPallet = 0.25;
  scene.settings.contact.materials.set({"carton", "floor"}, kOnFloor);
  scene.settings.contact.materials.set({"carton", "pallet"}, kOnPallet);
  scene.boxes = {standing_box(kFlat, {20, 5, 0}), standing_box(kBase, {20, 10, 0}),
                 standing_box(kOnBase, {20 + kFarEnd, 10.2, kBase.z()})};
  scene.boxes[0].material = scene.boxes[2].material = "carton";
  scene.boxes[1].material = "pallet";
  std::vector<Measurement> measurements;
  for (const auto& [on, box, limit] : {std::tuple("floor", 0U, kOnFloor), {"pallet", 2U, kOnPallet}}) {
    const auto below = moved_by(laboratory, scene, (1.0 - kNearLimit) * limit);
    const auto above = moved_by(laboratory, scene, (1.0 + kNearLimit) * limit);
    if (!below || !above) return {};
    const std::string carton = std::string("carton on the ") + on;
    measurements.push_back(creep_of("creep of the " + carton + " (m)", (*below)[box]));
    measurements.push_back(relative("displacement of the " + carton + " (m)", (*above)[box].x(),
                                    -path_of(kNearLimit * limit), ToleranceClass::good));
  }
  return measurements;
}

/// A box of a tonne on one of ten kilogrammes: what is above an interface presses and pushes it alike, so that masses
/// have no influence on its limit.
/// @param between the interface that slides is the one between the boxes
std::vector<Measurement> heavy_on_light(Laboratory& laboratory, bool between) {
  constexpr double kLimit = 0.3, kOther = 0.6;
  Scene scene = scene_of_pairs(kContainer, between ? kOther : kLimit, between ? kLimit : kOther, 0.0);
  scene.boxes = {standing_box({2.0, 1.0, 0.3}, {20, 10, 0}), standing_box({1.0, 1.0, 0.3}, {20.8, 10, 0.3})};
  scene.boxes[0].mass = 10.0;
  scene.boxes[1].mass = 1000.0;
  const auto below = moved_by(laboratory, scene, (1.0 - kNearLimit) * kLimit);
  const auto above = moved_by(laboratory, scene, (1.0 + kNearLimit) * kLimit);
  if (!below || !above) return {};
  const double path = -path_of(kNearLimit * kLimit);
  std::vector<Measurement> measurements = {
      creep_of("creep of the heavy box below the limit (m)", (*below)[1]),
      relative("displacement of the heavy box above it (m)", (*above)[1].x(), path, ToleranceClass::good)};
  if (between)
    measurements.push_back(
        scaled("creep of the light box above it (m)", (*above)[0].norm(), 0.0, 1.0, ToleranceClass::fine));
  else
    measurements.push_back(
        relative("displacement of the light box above it (m)", (*above)[0].x(), path, ToleranceClass::good));
  return measurements;
}

/// A box against a bulkhead that is fixed, and one that slides 0.3 m to it and stops there.
std::vector<Measurement> bulkhead(Laboratory& laboratory) {
  Scene scene = scene_of_pairs(kContainer, 0.2, 0.0, 0.0);
  constexpr double kGap = 0.3;
  scene.boxes = {standing_box(kFlat, {20, 5, 0}), standing_box(kFlat, {20 + kGap, 8, 0}),
                 standing_box({0.2, 8, 1.5}, {19.8, 3, 0})};
  scene.boxes[2].mass = kFixed;
  const auto moved = moved_by(laboratory, scene, 0.6);
  if (!moved) return {};
  return {creep_of("creep of the box against it (m)", (*moved)[0]),
          relative("displacement of the box that slides to it (m)", (*moved)[1].x(), -kGap, ToleranceClass::good),
          creep_of("displacement of the bulkhead (m)", (*moved)[2])};
}

/// A plate 0.6 m high in two containers of one batch: in the one that is shorter, and open at the rear, it is beyond
/// the sill, and falls by the height of a bed of 0.5 m more.
std::vector<Measurement> two_containers(Laboratory& laboratory) {
  constexpr double kHeight = 0.6, kBed = 0.5;
  std::array<Scene, 2> scenes = {empty_scene({10, 4, 3}, 0.8), empty_scene({16, 4, 3}, 0.8)};
  scenes[0].settings.container.open_sides = {"rear"};
  scenes[0].settings.container.bed_height = kBed;
  for (Scene& scene : scenes) {
    scene.boxes = {standing_box({2.0, 2.0, 0.1}, {10.5, 1, kHeight})};
    scene.then(kDuration, Vec3::Zero());
  }
  const std::vector<Snapshot> ends = final_states(laboratory, scenes);
  if (ends[0].position.empty() || ends[1].position.empty()) return {};
  const auto fall = [&](std::size_t i) { return scenes.at(i).boxes[0].position.z() - ends[i].position[0].z(); };
  return {relative("fall beside the open container (m)", fall(0), kHeight + kBed, ToleranceClass::good),
          relative("fall in the closed one (m)", fall(1), kHeight, ToleranceClass::good)};
}

}  // namespace

std::vector<Case> mixed_load_cases() {
  return {
      {"slide", "slide_one_on_mat", "which of two equal boxes slides when one is on an anti-slip mat",
       "one coefficient for all boxes", true, one_on_mat},
      {"slide", "slide_mat_between", "a mat acts beneath its own box, not on it", "the mat acts on the upper face too",
       true, mat_between},
      {"slide", "slide_pairs_of_materials", "a box on the floor and one on a pallet, each at its own limit",
       "one coefficient for all pairs of boxes", true, pairs_of_materials},
      {"slide", "slide_heavy_on_light", "the limit of a light box on the floor, under one of 100 times its mass",
       "forces that have not converged where masses differ", true,
       [](Laboratory& laboratory) { return heavy_on_light(laboratory, false); }},
      {"slide", "slide_heavy_off_light", "the limit of that heavy box on the light one",
       "forces that have not converged where masses differ", true,
       [](Laboratory& laboratory) { return heavy_on_light(laboratory, true); }},
      {"slide", "slide_bulkhead", "boxes against a fixed bulkhead, and sliding up to it", "the bulkhead gives way",
       true, bulkhead},
      {"slide", "slide_two_containers", "a plate in two containers of one batch, one of them open",
       "all worlds of a batch in the container of the first", true, two_containers},
  };
}

}  // namespace holdfast::internal
