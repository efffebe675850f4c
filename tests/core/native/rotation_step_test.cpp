#include "core/native/rotation_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "random.hpp"

namespace rotation_step_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

/// Largest difference of the two quaternions' numbers from what sine and cosine give.
double error_of(const Vec3& vector) {
  const Eigen::Vector3d axis = Eigen::Vector3d(vector).normalized();
  const Eigen::Quaterniond exact(Eigen::AngleAxisd(vector.norm(), axis));
  return (rotation_by(vector).coeffs() - exact.coeffs()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("rotation_step: a step's rotation is that of sine and cosine", "[core][rotation_step]") {
  Random random(1);
  double worst = 0.0, worst_norm = 0.0;
  for (int i = 0; i < 1000; ++i) {
    // From hardly anything to half a radian, in all decades.
    const Vec3 vector = random.vector(-1, 1).normalized() * 0.5 * std::pow(10.0, random.between(-12, 0));
    worst = std::max(worst, error_of(vector));
    worst_norm = std::max(worst_norm, std::abs(rotation_by(vector).norm() - 1.0));
  }
  CAPTURE(worst, worst_norm);
  CHECK(worst < 1e-12);
  CHECK(worst_norm < 1e-15);
}

TEST_CASE("rotation_step: a small rotation is not lost in the rounding of a large one", "[core][rotation_step]") {
  for (const double angle : {1e-3, 1e-8, 1e-16, 1e-150}) {
    const Rotation turned = rotation_by(Vec3(0, angle, 0));
    CAPTURE(angle, turned.y());
    CHECK(turned.y() == Approx(std::sin(0.5 * angle)).epsilon(1e-14));
    CHECK(turned.x() == 0.0);
    CHECK(turned.z() == 0.0);
  }
}

TEST_CASE("rotation_step: no rotation is exactly none, and the opposite one its mirror", "[core][rotation_step]") {
  CHECK(rotation_by(Vec3::Zero()).coeffs() == Rotation::Identity().coeffs());
  const Vec3 vector(0.1, -0.2, 0.03);
  CHECK(rotation_by(-vector).coeffs() == rotation_by(vector).conjugate().coeffs());
}

TEST_CASE("rotation_step: moments of inertia turn with the body", "[core][rotation_step]") {
  Random random(2);
  const Vec3 principal(1.0, 2.5, 3.0);
  for (int i = 0; i < 20; ++i) {
    const Mat3 axes = random.rotation().toRotationMatrix();
    const Mat3 inertia = inertia_in_container(axes, principal);
    const double worst = (inertia * axes - axes * principal.asDiagonal()).cwiseAbs().maxCoeff();
    CAPTURE(worst);
    CHECK(worst < 1e-14);
  }
}

TEST_CASE("rotation_step: a vector is shortened to the limit, and a short one is left alone", "[core][rotation_step]") {
  const Vec3 vector(3, 4, 12);
  CHECK(clamped(vector, 13.5) == vector);
  CHECK((clamped(vector, 6.5) - 0.5 * vector).norm() < 1e-15);
  CHECK(clamped(Vec3::Zero(), 0.0) == Vec3::Zero());
}

}  // namespace rotation_step_test
