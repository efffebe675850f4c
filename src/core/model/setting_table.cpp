#include "core/model/setting_table.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/number_text.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/setting_kinds.hpp"

namespace holdfast::internal {

namespace {

using namespace setting_kinds;

template <class Kind, class Value>
std::string text_of(const Value& value) {
  return Kind::text(value);
}
template <class Kind, class Value>
std::string text_of(const std::optional<Value>& value) {
  return value ? Kind::text(*value) : std::string();
}

/// Completes a key. `Member` returns the key's member of the settings, or of the settings of one material.
template <class Kind, class Member>
SettingKey made_of(SettingKey key, Member) {
  key.accepted = Kind::kAccepted;
  if constexpr (std::is_invocable_v<Member, Settings&>) {
    key.set = [](Settings& settings, std::string_view, std::string_view text) {
      const auto value = Kind::parse(text);
      if (value) Member{}(settings) = *value;
      return value.has_value();
    };
    key.get = [](const Settings& settings, std::string_view) { return text_of<Kind>(Member{}(settings)); };
  } else {
    key.set = [](Settings& settings, std::string_view material, std::string_view text) {
      const auto value = Kind::parse(text);
      if (value) Member{}(settings.materials[MaterialName(material)]) = *value;
      return value.has_value();
    };
    key.get = [](const Settings& settings, std::string_view material) {
      const auto found = settings.materials.find(MaterialName(material));
      return found == settings.materials.end() ? std::string() : text_of<Kind>(Member{}(found->second));
    };
  }
  return key;
}

/// A const or a mutable `T`: members are found in both.
template <class S, class T>
concept Some = std::is_same_v<std::remove_const_t<S>, T>;

// Finds a key's member in the settings, or in those of one material.
#define MEMBER(expression) \
  [](Some<Settings> auto& s) -> auto& { return s.expression; }
#define OF_MATERIAL(expression) \
  [](Some<MaterialSettings> auto& m) -> auto& { return m.expression; }

bool is_any(const std::string& name) { return name == "any"; }

/// Where the coefficient of a pair is that names no material; null where it names one.
template <Some<Settings> S>
auto general_pair(S& settings, const FrictionPartners& partners) {
  auto& contact = settings.contact;
  if (!is_any(partners.first)) return decltype(&contact.box_box)(nullptr);
  if (is_any(partners.second)) return &contact.box_box;
  return partners.second == "floor" ? &contact.box_floor : &contact.box_wall;
}

bool set_pair(Settings& settings, std::string_view pair, std::string_view text) {
  const std::optional<FrictionPartners> partners = parse_partners(pair);
  const auto value = NamedFriction<OfPair>::parse(text);
  if (!partners || !value) return false;
  if (double* const general = general_pair(settings, *partners))
    *general = *value;
  else
    settings.contact.materials.set(*partners, *value);
  return true;
}

std::string get_pair(const Settings& settings, std::string_view pair) {
  const std::optional<FrictionPartners> partners = parse_partners(pair);
  if (!partners) return {};
  if (const double* const general = general_pair(settings, *partners)) return NamedFriction<OfPair>::text(*general);
  for (const FrictionTable::Row& row : settings.contact.materials.rows())
    if (row.partners == *partners) return NamedFriction<OfPair>::text(row.coefficient);
  return {};
}

std::vector<SettingKey> make_table() {
  std::vector<SettingKey> table;
  std::string_view section;
  const auto add = [&]<class Kind>(Kind, std::string_view name, std::string_view unit, std::string_view default_value,
                                   auto member, std::string_view sentence) -> SettingKey& {
    table.push_back(made_of<Kind>(
        {.section = section, .name = name, .unit = unit, .default_value = default_value, .sentence = sentence},
        member));
    return table.back();
  };

  section = "Physics Engine";
  add(Positive{}, "DensityValue", "kg/m³, or kg", "250", MEMBER(density_value),
      "Density of every box; with ConstantDensity = false, the mass of every box.");
  add(Truth{}, "ConstantDensity", "", "true", MEMBER(constant_density),
      "Whether DensityValue is a density, so that the mass of a box is proportional to its volume.");
  add(Rate{}, "SimulationStepsPerSecond", "1/s", "", MEMBER(steps_per_second),
      "Least number of steps per simulated second; when absent the engine decides (native by its Accuracy, Bullet "
      "240).");

  section = "Renderer Engine";
  add(Truth{}, "DrawAxis", "", "false", MEMBER(draw_axis), "A key of StableCargo's renderer.").without_effect = true;
  add(Text{}, "TexturePack", "", "", MEMBER(texture_pack), "A key of StableCargo's renderer.").without_effect = true;
  add(Truth{}, "UseRenderer", "", "false", MEMBER(use_renderer), "A key of StableCargo's renderer.").without_effect =
      true;

  section = "Export Settings";
  add(Interval{}, "ResultsIntervallInSeconds", "s", "0.1", MEMBER(results_interval),
      "Time between two samples in the results; it does not affect the motion.")
      .alias = "ResultsIntervalInSeconds";
  add(NeededPath{}, "SavePath", "", ".", MEMBER(save_path), "Folder that outputs are written to.");

  section = "Simulation Settings";
  add(OneOf<StoppingConditions>{}, "StoppingCondition", "", "timeout", MEMBER(stopping_condition),
      "Whether a world ends at a time, or already when all boxes have been slow for 0.5 s: `SleepingThreshold`.");
  add(Positive{}, "TimeoutInSeconds", "s", "", MEMBER(timeout),
      "Simulated time of a world; when absent, until its load rests after the acceleration, see `RunOutSeconds`.");
  add(NotNegative{}, "SleepingThreshold", "m/s and rad/s", "0.01", MEMBER(sleeping_threshold),
      "Speed below which a box is at rest for the stopping condition `sleeping`.");
  add(Truth{}, "BatchSimulation", "", "false", MEMBER(batch_simulation),
      "Whether `holdfast run` simulates all pairs of the files in BatchPath instead of one pair.");
  add(Path{}, "BatchPath", "", "", MEMBER(batch_path), "Folder with the layouts and accelerations of a batch.");
  add(NotNegative{}, "DropThreshold", "m", "0.05", MEMBER(screening.drop_threshold),
      "A box has fallen when its centre of mass is lower than at the start by more than this.");
  add(ContainerFactor{}, "ContainerFriction", "", "0.70710678118654757", MEMBER(container.friction),
      "Friction coefficient of floor, walls and roof; the coefficient of a contact is the product of its two sides.");
  add(ContainerFactor{}, "GroundFriction", "", "0.6", MEMBER(container.ground_friction),
      "Friction coefficient of the ground under a free container or one with an open or low side, one factor of a "
      "product.");
  add(NamedFriction<OfBox>{}, "BoxFriction", "", "0.70710678118654757", MEMBER(box_friction),
      "Friction coefficient of a box, one factor of a product: a named pair gives its square root, so that two such "
      "boxes have its coefficient; by default 0.5, that of cardboard-cardboard in the CTU Code.");

  section = "Container";
  add(ContainerTypeName{}, "Type", "", "", MEMBER(container.type),
      "A type of the catalogue that `holdfast containers` lists: its size, open sides and bed, where the keys below do "
      "not give them.");
  add(Centimetres<Positive>{}, "Length", "cm", "587", MEMBER(container.size.x()),
      "Inner length, along x from the front wall to the door.");
  add(Centimetres<Positive>{}, "Width", "cm", "233", MEMBER(container.size.y()),
      "Inner width, along y from left to right.");
  add(Centimetres<Positive>{}, "Height", "cm", "220", MEMBER(container.size.z()), "Inner height, along z.");
  add(Positive{}, "Mass", "kg", "3700", MEMBER(container.mass),
      "Mass of the empty container; it has an effect only when Motion is `free`.");
  add(OneOf<UpAxes>{}, "UpAxis", "", "z", MEMBER(up_axis), "Axis of the layout files that points up.");
  add(OneOf<ContainerMotions>{}, "Motion", "", "prescribed", MEMBER(container.motion),
      "Whether the container moves exactly as the acceleration file says, or is a free body that the force pushes over "
      "a ground.");
  add(Sides{}, "OpenSides", "", "", MEMBER(container.open_sides),
      "Sides without a wall, through which boxes may leave. The floor ends where the container ends.");
  add(DropSides{}, "DropSides", "cm", "", MEMBER(container.drop_sides),
      "Walls that are lower than the container, each with its height above the floor, such as `left 60 right 60`.");
  add(Centimetres<NotNegative>{}, "BedHeight", "cm", "120", MEMBER(container.bed_height),
      "Height of the floor above the ground, where a side is open or low: a box that gets out falls onto the ground, "
      "which moves with the container. With 0 the floor has no end.");

  section = "Loads";
  add(LengthUnitName{}, "Unit", "", "", MEMBER(loads.unit),
      "Unit of lengths in files of loads that do not say it themselves; when absent, cm.");
  add(Axes{}, "Axes", "", "", MEMBER(loads.axes),
      "Axes of files of loads that are the container's length, width and height, with a minus where one counts from "
      "the rear, the right wall or the roof: `-z x y`. UpAxis = y is `x -z y`.");
  add(Text{}, "Format", "", "", MEMBER(loads.format),
      "A known format of tables that `holdfast formats` lists; when absent, the words of the header tell.");
  add(Text{}, "Columns", "", "", MEMBER(loads.columns),
      "What columns of tables mean, where their words do not tell: `PosX = y, Artikel = name`.");
  add(Millimetres{}, "OverlapTolerance", "mm", "", MEMBER(loads.overlap_tolerance),
      "Overlaps up to this are trimmed, half from each box, with masses kept; when absent 1 mm in files, and up to "
      "0.1 mm is taken as rounding.");

  section = "Contact";
  add(Share{}, "Restitution", "", "0", MEMBER(contact.restitution),
      "Coefficient of restitution of every contact whose material does not have its own.");
  add(OneOf<FrictionModels>{}, "FrictionModel", "", "product", MEMBER(contact.friction_model),
      "Whether the friction coefficient of a contact is the product of its two sides, or is set per kind of pair. "
      "Where this key is not given, it is `pairs` as soon as BoxBox, BoxFloor or BoxWall is.");
  add(NamedFriction<OfPair>{}, "BoxBox", "", "0.5", MEMBER(contact.box_box),
      "Friction coefficient between two boxes when FrictionModel is `pairs`.");
  add(NamedFriction<OfPair>{}, "BoxFloor", "", "0.5", MEMBER(contact.box_floor),
      "Friction coefficient between box and floor when FrictionModel is `pairs`.");
  add(NamedFriction<OfPair>{}, "BoxWall", "", "0.5", MEMBER(contact.box_wall),
      "Friction coefficient between box and wall or roof when FrictionModel is `pairs`.");

  add(Share{}, "KineticFriction", "", "1", MEMBER(contact.kinetic_friction),
      "Kinetic friction over static friction, of every pair: surfaces that slide have this share of their coefficient; "
      "the CTU Code takes 0.75. An engine that cannot model it reports an error.");

  section = kFrictionSection;
  table.push_back({.section = section,
                   .name = kPairKey,
                   .accepted = OfPair::kAccepted,
                   .sentence =
                       "Friction coefficient of the materials A and B, such as `carton, pallet = 0.5`; `floor`, "
                       "`wall` and `any` may take the place of B.",
                   .set = set_pair,
                   .get = get_pair});

  section = kMaterialSection;
  add(Positive{}, "Density", "kg/m³", "", OF_MATERIAL(density),
      "Density of boxes of material N; when absent, DensityValue.");
  add(Positive{}, "Mass", "kg", "", OF_MATERIAL(mass), "Mass of each box of material N, instead of a density.");
  add(NamedFriction<OfBox>{}, "Friction", "", "", OF_MATERIAL(friction),
      "Friction coefficient of boxes of material N, one factor of a product as BoxFriction; when absent, BoxFriction.");
  add(Share{}, "Restitution", "", "", OF_MATERIAL(restitution),
      "Coefficient of restitution of boxes of material N; when absent, that of [Contact].");
  add(Truth{}, "Fixed", "", "false", OF_MATERIAL(fixed),
      "Whether boxes of material N are part of the container, such as a bulkhead, a wheel arch or cargo that is "
      "blocked: they do not move, and count in no verdict, weight or fill.");
  add(CentimetreVector{}, "CentreOfMass", "cm", "0 0 0", OF_MATERIAL(centre_of_mass),
      "Offset of the centre of mass from the middle of the box along the container's length, width and height as "
      "loaded; an engine that cannot model it reports an error.");

  section = "Screening";
  add(Path{}, "Layout", "", "", MEMBER(screening.layout), "Layout file of `holdfast run` for a single pair.");
  add(Path{}, "Acceleration", "", "", MEMBER(screening.acceleration),
      "Acceleration file of `holdfast run` for a single pair.");
  add(NormName{}, "Norm", "", "", MEMBER(screening.norm),
      "Norm whose accelerations a run has, before those of files; `holdfast norms` lists norms and their numbers.");
  add(Name<Engines>{}, "Engine", "", "native", MEMBER(screening.engine),
      "The engine that simulates the boxes; `holdfast engines` lists those that are available.");
  add(Whole<ThreadRange>{}, "Threads", "", "0", MEMBER(screening.threads),
      "Number of worlds simulated at the same time; 0 uses one thread per core.");
  add(OneOf<Schedulers>{}, "Scheduler", "", "tbb", MEMBER(screening.scheduler),
      "How worlds are distributed to threads; it does not affect the results.");
  add(NotNegative{}, "SettleSeconds", "s", "2", MEMBER(screening.settle_seconds),
      "Longest time under gravity alone before t = 0: the load settles until it rests. `holdfast run` and `holdfast "
      "validate` have 0 where this is not given.");
  add(NotNegative{}, "RunOutSeconds", "s", "5", MEMBER(screening.run_out_seconds),
      "Longest time after the end of the acceleration: the load moves on until it rests. Without effect where a "
      "timeout or StoppingCondition ends the world; `holdfast run` has 0 where this is not given.");
  add(OneOf<ReferencePoses>{}, "ReferencePose", "", "settled", MEMBER(screening.reference_pose),
      "The pose from which displacement is measured: that of the layout, or the one at t = 0, after settling.");
  add(NotNegative{}, "MoveThreshold", "m", "0.1", MEMBER(screening.move_threshold),
      "A box has moved when its displacement is larger than this.");
  add(Angle{}, "TiltThreshold", "°", "10", MEMBER(screening.tilt_threshold),
      "A box is tilted when it has rotated by more than this.");
  add(OneOf<StopConditions>{}, "StopWhen", "", "end", MEMBER(screening.stop_when),
      "When a world ends: at its end, or as soon as its verdict is decided, because a box is beyond any of the three "
      "limits (`moved`) or has fallen (`fallen`). Its verdict is then at least what it says.");
  add(Truth{}, "FirstFailure", "", "false", MEMBER(screening.first_failure),
      "Whether a layout that does not hold one acceleration is spared the others, whose status is `not_needed`.");
  add(Truth{}, "Margins", "", "false", MEMBER(screening.margins),
      "Whether the largest constant acceleration that each layout stands is found as well, towards the front, the "
      "rear, the left and the right; docs/guide/margins.md says what it means.");
  add(Truth{}, "WallForces", "", "false", MEMBER(screening.wall_forces),
      "Whether the forces of the boxes on the sides of the container are recorded; docs/guide/walls.md says what they "
      "mean.");
  add(OneOf<WallNorms>{}, "Walls", "", "", MEMBER(screening.walls),
      "The norm whose test forces the forces on the sides are compared with; they are then recorded as well.");
  add(Truth{}, "LoadShift", "", "false", MEMBER(screening.load_shift),
      "Whether the displacement of the load's centre of gravity is recorded; docs/guide/load_shift.md says what it "
      "means.");
  add(Truth{}, "Damage", "", "false", MEMBER(screening.damage),
      "Whether the accelerations and the impacts of boxes are recorded and compared with a damage boundary; "
      "docs/guide/damage.md says what they mean.");
  add(Milliseconds{}, "DamageWindow", "ms", "20", MEMBER(screening.damage_window),
      "Time over which the acceleration of a box is averaged.");
  add(NotNegative{}, "CriticalAcceleration", "g", "15", MEMBER(screening.critical_acceleration),
      "Acceleration of the damage boundary, in units of 9.81 m/s²: a box is beyond the boundary when this and "
      "CriticalVelocityChange are exceeded.");
  add(NotNegative{}, "CriticalVelocityChange", "m/s", "1", MEMBER(screening.critical_velocity_change),
      "Velocity change in an impact of the damage boundary.");
  add(Truth{}, "Indicators", "", "false", MEMBER(screening.indicators),
      "Whether base support, supported sides, centre of gravity and fill of the layouts are recorded, which geometry "
      "alone gives; docs/guide/indicators.md says what they mean.");
  add(ReplicaCount{}, "Replicas", "", "0", MEMBER(screening.replicas),
      "How often each world is simulated again with friction that is not known exactly; docs/guide/confidence.md says "
      "what is told. Drawing ends early where the answer is clear.");
  add(Spread{}, "FrictionSpread", "", "0.1", MEMBER(screening.friction_spread),
      "Standard deviation of a friction coefficient in replicas, divided by its mean.");
  add(Spread{}, "AccelerationSpread", "", "0", MEMBER(screening.acceleration_spread),
      "The same of a factor that scales a replica's acceleration.");
  add(NotNegative{}, "PlayShift", "m", "0", MEMBER(screening.play_shift),
      "Largest distance that replicas shift each box along and across the container, within the gaps around it.");
  add(NotNegative{}, "Gravity", "m/s²", "9.81", MEMBER(gravity), "Acceleration of free fall, downwards.");

  section = "Native";
  add(OneOf<Accuracies>{}, "Accuracy", "", "standard", MEMBER(native.accuracy),
      "A preset of step, tolerances and iteration limits, which the following keys change one by one; "
      "docs/physics/parameters.md has all of its numbers, and says what small and large islands are.");
  add(Rate{}, "StepsPerSecond", "1/s", "", MEMBER(native.steps_per_second),
      "Least number of steps per simulated second, instead of SimulationStepsPerSecond.");
  add(Positive{}, "Tolerance", "", "", MEMBER(native.tolerance),
      "Tolerance of the velocities at the end of a step, relative to the velocity that gravity and acceleration add in "
      "the step.");
  add(Whole<IterationRange>{}, "Iterations", "", "", MEMBER(native.iterations),
      "Iteration limit of the contact solver in a step, used when the residual is then acceptable.");
  add(Positive{}, "RestTolerance", "", "", MEMBER(native.rest_tolerance),
      "Largest net force on a box in static equilibrium, relative to its weight.");
  add(Whole<CutRange>{}, "ImpactCuts", "", "", MEMBER(native.impact_cuts),
      "How many times impacts may divide a step of an island. In large islands they do while the acceleration goes to "
      "and fro, and in islands of up to 16 boxes only. Where the acceleration oscillates, slips that end or turn may "
      "divide it twice as often.");
  add(Truth{}, "Sleep", "", "", MEMBER(native.sleep),
      "Whether slow boxes of islands of more than 16 sleep while others move: they stay where they are for some steps.");
  add(Truth{}, "Jump", "", "true", MEMBER(native.jump),
      "Whether time jumps to the next change of the acceleration when all boxes are in static equilibrium; it does not "
      "affect the results. With `StoppingCondition = sleeping` it does not jump.");
  add(Truth{}, "Freeze", "", "true", MEMBER(native.freeze),
      "Whether islands in static equilibrium sleep until something touches them; it does not affect the results.");

  section = "Bullet";
  add(Rate{}, "StepsPerSecond", "1/s", "", MEMBER(bullet.steps_per_second),
      "Least number of steps per simulated second, instead of SimulationStepsPerSecond; presets: bullet 240, "
      "bullet-stock 240.");
  add(Whole<IterationRange>{}, "Iterations", "", "", MEMBER(bullet.iterations),
      "Iterations of the contact solver per step; presets: bullet 50, bullet-stock 10.");
  add(Whole<DirectionRange>{}, "FrictionDirections", "", "", MEMBER(bullet.friction_directions),
      "Friction directions per contact point; presets: bullet 2, bullet-stock 1.");
  add(Truth{}, "RandomOrder", "", "", MEMBER(bullet.random_order),
      "Whether each iteration visits the contacts in a new random order; presets: bullet true, bullet-stock false.");
  add(Truth{}, "SplitImpulse", "", "", MEMBER(bullet.split_impulse),
      "Whether penetrations are corrected separately from velocities; presets: bullet true, bullet-stock true.");
  add(Any{}, "SplitImpulseThreshold", "m", "", MEMBER(bullet.split_impulse_threshold),
      "Distance below which SplitImpulse acts: 0 makes rebounds exact and prevents overlapping boxes from jumping "
      "apart, but increases creep; presets: bullet -0.04, bullet-stock -0.04.");
  add(Share{}, "Erp", "", "", MEMBER(bullet.erp),
      "Fraction of a penetration that is corrected per step through velocities; presets: bullet 0.2, bullet-stock "
      "0.2.");
  add(Share{}, "Erp2", "", "", MEMBER(bullet.erp2),
      "Fraction of a penetration that is corrected per step by SplitImpulse; presets: bullet 0.2, bullet-stock 0.2.");
  add(Share{}, "WarmStart", "", "", MEMBER(bullet.warm_start),
      "Fraction of the last step's impulses that the solver starts from; presets: bullet 0.85, bullet-stock 0.85.");
  add(NotNegative{}, "LinearSlop", "m", "", MEMBER(bullet.linear_slop),
      "Penetration slop: smaller penetrations are not corrected; presets: bullet 0, bullet-stock 0.");
  add(NotNegative{}, "RestitutionVelocity", "m/s", "", MEMBER(bullet.restitution_velocity),
      "Approach speed below which contacts do not rebound; presets: bullet 0.2, bullet-stock 0.2.");
  add(OneOf<BulletSleepings>{}, "Sleeping", "", "", MEMBER(bullet.sleeping),
      "Whether boxes at rest sleep until the acceleration changes; presets: bullet off, bullet-stock off.");

  section = "OpenCL";
  add(Text{}, "Device", "", "", MEMBER(opencl.device),
      "Part of the name of the device that bullet-opencl uses; when absent, the first GPU, or else the first device.");
  add(Whole<IterationRange>{}, "Iterations", "", "20", MEMBER(opencl.iterations),
      "Iterations of the contact solver of bullet-opencl per step, rounded up to a multiple of 4.");
  add(Whole<BatchRange>{}, "LayoutsPerBatch", "", "16", MEMBER(opencl.layouts_per_batch),
      "Number of layouts that bullet-opencl steps together, each under all accelerations; fewer if the device's memory "
      "is small.");
  return table;
}

#undef MEMBER
#undef OF_MATERIAL

}  // namespace

std::span<const SettingKey> setting_table() {
  static const std::vector<SettingKey> kTable = make_table();
  return kTable;
}

std::vector<std::string_view> setting_sections() {
  std::vector<std::string_view> sections;
  for (const SettingKey& key : setting_table())
    if (sections.empty() || sections.back() != key.section) sections.push_back(key.section);
  return sections;
}

const SettingKey* find_setting(std::string_view section, std::string_view name) {
  for (const SettingKey& key : setting_table())
    if (key.section == section && !name.empty() && (key.name == name || key.alias == name)) return &key;
  return nullptr;
}

std::optional<std::string> material_of_section(std::string_view section) {
  constexpr std::string_view kPrefix = "Material";
  if (!section.starts_with(kPrefix)) return std::nullopt;
  section.remove_prefix(kPrefix.size());
  const std::size_t begin = section.find_first_not_of(" \t");
  if (begin == 0 || begin == std::string_view::npos) return std::nullopt;
  const MaterialName name(section.substr(begin));
  // These stand for others in [Friction]; a comma separates the names there. No number but a whole one is a name.
  for (const char* const taken : {"any", "floor", "wall"})
    if (name.text() == taken) return std::nullopt;
  const bool is_odd_number = !name.is_number() && parse_number(name.text());
  return is_odd_number || name.text().find(',') != std::string::npos ? std::nullopt : std::optional(name.text());
}

std::optional<PlacedSetting> place_setting(std::string_view section, std::string_view name) {
  if (section == kFrictionSection) {
    const std::optional<FrictionPartners> partners = parse_partners(name);
    if (!partners) return std::nullopt;
    return PlacedSetting{find_setting(kFrictionSection, kPairKey), partners->text(), std::string(section),
                         partners->text()};
  }
  const std::optional<std::string> material = material_of_section(section);
  const SettingKey* const key = find_setting(material ? kMaterialSection : section, name);
  if (key == nullptr || (!material && key->section == kMaterialSection)) return std::nullopt;
  return PlacedSetting{key, material.value_or(""), material ? "Material " + *material : std::string(section),
                       std::string(key->name)};
}

std::vector<PlacedSetting> placed_settings(const Settings& settings) {
  std::vector<PlacedSetting> placed;
  for (const SettingKey& key : setting_table()) {
    if (key.section == kMaterialSection) continue;
    if (key.section != kFrictionSection) {
      placed.push_back({&key, "", std::string(key.section), std::string(key.name)});
      continue;
    }
    for (const FrictionTable::Row& row : settings.contact.materials.rows())
      placed.push_back({&key, row.partners.text(), std::string(key.section), row.partners.text()});
  }
  for (const auto& [name, material] : settings.materials)
    for (const SettingKey& key : setting_table())
      if (key.section == kMaterialSection)
        placed.push_back({&key, name.text(), "Material " + name.text(), std::string(key.name)});
  return placed;
}

std::vector<std::pair<std::string, std::string>> effective_settings(const Settings& settings) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const PlacedSetting& placed : placed_settings(settings))
    texts.emplace_back(placed.section + '/' + placed.name, placed.key->get(settings, placed.of));
  return texts;
}

