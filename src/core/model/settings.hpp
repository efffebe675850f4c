#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vector.hpp"
#include "core/model/container_shape.hpp"
#include "core/model/file_axes.hpp"
#include "core/model/friction_table.hpp"
#include "core/model/layout.hpp"
#include "core/model/material_name.hpp"

namespace holdfast::internal {

/// Which axis of a layout file points up.
enum class UpAxis { z, y };

/// How the container moves: with prescribed acceleration, or as a free body pushed over a ground.
enum class ContainerMotion { prescribed, free };

/// How the friction coefficient of a pair is found: as the product of its two sides, or by the kind of pair.
enum class FrictionModel { product, pairs };

/// When a world ends: at a time, or when all boxes have come to rest.
enum class StoppingCondition { timeout, sleeping };

/// What a world is asked, and may end early on: how its boxes end, whether one ever leaves its place, or ever falls.
enum class StopWhen { end, moved, fallen };

/// The pose that displacement is measured from: the layout's, or the one after settling under gravity alone.
enum class ReferencePose { layout, settled };

/// How work is spread over threads. Results do not depend on it.
enum class Scheduler {
  tbb,     ///< TBB's parallel pipeline: read and simulate, and compress, in parallel; one writer
  openmp,  ///< an OpenMP loop over the units; compressing and writing inside its ordered region
  serial,  ///< one after the other, on the calling thread
};

/// How Bullet puts bodies to sleep.
enum class BulletSleeping { off, wake_on_change };

/// The inside of the container and the way it moves; `[Container]`.
struct ContainerSettings : ContainerShape {
  double mass = 3700.0;                   ///< kg; used by a free container only
  double friction = 0.70710678118654757;  ///< of floor, walls and roof, one factor of a product
  double ground_friction = 0.6;           ///< of the ground under the container, one factor of a product
  ContainerMotion motion = ContainerMotion::prescribed;
  bool overrides_loads = false;  ///< a load's own container has no effect

  ContainerSettings() = default;
};

/// How files of loads are read, where they do not say it themselves; `[Loads]`.
struct LoadFileSettings {
  std::optional<double> unit;               ///< of lengths, m; absent: that of the file, else cm
  std::optional<FileAxes> axes;             ///< absent: by `Settings::up_axis`
  std::string format;                       ///< name of a known format of tables; empty: by the words of its header
  std::string columns;                      ///< words of the header and what they mean, see `parse_column_choice`
  std::optional<double> overlap_tolerance;  ///< overlaps up to it are trimmed, m; absent: 1 mm in files, none in memory
};

/// Contact laws; `[Contact]`.
struct ContactSettings {
  double restitution = 0.0;  ///< of every pair, unless a material has its own
  FrictionModel friction_model = FrictionModel::product;
  double box_box = 0.5;           ///< friction coefficient of two boxes, model `pairs`
  double box_floor = 0.5;         ///< friction coefficient of box and floor, model `pairs`
  double box_wall = 0.5;          ///< friction coefficient of box and wall or roof, model `pairs`
  FrictionTable materials;        ///< coefficients of pairs that are named, before the three above
  double mat_factor = 1.0;        ///< by which the coefficients of anti-slip mats are multiplied
  double kinetic_friction = 1.0;  ///< of surfaces that slide, over the coefficients above, which are static
};

/// Properties of the boxes of one material; `[Material N]`. Absent values come from the common keys.
struct MaterialSettings {
  std::optional<double> density;       ///< kg/m³; not together with mass
  std::optional<double> mass;          ///< kg per box
  std::optional<double> friction;      ///< of a box's surface, one factor of a product
  std::optional<double> restitution;   ///< of a box's surface
  bool fixed = false;                  ///< the boxes are part of the container
  Vec3 centre_of_mass = Vec3::Zero();  ///< offset from the centroid, axes of the container at the layout's pose, m
};

/// A norm that tests the sides of vehicle bodies or containers.
enum class WallNorm { en12642_l, en12642_xl, en283, iso_container };

/// Fewest replicas that can tell that a world holds: 26 without a failure reach up to 0.129, 27 up to 0.1246.
inline constexpr int kFewestReplicas = 27;

/// Which worlds to run, and how their results are judged; `[Screening]` and `[Simulation Settings]`.
struct ScreeningSettings {
  std::string layout;        ///< path for `holdfast run` on a single pair
  std::string acceleration;  ///< path for `holdfast run` on a single pair
  std::string norm;          ///< name for `find_norm`, whose accelerations come first; empty: none
  std::string engine = "native";
  int threads = 0;  ///< 0: one per core
  Scheduler scheduler = Scheduler::tbb;
  double settle_seconds = 2.0;   ///< longest time under gravity alone before t = 0, s
  double run_out_seconds = 5.0;  ///< longest time after the end of the acceleration, s
  ReferencePose reference_pose = ReferencePose::settled;
  double drop_threshold = 0.05;  ///< m
  double move_threshold = 0.10;  ///< m
  double tilt_threshold = 10.0;  ///< degrees
  StopWhen stop_when = StopWhen::end;
  bool margins = false;                   ///< also find how many g each layout stands
  int replicas = 0;                       ///< of each world, with friction drawn anew; 0: none
  double friction_spread = 0.1;           ///< standard deviation over mean of a friction coefficient in replicas
  double acceleration_spread = 0.0;       ///< the same of the accelerations
  double play_shift = 0.0;                ///< largest distance that replicas shift a box within the gaps around it, m
  bool first_failure = false;             ///< leave out the accelerations of a layout that has failed one
  bool wall_forces = false;               ///< also record the forces on the sides of the container
  std::optional<WallNorm> walls;          ///< the same, and compare them with the limits of a norm
  bool indicators = false;                ///< also tell what geometry alone says of layouts
  bool load_shift = false;                ///< also record how far the load's centre of gravity moves
  bool damage = false;                    ///< also record what impacts do to boxes
  double damage_window = 0.02;            ///< over which accelerations are averaged, s
  double critical_acceleration = 15.0;    ///< of the damage boundary, g
  double critical_velocity_change = 1.0;  ///< of the damage boundary, m/s

