#include <algorithm>
#include <array>
#include <optional>

#include "api/c_call.hpp"
#include "api/c_settings.hpp"

using namespace holdfast::internal;

namespace {

/// A world of the C interface.
struct CWorld : CObject {
  std::optional<holdfast::World> world;  ///< nothing when it could not be made

  holdfast::World& made() {
    if (!world) throw BadArgument{"the world could not be made"};
    return *world;
  }
};

/// Three numbers of the caller.
std::array<double, 3> three(const double* numbers, const char* name) {
  required(numbers, name);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

int holdfast_world_new(const holdfast_settings* settings, const double* boxes, size_t box_count, int unit,
                       const double* segments, size_t segment_count, holdfast_world** world) {
  if (world != nullptr) *world = nullptr;
  return with_settings(settings, [&](const std::vector<holdfast::Setting>& given) {
    return make_object<CWorld>(world, [&](CWorld& object) {
      object.world.emplace(layout_of("the layout", boxes, box_count),
                           acceleration_of("the acceleration", segments, segment_count), given, unit_of(unit));
      return HOLDFAST_OK;
    });
  });
}

int holdfast_world_new_of_layout(const holdfast_settings* settings, const holdfast_layouts* layout, int unit,
                                 const double* segments, size_t segment_count, holdfast_world** world) {
  if (world != nullptr) *world = nullptr;
  return with_settings(settings, [&](const std::vector<holdfast::Setting>& given) {
    return make_object<CWorld>(world, [&](CWorld& object) {
      object.world.emplace(only_layout_of(layout, "the layout"),
                           acceleration_of("the acceleration", segments, segment_count), given, unit_of(unit));
      return HOLDFAST_OK;
    });
  });
}

void holdfast_world_free(holdfast_world* world) { Handles<holdfast_world, CWorld>::all().remove(world); }

int holdfast_world_advance(holdfast_world* world, double time) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    object.made().advance(time);
    return HOLDFAST_OK;
  });
}

int holdfast_world_times(holdfast_world* world, double* time, double* end_time) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    if (time != nullptr) *time = object.made().time();
    if (end_time != nullptr) *end_time = object.made().end_time();
    return HOLDFAST_OK;
  });
}

int holdfast_world_poses(holdfast_world* world, double* poses, size_t capacity) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    const std::vector<holdfast::Pose> all = object.made().poses();
    require_room(capacity, all.size(), "poses");
    double* next = all.empty() ? poses : required(poses, "poses");
    for (const holdfast::Pose& pose : all) {
      next = std::copy(pose.position.begin(), pose.position.end(), next);
      next = std::copy(pose.orientation.begin(), pose.orientation.end(), next);
    }
    return HOLDFAST_OK;
  });
}

int holdfast_world_velocities(holdfast_world* world, double* velocities, size_t capacity) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    const std::vector<holdfast::Velocity> all = object.made().velocities();
    require_room(capacity, all.size(), "velocities");
    double* next = all.empty() ? velocities : required(velocities, "velocities");
    for (const holdfast::Velocity& velocity : all) {
      next = std::copy(velocity.linear.begin(), velocity.linear.end(), next);
      next = std::copy(velocity.angular.begin(), velocity.angular.end(), next);
    }
    return HOLDFAST_OK;
  });
}

int holdfast_world_set_acceleration(holdfast_world* world, const double* acceleration) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    object.made().set_acceleration(three(acceleration, "acceleration"));
    return HOLDFAST_OK;
  });
}

int holdfast_world_set_friction(holdfast_world* world, double box_box, double box_floor, double box_wall) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    object.made().set_friction(box_box, box_floor, box_wall);
    return HOLDFAST_OK;
  });
}

int holdfast_world_set_force(holdfast_world* world, size_t box, const double* force, const double* point) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    std::optional<std::array<double, 3>> where;
    if (point != nullptr) where = three(point, "point");
    object.made().set_force(box, three(force, "force"), where);
    return HOLDFAST_OK;
  });
}

int holdfast_world_side_forces(holdfast_world* world, double* forces, size_t capacity) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    const std::vector<std::array<double, 3>> all = object.made().side_forces();
    if (all.empty())
      throw BadArgument{"forces on sides are measured with the setting WallForces, by the engine native"};
    require_room(capacity, all.size(), "forces");
    double* next = required(forces, "forces");
    for (const std::array<double, 3>& force : all) next = std::copy(force.begin(), force.end(), next);
    return HOLDFAST_OK;
  });
}

int holdfast_world_hash(holdfast_world* world, uint64_t* hash) {
  return call_object<CWorld>(world, [&](CWorld& object) {
    *required(hash, "hash") = object.made().state_hash();
    return HOLDFAST_OK;
  });
}

const char* holdfast_world_message(const holdfast_world* world) { return message_of<CWorld>(world); }