std::vector<SettingConflict> choose_friction_model(Settings& settings, const GivenKeys& given) {
  std::vector<SettingConflict> conflicts;
  ContactSettings& contact = settings.contact;
  const bool chosen = given("Contact", "FrictionModel");
  const bool factors = given("Simulation Settings", "BoxFriction") || given("Simulation Settings", "ContainerFriction");

  // The keys of [Contact] are rows of [Friction] that name no material.
  struct Row {
    std::string section, name, same;
  };
  std::vector<Row> rows;
  for (const auto& [name, same] :
       {std::pair{"BoxBox", "any, any"}, std::pair{"BoxFloor", "any, floor"}, std::pair{"BoxWall", "any, wall"}}) {
    const bool as_key = given("Contact", name);
    const bool as_row = given(kFrictionSection, same);
    if (as_key) rows.push_back({"Contact", name, ""});
    if (as_row) rows.push_back({std::string(kFrictionSection), same, as_key ? name : ""});
  }
  for (const FrictionTable::Row& row : contact.materials.rows())
    rows.push_back({std::string(kFrictionSection), row.partners.text(), ""});
  // What is said of any two holds for floor and walls, where nothing is said of these.
  if (given(kFrictionSection, "any, any")) {
    if (!given(kFrictionSection, "any, floor") && !given("Contact", "BoxFloor")) contact.box_floor = contact.box_box;
    if (!given(kFrictionSection, "any, wall") && !given("Contact", "BoxWall")) contact.box_wall = contact.box_box;
  }

  for (const Row& row : rows) {
    if (!row.same.empty()) {
      conflicts.push_back({row.section, row.name,
                           Error{.what = "a coefficient is given twice",
                                 .value = '[' + row.section + "] " + row.name,
                                 .accepted = "give it here or as [Contact] " + row.same}});
      continue;
    }
    if (chosen && contact.friction_model == FrictionModel::pairs) continue;
    if (!chosen && !factors) {
      contact.friction_model = FrictionModel::pairs;
      continue;
    }
    const char* const what = chosen ? "a key has no effect while FrictionModel is product"
                                    : "a coefficient of a pair is given beside BoxFriction or ContainerFriction, which "
                                      "are factors of a product";
    conflicts.push_back({row.section, row.name,
                         Error{.what = what,
                               .value = '[' + row.section + "] " + row.name,
                               .accepted = chosen ? "remove it, or set FrictionModel = pairs"
                                                  : "set FrictionModel, or give the keys of one model"}});
  }
  return conflicts;
}

