// The pairs of a world that are near each other, and their contacts.

#include <algorithm>
#include <cmath>

#include "core/native/contact_kinematics.hpp"
#include "core/native/native_world.hpp"

namespace holdfast::internal::native {

namespace {

/// Whether two boxes have gone from one side of each other to the other.
/// @param before,after vector between their centres, m
/// @param room         how near the centres may be along each axis before the boxes overlap, m
/// @param slack        overlap along an axis that does not count, m
bool have_passed(const Vec3& before, const Vec3& after, const Vec3& room, double slack) {
  for (int k = 0; k < 3; ++k) {
    if (!(before[k] * after[k] < 0.0)) continue;
    if (std::min(std::abs(before[k]), std::abs(after[k])) < room[k] - slack) continue;
    // At the time when the centres are level along this axis: do the boxes overlap along the others?
    Vec3 level = (before + before[k] / (before[k] - after[k]) * (after - before)).cwiseAbs();
    level[k] = 0.0;
    if ((level.array() < room.array()).all()) return true;
  }
  return false;
}

/// Which body of a contact stands on the other: 1 for the second, −1 for the first, 0 for none.
int upper_of(const Vec3& normal) { return normal.z() >= kStandsOn ? 1 : normal.z() <= -kStandsOn ? -1 : 0; }

}  // namespace

/// Finds the contact of a pair. One that is narrow is taken when all others are.
void NativeWorld::update_pair(std::int32_t a, std::int32_t b) {
  const Bodies& bodies = scene_.bodies;
  const std::int32_t known = pairs_.find(a, b);
  const ContactAxis before = known < 0 ? ContactAxis{} : scene_.manifolds[at(known)].contact.axis;
  const ContactSet contact = contact_now(bodies, scene_.sides, a, b, speculative_margin(terms_, bodies, a, b), before);
  if (is_narrow(scene_.bodies, scene_.sides, a, b, contact)) {
    narrow_contacts_.push_back({a, b, contact});
  } else {
    take_contact(a, b, contact);
  }
}

/// Gives a pair the contact that has been found, and marks its bodies where it shows too late.
void NativeWorld::take_contact(std::int32_t a, std::int32_t b, const ContactSet& contact) {
  const Bodies& bodies = scene_.bodies;
  const std::int32_t known = pairs_.find(a, b);
  static const Manifold kNone;
  const Manifold& before = known < 0 ? kNone : scene_.manifolds[at(known)];
  // What was solved with this contact would be solved with it again: the overlap is what the solve left.
  const bool solved = before.active && contact.axis == before.contact.axis &&
                      (connectivity_.is_in_large_island(a) || connectivity_.is_in_large_island(b));
  const double overlap = (solved ? kSolvedOverlap : 1.0) * options_.missed_contact_overlap;
  if (is_missed_contact(contact, before.nearest_gap, overlap)) {
    mark_failed(a, b);
    if (!solved) late_contacts_.push_back({a, b, contact, poses_of(bodies, a, b)});
  }
  set_contact(a, b, known, contact);
}

/// Gives a pair its contact.
/// @param known index of its manifold, negative where it has none
void NativeWorld::set_contact(std::int32_t a, std::int32_t b, std::int32_t known, const ContactSet& contact) {
  const Bodies& bodies = scene_.bodies;
  if (known >= 0 && contact.count > 0) {
    Manifold& manifold = scene_.manifolds[at(known)];
    if (upper_of(manifold.contact.normal) != upper_of(contact.normal)) turn_surfaces(manifold, contact.normal);
    update_contact(manifold, contact, bodies);
  } else if (known >= 0) {
    end_manifold(at(known));
  } else if (contact.count > 0) {
    pairs_.set(a, b, static_cast<std::int32_t>(scene_.manifolds.size()));
    Manifold& manifold = scene_.manifolds.emplace_back();
    manifold.a = a;
    manifold.b = b;
    set_surfaces(manifold, contact.normal);
    update_contact(manifold, contact, bodies);
  }
}

/// The bodies have to take the step again. One that has taken the whole step is no obstacle to one that takes half of
/// it.
void NativeWorld::mark_failed(std::int32_t a, std::int32_t b) {
  if (ahead_[at(b)] != 0 || (a >= 0 && ahead_[at(a)] != 0)) return;
  if (a >= 0) failed_[at(a)] = 1;
  failed_[at(b)] = 1;
}

/// Gives a manifold the coefficients of its two surfaces.
/// @param normal of its contact, from a to b
void NativeWorld::set_surfaces(Manifold& manifold, const Vec3& normal) const {
  const std::vector<Surface>& surfaces = scene_.bodies.surface;
  const Surface& on_a = manifold.with_side() ? scene_.sides[side_of(manifold)].surface : surfaces[at(manifold.a)];
  const Surface& on_b = surfaces[at(manifold.b)];
  manifold.friction = friction_of_pair(contact_, on_a, on_b, normal.z());
  manifold.kinetic_friction = contact_.kinetic_friction * manifold.friction;
  manifold.restitution = restitution_of_pair(on_a, on_b);
}

/// Gives a manifold the coefficients of its contact's new normal: a mat acts only where its box stands on the other.
void NativeWorld::turn_surfaces(Manifold& manifold, const Vec3& normal) const {
  const double before = manifold.friction;
  set_surfaces(manifold, normal);
  if (manifold.friction != before) forget_forces(manifold);
}

void NativeWorld::end_manifold(std::size_t index) {
  const Manifold& ended = scene_.manifolds[index];
  pairs_.erase(ended.a, ended.b);
  if (index + 1 < scene_.manifolds.size()) {
    const Manifold& last = scene_.manifolds.back();
    pairs_.set(last.a, last.b, static_cast<std::int32_t>(index));
    scene_.manifolds[index] = last;
  }
  scene_.manifolds.pop_back();
}

/// Ends the contacts of bodies that have just fallen asleep with what stays, where the position correction before has
/// separated them: `find_contacts` looks at those of moving bodies only.
void NativeWorld::end_separated_from_sleeping() {
  const Bodies& bodies = scene_.bodies;
  // Backwards, because the last manifold takes the index of one that ends.
  for (std::size_t m = scene_.manifolds.size(); m-- > 0;) {
    const Manifold& manifold = scene_.manifolds[m];
    if (manifold.contact.count == 0 && stays(bodies, manifold.a) && stays(bodies, manifold.b)) end_manifold(m);
  }
}

/// Contacts of a body with the sides that it is near: most are too far away for a closer look.
/// @param margin speculative margin with any side, m
void NativeWorld::update_sides(std::size_t body, double margin) {
  const OrientedBox& box = scene_.bodies.shape[body];
  const Vec3 extent = box.bounding_half_extents();
  near_sides_[body] = 0;
  for (std::size_t s = 0; s < scene_.sides.size(); ++s) {
    const Side& side = scene_.sides[s];
    const double gap = side.space.normal.dot(box.centre) - side.space.normal.cwiseAbs().dot(extent) -
                       (side.space.offset - side.play[body]);
    if (gap > margin + kTouch) continue;
    if (side.block) {
      const Vec3 apart = (box.centre - side.block->centre).cwiseAbs() - side.block->half_extents - extent;
      if (apart.maxCoeff() > margin + kLeastPlay) continue;
    }
    near_sides_[body] |= static_cast<std::uint8_t>(1U << s);
    update_pair(-1 - static_cast<std::int32_t>(s), static_cast<std::int32_t>(body));
  }
}

void NativeWorld::find_contacts(const std::vector<std::uint8_t>& moved) {
  const Bodies& bodies = scene_.bodies;
  const std::size_t count = bodies.count();
  lower_.resize(count);
  upper_.resize(count);
  near_sides_.resize(count);
  narrow_contacts_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const OrientedBox& box = bodies.shape[i];
    const double speed = bodies.largest_speed(i);
    const Vec3 extent = box.bounding_half_extents().array() + 0.5 * speculative_margin(terms_, 2.0 * speed);
    lower_[i] = box.centre - extent;
    upper_[i] = box.centre + extent;
    if (moved[i] != 0 && bodies.fixed[i] == 0) update_sides(i, speculative_margin(terms_, speed));
  }
  // Ends pairs that are no longer near. Backwards, because the last manifold takes the index of one that ends.
  for (std::size_t m = scene_.manifolds.size(); m-- > 0;) {
    const Manifold& manifold = scene_.manifolds[m];
    const std::size_t b = at(manifold.b);
    if (manifold.with_side()) {
      if (moved[b] != 0 && (near_sides_[b] & 1U << side_of(manifold)) == 0) end_manifold(m);
      continue;
    }
    const std::size_t a = at(manifold.a);
    const bool near = (lower_[a].array() <= upper_[b].array()).all() && (lower_[b].array() <= upper_[a].array()).all();
    if ((moved[a] != 0 || moved[b] != 0) && !near) end_manifold(m);
  }
  for (const IndexPair& pair : broad_phase_.find_pairs(lower_, upper_, moved))
    if (bodies.fixed[pair.i] == 0 || bodies.fixed[pair.j] == 0)
      update_pair(static_cast<std::int32_t>(pair.i), static_cast<std::int32_t>(pair.j));
  // How far bodies have sunk is known when all other contacts are.
  scene_.sinking.forget();
  for (NarrowContact& narrow : narrow_contacts_)
    if (scene_.sinking.is_flush(bodies, scene_.sides, scene_.manifolds, narrow.a, narrow.b, narrow.contact))
      narrow.contact = {};
  for (const NarrowContact& narrow : narrow_contacts_) take_contact(narrow.a, narrow.b, narrow.contact);
}

