#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/model/contact_law.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"
#include "core/reference/plain_contacts.hpp"
#include "core/reference/plain_solver.hpp"

namespace holdfast::internal::plain {

/// Steps in a second of simulated time, 1/s.
double steps_per_second(const Settings& settings);

/// One container with its boxes, simulated step by step, in the container's frame.
///
/// A step (Moreau 1988): contacts are found at the start of the step; the effective gravity g − a(t) changes the
/// velocities; impulses change them again so that the contact laws hold at the end; then positions are integrated.
class PlainWorld {
 public:
  /// The batch's columns give the poses and velocities at the start. `settings` must outlive the world.
  PlainWorld(const WorldBatch& batch, const World& world, const Settings& settings);

  /// Takes the next step within the phase. Returns the time reached, s.
  double advance(const Phase& phase);

  /// Writes the world's range of the columns.
  void read_back(StateColumns& state) const;

  const Counters& counters() const { return counters_; }

  /// `not_converged` once the solver has ended a step with too large a residual.
  Status status() const { return status_; }

 private:
  /// A box: its properties and its state.
  struct Body {
    Vec3 half_extents;
    Vec3 centre_of_mass;  ///< offset from the centroid, body axes, m
    double inverse_mass;  ///< 1/kg; 0: fixed
    Vec3 inertia;         ///< principal moments, kg m²
    Surface surface;
    Vec3 position;  ///< of the centre of mass, m
    Rotation orientation;
    Vec3 velocity;
    Vec3 angular_velocity;

    bool is_fixed() const { return inverse_mass == 0.0; }
    Block block() const;
    Mover mover_at_rest() const;
    /// Radius of the sphere around the centre of mass that contains the box, m.
    double radius() const;
  };
  struct Side {
    HalfSpace half_space;        ///< beyond its inner face
    std::optional<Block> block;  ///< what there is of it, where it ends
    Surface surface;
    std::vector<double> play;  ///< one per box: how far the side is moved back for it, m
  };
  /// A point at which two bodies touch, or may touch within a step.
  struct Touch {
    PointLaw law;
    double gap;  ///< m
    double restitution;
    /// Fraction of the step before the bodies hit each other, if they do; until then they keep their old velocity.
    double impact = 0.0;
  };

  std::vector<ContactPoint> points_with(const Side& side, std::size_t body, double margin) const;
  std::vector<Touch> find_touches(double step, double slack) const;
  Touch touch_at(const ContactPoint& point, std::size_t a, std::size_t b, const Surface& first) const;
  std::vector<Mover> movers() const;
  void take_step(double step);
  bool demand(Touch& touch, const std::vector<Mover>& before, const std::vector<Mover>& unhindered, double step) const;
  std::vector<double> old_shares(const std::vector<Touch>& touches, const std::vector<Vec3>& impulses,
                                 const std::vector<Mover>& before, double step) const;
  void move(Body& body, const Mover& after, double old_share, double step) const;
  void separate();

  const World& world_;
  const Settings& settings_;
  std::vector<Body> bodies_;
  std::vector<Side> sides_;
  double time_ = -std::numeric_limits<double>::infinity();  ///< end of the last step, s
  Vec3 field_ = Vec3::Zero();                               ///< g − a(t), m/s²
  Counters counters_;
  Status status_ = Status::ok;
};

}  // namespace holdfast::internal::plain
