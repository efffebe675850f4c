#include "core/native/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/contact_kinematics.hpp"

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

void Contacts::find(Scene& scene, const StepTerms& terms, const Connectivity& islands,
                    const std::vector<std::uint8_t>& moved) {
  const Bodies& bodies = scene.bodies;
  const std::size_t count = bodies.count();
  lower_.resize(count);
  upper_.resize(count);
  near_sides_.resize(count);
  narrow_.clear();
  missed_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const OrientedBox& box = bodies.shape[i];
    const double speed = bodies.largest_speed(i);
    const Vec3 extent = box.bounding_half_extents().array() + 0.5 * speculative_margin(terms, 2.0 * speed);
    lower_[i] = box.centre - extent;
    upper_[i] = box.centre + extent;
    if (moved[i] != 0 && bodies.activity[i] != Activity::fixed)
      update_sides(scene, terms, islands, i, speculative_margin(terms, speed));
  }
  // Ends pairs that are no longer near. Backwards, because the last manifold takes the index of one that ends.
  for (std::size_t m = scene.manifolds.size(); m-- > 0;) {
    const Manifold& manifold = scene.manifolds[m];
    const std::size_t b = at(manifold.b);
    if (manifold.with_side()) {
      if (moved[b] != 0 && (near_sides_[b] & 1U << side_of(manifold)) == 0) end_manifold(scene, m);
      continue;
    }
    const std::size_t a = at(manifold.a);
    const bool near = (lower_[a].array() <= upper_[b].array()).all() && (lower_[b].array() <= upper_[a].array()).all();
    if ((moved[a] != 0 || moved[b] != 0) && !near) end_manifold(scene, m);
  }
  for (const IndexPair& pair : broad_phase_.find_pairs(lower_, upper_, moved))
    if (bodies.activity[pair.i] != Activity::fixed || bodies.activity[pair.j] != Activity::fixed)
      update_pair(scene, terms, islands, static_cast<std::int32_t>(pair.i), static_cast<std::int32_t>(pair.j));
  // How far bodies have sunk is known when all other contacts are.
  scene.sinking.forget();
  for (Narrow& narrow : narrow_)
    if (scene.sinking.is_flush(bodies, scene.sides, scene.manifolds, narrow.a, narrow.b, narrow.contact))
      narrow.contact = {};
  for (const Narrow& narrow : narrow_) take(scene, islands, narrow.a, narrow.b, narrow.contact);
}

/// Contacts of a body with the sides that it is near: most are too far away for a closer look.
/// @param margin speculative margin with any side, m
void Contacts::update_sides(Scene& scene, const StepTerms& terms, const Connectivity& islands, std::size_t body,
                            double margin) {
  const OrientedBox& box = scene.bodies.shape[body];
  const Vec3 extent = box.bounding_half_extents();
  near_sides_[body] = 0;
  for (std::size_t s = 0; s < scene.sides.size(); ++s) {
    const Side& side = scene.sides[s];
    const double gap = side.space.normal.dot(box.centre) - side.space.normal.cwiseAbs().dot(extent) -
                       (side.space.offset - side.play[body]);
    if (gap > margin + kTouch) continue;
    if (side.block) {
      const Vec3 apart = (box.centre - side.block->centre).cwiseAbs() - side.block->half_extents - extent;
      if (apart.maxCoeff() > margin + kLeastPlay) continue;
    }
    near_sides_[body] |= static_cast<std::uint8_t>(1U << s);
    update_pair(scene, terms, islands, -1 - static_cast<std::int32_t>(s), static_cast<std::int32_t>(body));
  }
}

/// Finds the contact of a pair. One that is narrow is taken when all others are.
void Contacts::update_pair(Scene& scene, const StepTerms& terms, const Connectivity& islands, std::int32_t a,
                           std::int32_t b) {
  const Bodies& bodies = scene.bodies;
  const std::int32_t known = pairs_.find(a, b);
  const ContactAxis before = known < 0 ? ContactAxis{} : scene.manifolds[at(known)].contact.axis;
  const ContactSet contact = contact_now(bodies, scene.sides, a, b, speculative_margin(terms, bodies, a, b), before);
  const bool narrow = std::any_of(contact.widths.begin(), contact.widths.end(), [&](const ContactWidth& width) {
    return is_narrow(bodies, scene.sides, a, b, contact, width);
  });
  if (narrow) {
    narrow_.push_back({a, b, contact});
  } else {
    take(scene, islands, a, b, contact);
  }
}

/// Gives a pair the contact that has been found, and marks its bodies where it shows too late.
void Contacts::take(Scene& scene, const Connectivity& islands, std::int32_t a, std::int32_t b,
                    const ContactSet& contact) {
  const Bodies& bodies = scene.bodies;
  const std::int32_t known = pairs_.find(a, b);
  static const Manifold kNone;
  const Manifold& before = known < 0 ? kNone : scene.manifolds[at(known)];
  // What was solved with this contact would be solved with it again: the overlap is what the solve left.
  const bool solved = before.active && contact.axis == before.contact.axis &&
                      (islands.is_in_large_island(a) || islands.is_in_large_island(b));
  const double overlap = (solved ? kSolvedOverlap : 1.0) * missed_overlap_;
  if (is_missed_contact(contact, before.nearest_gap, overlap)) {
    mark_missed(bodies, a, b);
    if (!solved) late_.push_back({a, b, contact, poses_of(bodies, a, b)});
  }
  set_contact(scene, a, b, contact);
}