/// Marks bodies that have passed through others in the step. Contacts are looked for along the velocities at its start:
/// a body that an impact deflects may be beyond another at the end, where no contact shows.
void NativeWorld::mark_tunnelled(double step) {
  const Bodies& bodies = scene_.bodies;
  const auto shift = [&](std::size_t i) -> Vec3 {
    if (moving_[i] == 0) return Vec3::Zero();
    return bodies.state.position[i] - before_.position[i];
  };
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (moving_[i] == 0 || (shift(i) - step * before_.velocity[i]).norm() <= terms_.fall_margin) continue;
    const OrientedBox& box = bodies.shape[i];
    for (std::size_t j = 0; j < bodies.count(); ++j) {
      const OrientedBox& other = bodies.shape[j];
      const Vec3 after = box.centre - other.centre;
      const Vec3 before = after - (shift(i) - shift(j));
      if (j == i || !(before.array() * after.array() < 0.0).any()) continue;
      const Vec3 room = box.bounding_half_extents() + other.bounding_half_extents();
      if (!have_passed(before, after, room, options_.missed_contact_overlap)) continue;
      const auto [first, second] = std::minmax({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
      if (pairs_.find(first, second) == PairTable::kNone) mark_failed(first, second);
    }
  }
}

}  // namespace holdfast::internal::native
