#include "core/native/island/position_correction.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/native/collision/boxes.hpp"
#include "core/native/constants.hpp"
#include "random.hpp"

namespace position_correction_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr double kExact = 1e-12;  // overlap that may be left, m
constexpr double kFixed = std::numeric_limits<double>::infinity();

/// Boxes that are one island, with all of their contacts.
struct Boxes {
  Scene scene;
  std::vector<std::uint32_t> free, contacts;

  void add(const OrientedBox& box, double mass) {
    Bodies& bodies = scene.bodies;
    const bool fixed = mass == kFixed;
    if (!fixed) free.push_back(static_cast<std::uint32_t>(bodies.count()));
    const Vec3 squares = 4.0 * box.half_extents.cwiseAbs2();
    bodies.mass.push_back(mass);
    bodies.principal_inertia.emplace_back(mass / 12.0 * (Vec3::Constant(squares.sum()) - squares));
    bodies.activity.push_back(fixed ? Activity::fixed : Activity::moving);
    bodies.shape.push_back(box);
    bodies.state.position.push_back(box.centre);
  }

  IslandView island() {
    const auto count = static_cast<std::int32_t>(scene.bodies.count());
    for (std::int32_t a = 0; a < count; ++a) {
      for (std::int32_t b = a + 1; b < count; ++b) {
        Manifold manifold;
        manifold.a = a;
        manifold.b = b;
        update_contact(manifold, contact_now(scene.bodies, {}, a, b, 0.02, ContactAxis{}), scene.bodies);
        if (manifold.contact.count > 0) scene.manifolds.push_back(manifold);
      }
    }
    contacts.resize(scene.manifolds.size());
    std::iota(contacts.begin(), contacts.end(), 0U);
    return {free, contacts};
  }
};

constexpr double kSide = 0.4;  // of the cubes, m
const Vec3 kCube = Vec3::Constant(kSide);

/// Cubes of 1 kg in a row along x that starts at a fixed one, with these gaps, m.
Boxes row_of_cubes(const std::vector<double>& gaps) {
  Boxes boxes;
  double x = 0.0;
  boxes.add(box_at(Vec3(x, 0, 0), kCube), kFixed);
  for (const double gap : gaps) boxes.add(box_at(Vec3(x += kSide + gap, 0, 0), kCube), 1.0);
  return boxes;
}

/// Displacements of the free bodies, 6 numbers each.
Eigen::VectorXd displacements(const PositionCorrection& correction, const Boxes& boxes) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * boxes.free.size()));
  for (std::size_t i = 0; i < boxes.free.size(); ++i) {
    if (!correction.moves(static_cast<std::int32_t>(boxes.free[i]))) continue;
    d.segment<3>(static_cast<Eigen::Index>(6 * i)) = correction.shift(boxes.free[i]);
    d.segment<3>(static_cast<Eigen::Index>(6 * i + 3)) = correction.turn(boxes.free[i]);
  }
  return d;
}

/// The problem with dense matrices: a row per contact point, six columns per free body.
struct DenseProblem {
  Eigen::MatrixXd jacobian, inverse_mass;
  Eigen::VectorXd gap;

  explicit DenseProblem(const Boxes& boxes) {
    const Bodies& bodies = boxes.scene.bodies;
    std::vector<Eigen::RowVectorXd> rows;
    std::vector<double> gaps;
    const auto columns = static_cast<Eigen::Index>(6 * boxes.free.size());
    for (const Manifold& manifold : boxes.scene.manifolds) {
      for (int i = 0; i < manifold.contact.count; ++i) {
        const ContactPoint& point = manifold.contact.points[static_cast<std::size_t>(i)];
        const Vec3& normal = manifold.contact.normal;
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(columns);
        const auto add = [&](std::int32_t body, const Vec3& at, double sign) {
          const auto found = std::find(boxes.free.begin(), boxes.free.end(), static_cast<std::uint32_t>(body));
          if (found == boxes.free.end()) return;
          const Eigen::Index first = 6 * (found - boxes.free.begin());
          row.segment<3>(first) = sign * normal.transpose();
          row.segment<3>(first + 3) =
              sign * (at - bodies.state.position[static_cast<std::size_t>(body)]).cross(normal).transpose();
        };
        add(manifold.a, point.on_a, -1.0);
        add(manifold.b, point.on_b, 1.0);
        rows.push_back(row);
        gaps.push_back(point.gap + kTouch);
      }
    }
    jacobian.resize(static_cast<Eigen::Index>(rows.size()), columns);
    for (std::size_t i = 0; i < rows.size(); ++i) jacobian.row(static_cast<Eigen::Index>(i)) = rows[i];
    gap = Eigen::Map<Eigen::VectorXd>(gaps.data(), static_cast<Eigen::Index>(gaps.size()));
    inverse_mass = Eigen::MatrixXd::Zero(columns, columns);
    for (std::size_t i = 0; i < boxes.free.size(); ++i) {
      const auto first = static_cast<Eigen::Index>(6 * i);
      inverse_mass.block<3, 3>(first, first) = Mat3::Identity() / bodies.mass[boxes.free[i]];
      inverse_mass.block<3, 3>(first + 3, first + 3) = bodies.inertia(boxes.free[i]).inverse();
    }
  }