/// Gives a pair its contact.
void Contacts::set_contact(Scene& scene, std::int32_t a, std::int32_t b, const ContactSet& contact) {
  const std::int32_t known = pairs_.find(a, b);
  const Bodies& bodies = scene.bodies;
  if (known >= 0 && contact.count > 0) {
    Manifold& manifold = scene.manifolds[at(known)];
    if (upper_of(manifold.contact.normal) != upper_of(contact.normal)) turn_surfaces(scene, manifold, contact.normal);
    update_contact(manifold, contact, bodies);
  } else if (known >= 0) {
    end_manifold(scene, at(known));
  } else if (contact.count > 0) {
    pairs_.set(a, b, static_cast<std::int32_t>(scene.manifolds.size()));
    Manifold& manifold = scene.manifolds.emplace_back();
    manifold.a = a;
    manifold.b = b;
    set_surfaces(scene, manifold, contact.normal);
    update_contact(manifold, contact, bodies);
  }
}

void Contacts::end_manifold(Scene& scene, std::size_t index) {
  const Manifold& ended = scene.manifolds[index];
  pairs_.erase(ended.a, ended.b);
  if (index + 1 < scene.manifolds.size()) {
    const Manifold& last = scene.manifolds.back();
    pairs_.set(last.a, last.b, static_cast<std::int32_t>(index));
    scene.manifolds[index] = last;
  }
  scene.manifolds.pop_back();
}

void Contacts::end_separated_from_sleeping(Scene& scene) {
  const Bodies& bodies = scene.bodies;
  // Backwards, because the last manifold takes the index of one that ends.
  for (std::size_t m = scene.manifolds.size(); m-- > 0;) {
    const Manifold& manifold = scene.manifolds[m];
    if (manifold.contact.count == 0 && stays(bodies, manifold.a) && stays(bodies, manifold.b)) end_manifold(scene, m);
  }
}

void Contacts::find_tunnelled(const Scene& scene, const StepTerms& terms, const StateColumns& before) {
  const Bodies& bodies = scene.bodies;
  const auto shift = [&](std::size_t i) -> Vec3 {
    if (bodies.activity[i] != Activity::moving) return Vec3::Zero();
    return bodies.state.position[i] - before.position[i];
  };
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.activity[i] != Activity::moving) continue;
    if ((shift(i) - terms.step * before.velocity[i]).norm() <= terms.fall_margin) continue;
    const OrientedBox& box = bodies.shape[i];
    for (std::size_t j = 0; j < bodies.count(); ++j) {
      const OrientedBox& other = bodies.shape[j];
      const Vec3 after = box.centre - other.centre;
      const Vec3 apart = after - (shift(i) - shift(j));
      if (j == i || !(apart.array() * after.array() < 0.0).any()) continue;
      const Vec3 room = box.bounding_half_extents() + other.bounding_half_extents();
      if (!have_passed(apart, after, room, missed_overlap_)) continue;
      const auto [first, second] = std::minmax({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
      if (pairs_.find(first, second) == PairTable::kNone) mark_missed(bodies, first, second);
    }
  }
}

void Contacts::mark_missed(const Bodies& bodies, std::int32_t a, std::int32_t b) {
  const auto is_ahead = [&](std::int32_t body) { return body >= 0 && bodies.activity[at(body)] == Activity::ahead; };
  if (is_ahead(a) || is_ahead(b)) return;
  if (a >= 0) missed_[at(a)] = 1;
  missed_[at(b)] = 1;
}

void Contacts::forget_missed(std::size_t bodies) {
  missed_.assign(bodies, 0);
  late_.clear();
}

std::vector<Contacts::Late> Contacts::late_at_start(const Scene& scene) const {
  std::vector<Late> contacts = late_;
  for (Late& late : contacts) {
    late.contact = carried_along(late.contact, late.found_at, poses_of(scene.bodies, late.a, late.b));
    if (late.contact.nearest_gap() < -missed_overlap_) return {};
  }
  return contacts;
}

void Contacts::set(Scene& scene, const std::vector<Late>& contacts) {
  for (const Late& late : contacts) set_contact(scene, late.a, late.b, late.contact);
}

void Contacts::set_law(Scene& scene, const ContactSettings& law) {
  law_ = law;
  for (Manifold& manifold : scene.manifolds) {
    set_surfaces(scene, manifold, manifold.contact.normal);
    forget_forces(manifold);
  }
}

/// Gives a manifold the coefficients of its two surfaces.
/// @param normal of its contact, from a to b
void Contacts::set_surfaces(const Scene& scene, Manifold& manifold, const Vec3& normal) const {
  const std::vector<Surface>& surfaces = scene.bodies.surface;
  const Surface& on_a = manifold.with_side() ? scene.sides[side_of(manifold)].surface : surfaces[at(manifold.a)];
  const Surface& on_b = surfaces[at(manifold.b)];
  manifold.friction = friction_of_pair(law_, on_a, on_b, normal.z());
  manifold.kinetic_friction = law_.kinetic_friction * manifold.friction;
  manifold.restitution = restitution_of_pair(on_a, on_b);
}

/// Gives a manifold the coefficients of its contact's new normal: a mat acts only where its box stands on the other.
void Contacts::turn_surfaces(const Scene& scene, Manifold& manifold, const Vec3& normal) const {
  const double before = manifold.friction;
  set_surfaces(scene, manifold, normal);
  if (manifold.friction != before) forget_forces(manifold);
}

}  // namespace holdfast::internal::native
