#include "parallel/opencl/device_batch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/model/contact_law.hpp"
#include "core/model/container_panels.hpp"

namespace holdfast::internal {

namespace {

/// Thickness of what boxes cannot get round, m: no box tunnels through a metre within a step.
constexpr double kClosedThickness = 1.0;

float narrow(double number) { return static_cast<float>(number); }

Float4Column column_of(const Vec3& v) { return {narrow(v.x()), narrow(v.y()), narrow(v.z()), 0.0F}; }

/// The friction coefficient of every pair as the product of two sides, which a contact on the device can compute. With
/// the model `pairs`, a box has the square root of the coefficient of two boxes, and a side of the container the
/// quotient of its coefficient and that root.
struct FrictionSides {
  /// @param box_friction of all boxes, one factor of a product: only with `product` do materials have their own
  FrictionSides(const ContactSettings& contact, double box_friction) : contact_(contact), box_friction_(box_friction) {}

  double of(SurfaceKind kind, double own) const {
    if (contact_.friction_model == FrictionModel::product) return own;
    // Boxes without friction among each other may have friction at the sides: a small value, whose square is 1e-12,
    // allows this.
    const double box = std::sqrt(std::max(contact_.box_box, 1e-12));
    if (kind == SurfaceKind::box) return box;
    if (kind == SurfaceKind::ground) return own * box_friction_ / box;
    return (kind == SurfaceKind::floor ? contact_.box_floor : contact_.box_wall) / box;
  }

 private:
  const ContactSettings& contact_;
  double box_friction_;
};

struct Body {
  Vec3 position = Vec3::Zero();
  Rotation orientation = Rotation::Identity();
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 half_extents = Vec3::Zero();
  Vec3 shape_centre = Vec3::Zero();
  double mass = std::numeric_limits<double>::infinity();
  Vec3 inertia = Vec3::Ones();
  double friction = 0.0;
  double restitution = 0.0;
};

/// Assigns indices to the distinct shapes of a batch.
class ShapeNumbers {
 public:
  explicit ShapeNumbers(std::vector<DeviceShape>& shapes) : shapes_(shapes) {}

  int of(const DeviceShape& shape) {
    const Vec3& half = shape.half_extents;
    const Vec3& centre = shape.centre;
    const auto [entry, is_new] = numbers_.try_emplace(
        {half.x(), half.y(), half.z(), centre.x(), centre.y(), centre.z()}, static_cast<int>(shapes_.size()));
    if (is_new) shapes_.push_back(shape);
    return entry->second;
  }

 private:
  std::vector<DeviceShape>& shapes_;
  std::map<std::array<double, 6>, int> numbers_;
};

void append(DeviceBatch& device, ShapeNumbers& shapes, const Body& body, std::size_t world, int sweeps) {
  const bool fixed = !std::isfinite(body.mass);
  const Rotation& q = body.orientation;
  DeviceBody& out = device.bodies.emplace_back();
  out.position = column_of(body.position);
  out.orientation = {narrow(q.x()), narrow(q.y()), narrow(q.z()), narrow(q.w())};
  out.velocity = column_of(body.velocity);
  out.angular_velocity = column_of(body.angular_velocity);
  out.shape = shapes.of({body.half_extents, body.shape_centre});
  out.inverse_mass = fixed ? 0.0F : narrow(1.0 / body.mass);
  out.world = static_cast<float>(world);
  out.sweeps = static_cast<float>(sweeps);

  DeviceInertia& inertia = device.inertias.emplace_back();
  const bool centred = body.shape_centre.isZero(0.0);
  for (unsigned axis = 0; axis < 3; ++axis) inertia.now[axis][3] = centred ? narrow(body.half_extents[axis]) : 0.0F;
  inertia.setup[1][3] = narrow(body.restitution);
  inertia.setup[2][3] = narrow(body.friction);

  device.body_inertia.push_back(column_of(fixed ? Vec3(Vec3::Ones()) : body.inertia));
}

}  // namespace

DeviceBatch make_device_batch(const WorldBatch& batch, int sweeps) {
  DeviceBatch device;
  ShapeNumbers shapes(device.shapes);
  for (std::size_t world = 0; world < batch.worlds.size(); ++world) {
    const std::size_t begin = device.bodies.size();
    const World& load = batch.worlds[world];
    const FrictionSides friction(load.contact,
                                 load.box_count == 0 ? 0.0 : batch.boxes.surface[load.box_begin].friction);
    const std::vector<Panel> panels = container_panels(load.container, kClosedThickness);
    for (std::size_t i = load.box_begin; i < load.box_begin + load.box_count; ++i) {
      append(device, shapes,
             {.position = batch.state.position[i],
              .orientation = batch.state.orientation[i],
              .velocity = batch.state.velocity[i],
              .angular_velocity = batch.state.angular_velocity[i],
              .half_extents = batch.boxes.half_extents[i],
              .shape_centre = -batch.boxes.centre_of_mass[i],
              .mass = batch.boxes.mass[i],
              .inertia = batch.boxes.inertia[i],
              .friction = friction.of(SurfaceKind::box, batch.boxes.surface[i].friction),
              .restitution = batch.boxes.surface[i].restitution},
             world, sweeps);
    }
    for (const Panel& panel : panels) {
      // The smaller of two coefficients is used: this makes it that of the box.
      append(device, shapes,
             {.position = panel.centre,
              .half_extents = panel.half_extents,
              .friction = friction.of(panel.surface.kind, panel.surface.friction),
              .restitution = 1.0},
             world, sweeps);
    }
    device.ranges.push_back({begin, device.bodies.size(), false});
  }
  return device;
}

}  // namespace holdfast::internal