  bool measures_walls() const { return wall_forces || walls; }
};

/// Bullet's solver; `[Bullet]`. Absent values come from the engine's preset (`bullet`, `bullet-stock`).
struct BulletSettings {
  std::optional<double> steps_per_second;  ///< 1/s; overrides the common key
  std::optional<int> iterations;           ///< of the contact solver, per step
  std::optional<int> friction_directions;  ///< per contact point, 1 or 2
  std::optional<bool> random_order;        ///< whether each iteration visits the constraints in a new random order
  std::optional<bool> split_impulse;       ///< correct positions separately from velocities
  std::optional<double> split_impulse_threshold;  ///< split impulse acts on contacts with a smaller distance, m
  std::optional<double> erp;                      ///< fraction of a penetration corrected per step through velocities
  std::optional<double> erp2;                     ///< the same for split impulse
  std::optional<double> warm_start;               ///< fraction of the last step's impulses that the solver starts from
  std::optional<double> linear_slop;              ///< penetration slop, m
  std::optional<double> restitution_velocity;     ///< approach speed below which there is no rebound, m/s
  std::optional<BulletSleeping> sleeping;
};

/// Accuracy of the native engine: each value is a preset of step, tolerances and iteration limits.
enum class Accuracy { screening, standard, reference };

/// The native engine; `[Native]`. Absent values come from the accuracy.
struct NativeSettings {
  Accuracy accuracy = Accuracy::standard;
  std::optional<double> steps_per_second;  ///< 1/s; overrides the common key
  std::optional<double> tolerance;         ///< of the velocities at the end of a step, relative to |g − a| h
  std::optional<int> iterations;           ///< iteration limit of a solve
  std::optional<double>
      rest_tolerance;  ///< equilibrium residual below which a body is in equilibrium, relative to |g − a| m
  std::optional<int> impact_cuts;  ///< how many times impacts may divide a step of an island
  std::optional<bool> sleep;       ///< let slow bodies of large islands that move sleep
  bool jump = true;                ///< jump to the end of a phase when all islands are in equilibrium
  bool freeze = true;              ///< let islands in equilibrium sleep until something touches them
};

/// Bullet's pipeline on an OpenCL device; `[OpenCL]`.
struct OpenClSettings {
  std::string device;          ///< part of the device's name; empty: the first GPU, else the first device
  int iterations = 20;         ///< of the contact solver, per step; rounded up to a multiple of 4
  int layouts_per_batch = 16;  ///< layouts that are stepped together, each under all accelerations
};

/// All settings of a run: one member per key of config.ini, in SI units. `setting_table.hpp` declares the keys, with
/// units, defaults and ranges.
struct Settings {
  // [Physics Engine]
  double density_value = 250.0;  ///< kg/m³; kg per box when constant_density is false
  bool constant_density = true;
  std::optional<double> steps_per_second;  ///< 1/s; absent: the default of the engine (Bullet: 240)
  double gravity = 9.81;                   ///< m/s², along −z

  // [Renderer Engine]: accepted, without effect
  bool draw_axis = false;
  std::string texture_pack;
  bool use_renderer = false;

  // [Export Settings]
  double results_interval = 0.1;  ///< s
  std::string save_path = ".";

  // [Simulation Settings]
  StoppingCondition stopping_condition = StoppingCondition::timeout;
  std::optional<double> timeout;     ///< s; absent: the end of the acceleration file
  double sleeping_threshold = 0.01;  ///< m/s and rad/s
  bool batch_simulation = false;
  std::string batch_path;
  double box_friction = 0.70710678118654757;

  UpAxis up_axis = UpAxis::z;  ///< of layout files
  LoadFileSettings loads;
  ContainerSettings container;
  ContactSettings contact;
  std::map<MaterialName, MaterialSettings> materials;
  ScreeningSettings screening;
  NativeSettings native;
  BulletSettings bullet;
  OpenClSettings opencl;

  Settings() = default;
};

/// What holds for a box: its own values, else those of its material, else the common ones.
struct BoxProperties {
  double mass = 0.0;  ///< kg; of a fixed box without effect, as its centre of mass
  double friction = 0.0;
  double restitution = 0.0;
  Vec3 centre_of_mass = Vec3::Zero();  ///< offset from the middle of the box, m
  bool fixed = false;                  ///< part of the container
};
BoxProperties properties_of(const Settings& settings, const Box& box);

/// The friction of a material's surface, one factor of a product.
double friction_of(const Settings& settings, const MaterialName& material);

/// How the axes of files lie in the container.
FileAxes axes_of(const Settings& settings);

/// The container of a load: its own shape, unless the settings override it.
ContainerSettings container_of(const Settings& settings, const Layout& layout);

}  // namespace holdfast::internal