void apply_container_type(Settings& settings, const GivenKeys& given) {
  ContainerSettings& container = settings.container;
  const ContainerType* const type = find_container(container.type);
  if (type == nullptr) return;
  const ContainerShape shape = type->shape();
  const auto take = [&](const char* key, auto& to, const auto& from) {
    if (!given("Container", key)) to = from;
  };
  container.type = shape.type;
  take("Length", container.size.x(), shape.size.x());
  take("Width", container.size.y(), shape.size.y());
  take("Height", container.size.z(), shape.size.z());
  take("OpenSides", container.open_sides, shape.open_sides);
  if (given("Container", "DropSides") && !given("Container", "OpenSides")) close_drop_sides(container);
  take("BedHeight", container.bed_height, shape.bed_height);
}

std::vector<SettingConflict> check_settings(const Settings& settings) {
  std::vector<SettingConflict> conflicts;
  const auto add = [&](const std::string& section, const char* name, const char* what, const char* accepted) {
    conflicts.push_back(
        {section, name, Error{.what = what, .value = '[' + section + "] " + name, .accepted = accepted}});
  };
  for (const auto& [id, material] : settings.materials) {
    const std::string section = "Material " + id.text();
    if (material.density && material.mass)
      add(section, "Mass", "a material has both a mass and a density", "give only one of them");
    if (material.friction && settings.contact.friction_model == FrictionModel::pairs)
      add(section, "Friction", "a material has its own friction while FrictionModel is pairs",
          "remove it, or set FrictionModel = product");
  }
  if (const auto ambiguity = settings.contact.materials.ambiguity()) {
    const FrictionTable::Row& row = ambiguity->second;
    conflicts.push_back(
        {std::string(kFrictionSection), row.partners.text(),
         Error{.what = "two coefficients hold for one pair, and differ",
               .value = ambiguity->first.partners.text() + " and " + row.partners.text(),
               .accepted = "give that of `" + ambiguity->first.partners.first + ", " + row.partners.first + '`'}});
  }
  if (settings.loads.axes && settings.up_axis == UpAxis::y)
    add("Loads", "Axes", "both Axes and UpAxis say which axis points up", "give Axes alone; UpAxis = y is x -z y");
  for (const DropSide& drop : settings.container.drop_sides)
    if (std::find(settings.container.open_sides.begin(), settings.container.open_sides.end(), drop.side) !=
        settings.container.open_sides.end())
      add("Container", "DropSides", "a side is both open and a drop side", "give it in OpenSides or in DropSides");
  if (settings.batch_simulation && settings.batch_path.empty())
    add("Simulation Settings", "BatchSimulation", "a batch has no folder to read from",
        "give BatchPath, or set BatchSimulation = false");
  const ScreeningSettings& screening = settings.screening;
  if (screening.replicas > 0 && screening.friction_spread == 0.0 && screening.acceleration_spread == 0.0 &&
      screening.play_shift == 0.0)
    add("Screening", "Replicas", "replicas are all the same where neither friction, acceleration nor places vary",
        "leave Replicas out, or give FrictionSpread, AccelerationSpread or PlayShift");
  return conflicts;
}

}  // namespace holdfast::internal
