#include "core/native/world_invariants.hpp"

#include <cmath>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// Of the norm of a quaternion or a normal.
bool is_unit(double norm) { return std::abs(norm - 1.0) <= kRounding; }

class Inspection {
 public:
  explicit Inspection(const WorldView& world) : world_(world) {}

  std::vector<std::string> run() {
    const Scene& scene = world_.scene;
    expect(world_.pairs.size() == scene.manifolds.size(), "there are as many pairs as manifolds", 0);
    for (std::size_t i = 0; i < scene.bodies.count(); ++i) inspect_body(i);
    for (std::size_t m = 0; m < scene.manifolds.size(); ++m) inspect_manifold(m);
    return std::move(broken_);
  }

 private:
  void expect(bool holds, const char* what, std::size_t index) {
    if (!holds) broken_.push_back(std::string(what) + ": " + std::to_string(index));
  }

  void inspect_body(std::size_t i) {
    const StateColumns& state = world_.scene.bodies.state;
    expect(state.position[i].allFinite() && state.velocity[i].allFinite() && state.angular_velocity[i].allFinite(),
           "the state of a body is finite", i);
    expect(is_unit(state.orientation[i].norm()), "the orientation of a body is a rotation", i);
    const Activity activity = world_.scene.bodies.activity[i];
    if (activity == Activity::resting || activity == Activity::asleep)
      expect(state.velocity[i] == Vec3::Zero() && state.angular_velocity[i] == Vec3::Zero(),
             "a body at rest or asleep has no velocity", i);
  }

  void inspect_manifold(std::size_t m) {
    const Scene& scene = world_.scene;
    const Manifold& manifold = scene.manifolds[m];
    const auto bodies = static_cast<std::int32_t>(scene.bodies.count());
    const auto sides = static_cast<std::int32_t>(scene.sides.size());
    const bool members = manifold.b >= 0 && manifold.b < bodies && manifold.a < manifold.b && manifold.a >= -sides;
    expect(members, "a manifold has two bodies in order, or a side and a body", m);
    if (!members) return;
    expect(world_.pairs.find(manifold.a, manifold.b) == static_cast<std::int32_t>(m),
           "the pair of a manifold leads to the manifold", m);
    inspect_contact(manifold, m);
    if (!manifold.active || stays(scene.bodies, manifold.a) || stays(scene.bodies, manifold.b)) return;
    expect(world_.islands.of(at(manifold.a)) == world_.islands.of(at(manifold.b)),
           "an island holds both bodies of an active contact", m);
  }

  void inspect_contact(const Manifold& manifold, std::size_t m) {
    const ContactSet& contact = manifold.contact;
    const bool counted = contact.count > 0 && at(contact.count) <= contact.points.size();
    expect(counted, "a manifold has points, and no more than there is room for", m);
    expect(is_unit(contact.normal.norm()), "the normal of a contact is a unit vector", m);
    if (!counted) return;
    for (std::size_t i = 0; i < at(contact.count); ++i) {
      const ContactPoint& point = contact.points[i];
      const CachedImpulse& cached = manifold.cached[i];
      expect(point.on_a.allFinite() && point.on_b.allFinite() && std::isfinite(point.gap),
             "the points of a contact are finite", m);
      expect(cached.force.allFinite() && cached.contact_velocity.allFinite(), "cached impulses are finite", m);
      expect(cached.pressed >= 0.0, "no cached normal force pulls", m);
      if (!manifold.active)
        expect(cached.force == Vec3::Zero() && cached.contact_velocity == Vec3::Zero() && cached.pressed == 0.0,
               "a pair that is not active has no cached impulses", m);
    }
  }

  const WorldView& world_;
  std::vector<std::string> broken_;
};

}  // namespace

bool has_finite_state(const WorldView& world) {
  const StateColumns& state = world.scene.bodies.state;
  return is_finite({state.position, state.orientation, state.velocity, state.angular_velocity});
}

std::vector<std::string> broken_invariants(const WorldView& world) { return Inspection(world).run(); }

}  // namespace holdfast::internal::native