  /// The smallest displacement without overlap, by accelerated projected gradients on the dual (Nesterov 1983), which
  /// start again where the objective would rise (O'Donoghue and Candès 2015).
  Eigen::VectorXd solve() const {
    const Eigen::MatrixXd dual = jacobian * inverse_mass * jacobian.transpose();
    const double step = 1.0 / dual.norm();
    Eigen::VectorXd y = Eigen::VectorXd::Zero(gap.size());
    Eigen::VectorXd ahead = y;
    double weight = 1.0;
    for (int i = 0; i < 20000; ++i) {
      const Eigen::VectorXd gradient = dual * ahead + gap;
      const Eigen::VectorXd next = (ahead - step * gradient).cwiseMax(0.0);
      if (gradient.dot(next - y) > 0.0) weight = 1.0;
      const double next_weight = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * weight * weight));
      ahead = next + (weight - 1.0) / next_weight * (next - y);
      weight = next_weight;
      y = next;
    }
    return inverse_mass * jacobian.transpose() * y;
  }
};

}  // namespace

TEST_CASE("position_correction: two boxes part in inverse proportion to their masses", "[core][position_correction]") {
  Boxes boxes;
  boxes.add(box_at(Vec3(0, 0, 0), kCube), 1.0);
  boxes.add(box_at(Vec3(kSide - 1e-3, 0, 0), kCube), 3.0);
  const IslandView island = boxes.island();
  PositionCorrection correction;
  correction.find(boxes.scene, island, kExact);
  CHECK(correction.shift(0).x() == Approx(-0.75 * (1e-3 - kTouch)).epsilon(1e-6));
  CHECK(correction.shift(1).x() == Approx(0.25 * (1e-3 - kTouch)).epsilon(1e-6));
  CHECK(correction.turn(0).norm() < 1e-9);
  CHECK(correction.turn(1).norm() < 1e-9);
}

TEST_CASE("position_correction: what is pushed pushes on, as far as boxes touch", "[core][position_correction]") {
  Boxes boxes = row_of_cubes({-1e-3, 0.0, 0.0, 5e-3, 0.0});
  const IslandView island = boxes.island();
  PositionCorrection correction;
  correction.find(boxes.scene, island, kExact);
  for (const std::uint32_t body : {1U, 2U, 3U}) {
    CHECK(correction.shift(body).x() == Approx(1e-3).epsilon(1e-3));
    CHECK(correction.turn(body).norm() < 1e-6);
  }
  CHECK_FALSE(correction.moves(0));
  CHECK_FALSE(correction.moves(4));
  CHECK_FALSE(correction.moves(5));
  CHECK_FALSE(correction.moves(-1));
}

TEST_CASE("position_correction: overlaps up to the tolerance are left alone", "[core][position_correction]") {
  Boxes boxes = row_of_cubes({-1e-3, -9e-4});
  const IslandView island = boxes.island();
  PositionCorrection correction;
  correction.find(boxes.scene, island, 1.01e-3);
  CHECK_FALSE(correction.moves(1));
  CHECK_FALSE(correction.moves(2));
  correction.find(boxes.scene, island, 9.5e-4);
  const double first = correction.shift(1).x();
  CHECK(first > 0.0);
  CHECK(-1e-3 + first >= -9.5e-4);
  CHECK(-9e-4 + correction.shift(2).x() - first >= -9.5e-4);
}

TEST_CASE("position_correction: of all displacements that leave no overlap, the smallest",
          "[core][position_correction][slow]") {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    // A heap of cubes, four on four, and tilted, that overlap by up to 2 mm or touch nearly.
    Boxes boxes;
    boxes.add(box_at(Vec3(0, 0, -kSide), Vec3(4, 4, kSide)), kFixed);
    for (int i = 0; i < 8; ++i) {
      const int row = i / 2 % 2;
      const int layer = i / 4;
      const Vec3 cell(i % 2, row, layer);
      const Vec3 centre = (kSide - 1e-3) * cell + random.vector(-1e-3, 1e-3);
      const Vec3 axis = random.vector(-1.0, 1.0);
      const double angle = random.between(0.0, 2e-3);
      boxes.add(turned(box_at(centre, kCube), axis, angle), random.between(0.5, 2.0));
    }
    const IslandView island = boxes.island();
    PositionCorrection correction;
    correction.find(boxes.scene, island, 5e-5);
    const DenseProblem problem(boxes);
    const Eigen::VectorXd found = displacements(correction, boxes);
    const Eigen::VectorXd reference = problem.solve();
    CAPTURE(round, problem.gap.minCoeff(), reference.norm());
    REQUIRE(problem.gap.minCoeff() < -1e-4);
    CHECK((problem.jacobian * found + problem.gap).minCoeff() > -5.001e-5);
    const auto size = [&](const Eigen::VectorXd& d) { return std::sqrt(d.dot(problem.inverse_mass.inverse() * d)); };
    CHECK(size(found) == Approx(size(reference)).epsilon(0.02));
    CHECK(size(found - reference) < 0.1 * size(reference));
  }
}

TEST_CASE("position_correction: a box that does not fit between walls stays between them",
          "[core][position_correction]") {
  Boxes boxes;
  boxes.add(box_at(Vec3(-kSide + 1e-3, 0, 0), kCube), kFixed);
  boxes.add(box_at(Vec3(kSide - 2e-3, 0, 0), kCube), kFixed);
  boxes.add(box_at(Vec3(0, 0, 0), kCube), 1.0);
  const IslandView island = boxes.island();
  PositionCorrection correction;
  correction.find(boxes.scene, island, 1e-4);
  // Each wall pushes it as far as it overlaps, again and again.
  CHECK(correction.shift(2).allFinite());
  CHECK(std::abs(correction.shift(2).x()) < 2.02e-3);
}

}  // namespace position_correction_test
