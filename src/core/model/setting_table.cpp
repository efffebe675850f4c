#include "core/model/setting_table.hpp"

#include <algorithm>
#include <optional>

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

/// Completes a key whose member `Member` finds in the settings, or in one material's settings.
template <class Kind, class Member>
SettingKey made_of(SettingKey key, Member) {
  key.accepted = Kind::kAccepted;
  if constexpr (std::is_invocable_v<Member, Settings&>) {
    key.set = [](Settings& settings, int, std::string_view text) {
      const auto value = Kind::parse(text);
      if (value) Member{}(settings) = *value;
      return value.has_value();
    };
    key.get = [](const Settings& settings, int) { return text_of<Kind>(Member{}(settings)); };
  } else {
    key.set = [](Settings& settings, int material, std::string_view text) {
      const auto value = Kind::parse(text);
      if (value) Member{}(settings.materials[material]) = *value;
      return value.has_value();
    };
    key.get = [](const Settings& settings, int material) {
      const auto found = settings.materials.find(material);
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
      "Density of every box; with ConstantDensity = false the mass of every box instead.");
  add(Truth{}, "ConstantDensity", "", "true", MEMBER(constant_density),
      "Whether DensityValue is a density, so that the mass of a box follows from its volume.");
  add(Rate{}, "SimulationStepsPerSecond", "1/s", "", MEMBER(steps_per_second),
      "Least number of steps a simulated second; when absent the engine decides (native by its Accuracy, Bullet 240).");

  section = "Renderer Engine";
  add(Truth{}, "DrawAxis", "", "false", MEMBER(draw_axis), "Of the renderer of StableCargo.").without_effect = true;
  add(Text{}, "TexturePack", "", "", MEMBER(texture_pack), "Of the renderer of StableCargo.").without_effect = true;
  add(Truth{}, "UseRenderer", "", "false", MEMBER(use_renderer), "Of the renderer of StableCargo.").without_effect =
      true;

  section = "Export Settings";
  add(Interval{}, "ResultsIntervallInSeconds", "s", "0.1", MEMBER(results_interval),
      "Time between two samples in the results; never changes the motion.")
      .alias = "ResultsIntervalInSeconds";
  add(NeededPath{}, "SavePath", "", ".", MEMBER(save_path), "Folder of the outputs.");

  section = "Simulation Settings";
  add(OneOf<StoppingConditions>{}, "StoppingCondition", "", "timeout", MEMBER(stopping_condition),
      "Whether a world ends at a time, or already when all boxes have come to rest.");
  add(Positive{}, "TimeoutInSeconds", "s", "", MEMBER(timeout),
      "Simulated time; when absent the end of the acceleration file.");
  add(NotNegative{}, "SleepingThreshold", "m/s and rad/s", "0.01", MEMBER(sleeping_threshold),
      "Speed below which a box is at rest for the stopping condition `sleeping`.");
  add(Truth{}, "BatchSimulation", "", "false", MEMBER(batch_simulation),
      "Whether `holdfast run` takes all pairs of the files in BatchPath instead of one pair.");
  add(Path{}, "BatchPath", "", "", MEMBER(batch_path), "Folder with layouts and accelerations of a batch.");
  add(NotNegative{}, "DropThreshold", "m", "0.05", MEMBER(screening.drop_threshold),
      "A box has fallen when its centre of mass is lower than at the start by more.");
  add(NotNegative{}, "ContainerFriction", "", "0.70710678118654757", MEMBER(container.friction),
      "Friction of floor, walls and roof; that of a contact is the product of its two sides.");
  add(NotNegative{}, "GroundFriction", "", "0.6", MEMBER(container.ground_friction),
      "Friction of the ground under a free container, one side of a product.");
  add(NotNegative{}, "BoxFriction", "", "0.70710678118654757", MEMBER(box_friction),
      "Friction of a box; 0.5 for a pair of boxes by default, cardboard on cardboard in the CTU Code.");

  section = "Container";
  add(Centimetres<Positive>{}, "Length", "cm", "587", MEMBER(container.size.x()),
      "Inner length, along x from the front wall to the door.");
  add(Centimetres<Positive>{}, "Width", "cm", "233", MEMBER(container.size.y()),
      "Inner width, along y from left to right.");
  add(Centimetres<Positive>{}, "Height", "cm", "220", MEMBER(container.size.z()), "Inner height, along z.");
  add(Positive{}, "Mass", "kg", "3700", MEMBER(container.mass),
      "Mass of the empty container; matters when Motion is `free` only.");
  add(OneOf<UpAxes>{}, "UpAxis", "", "z", MEMBER(up_axis), "Axis of the layout files that points up.");
  add(OneOf<ContainerMotions>{}, "Motion", "", "prescribed", MEMBER(container.motion),
      "Whether the container moves exactly as the acceleration file says, or is a free body that is pushed over a "
      "ground.");
  add(Sides{}, "OpenSides", "", "", MEMBER(container.open_sides),
      "Sides without a wall, through which boxes may leave.");

  section = "Contact";
  add(Share{}, "Restitution", "", "0", MEMBER(contact.restitution),
      "Coefficient of restitution of every contact, unless a material has its own.");
  add(OneOf<FrictionModels>{}, "FrictionModel", "", "product", MEMBER(contact.friction_model),
      "Whether the friction of a contact is the product of its two sides, or given by the kind of the pair.");
  add(NotNegative{}, "BoxBox", "", "0.5", MEMBER(contact.box_box),
      "Friction between two boxes when FrictionModel is `pairs`.");
  add(NotNegative{}, "BoxFloor", "", "0.5", MEMBER(contact.box_floor),
      "Friction between box and floor when FrictionModel is `pairs`.");
  add(NotNegative{}, "BoxWall", "", "0.5", MEMBER(contact.box_wall),
      "Friction between box and wall or roof when FrictionModel is `pairs`.");

  section = kMaterialSection;
  add(Positive{}, "Density", "kg/m³", "", OF_MATERIAL(density),
      "Density of boxes of material N; when absent DensityValue holds.");
  add(Positive{}, "Mass", "kg", "", OF_MATERIAL(mass), "Mass of each box of material N, in place of a density.");
  add(NotNegative{}, "Friction", "", "", OF_MATERIAL(friction),
      "Friction of boxes of material N, one side of a product; when absent BoxFriction holds.");
  add(Share{}, "Restitution", "", "", OF_MATERIAL(restitution),
      "Restitution of boxes of material N; when absent that of [Contact] holds.");
  add(CentimetreVector{}, "CentreOfMass", "cm", "0 0 0", OF_MATERIAL(centre_of_mass),
      "Offset of the centre of mass from the middle of the box along the container's length, width and height as "
      "loaded; an engine that cannot model it refuses.");

  section = "Screening";
  add(Path{}, "Layout", "", "", MEMBER(screening.layout), "Layout file of `holdfast run` for a single pair.");
  add(Path{}, "Acceleration", "", "", MEMBER(screening.acceleration),
      "Acceleration file of `holdfast run` for a single pair.");
  add(Name<Engines>{}, "Engine", "", "native", MEMBER(screening.engine),
      "What moves the boxes; `holdfast engines` lists what is there.");
  add(Whole<ThreadRange>{}, "Threads", "", "0", MEMBER(screening.threads),
      "Worlds simulated at the same time; 0 stands for one a core.");
  add(OneOf<Schedulers>{}, "Scheduler", "", "tbb", MEMBER(screening.scheduler),
      "How worlds are handed out to threads; never changes a result.");
  add(NotNegative{}, "SettleSeconds", "s", "0", MEMBER(screening.settle_seconds),
      "Time under gravity alone before t = 0, not recorded.");
  add(OneOf<ReferencePoses>{}, "ReferencePose", "", "layout", MEMBER(screening.reference_pose),
      "What displacement is measured from: the pose in the layout, or the one after settling.");
  add(NotNegative{}, "MoveThreshold", "m", "0.1", MEMBER(screening.move_threshold),
      "A box has moved when it is displaced by more.");
  add(Angle{}, "TiltThreshold", "°", "10", MEMBER(screening.tilt_threshold),
      "A box is tilted when it is rotated by more.");
  add(NotNegative{}, "Gravity", "m/s²", "9.81", MEMBER(gravity), "Acceleration of free fall, downwards.");

  section = "Native";
  add(OneOf<Accuracies>{}, "Accuracy", "", "standard", MEMBER(native.accuracy),
      "Set of step, tolerances and caps that the following keys change one by one; docs/physics.md has the table.");
  add(Rate{}, "StepsPerSecond", "1/s", "", MEMBER(native.steps_per_second),
      "Least number of steps a simulated second, instead of SimulationStepsPerSecond; screening 60, standard 240, "
      "reference 1440.");
  add(Positive{}, "Tolerance", "", "", MEMBER(native.tolerance),
      "Error left in a moving step's velocities, in units of what gravity and acceleration add in the step; "
      "screening 0.0001, or 0.001 with more than 8 boxes in contact; standard 0.0001, reference 1e-9.");
  add(Whole<IterationRange>{}, "Iterations", "", "", MEMBER(native.iterations),
      "Most iterations of the contact solver in a moving step, where what is left may pass; with up to 8 boxes in "
      "contact and with more: screening 60 and 8, standard 60 and 30, reference 400 and 400.");
  add(Positive{}, "RestTolerance", "", "", MEMBER(native.rest_tolerance),
      "Largest force left on a box that is proved to rest, in units of its weight; screening 1e-6, standard 1e-8, "
      "reference 1e-9.");
  add(Whole<CutRange>{}, "ImpactCuts", "", "", MEMBER(native.impact_cuts),
      "Times that impacts may cut a step of boxes in contact; screening 8, or 0 with more than 8 boxes; standard 8, "
      "reference 32.");
  add(Truth{}, "Jump", "", "true", MEMBER(native.jump),
      "Whether time goes on to the next change of the acceleration at once while everything rests; never changes a "
      "result.");
  add(Truth{}, "Freeze", "", "true", MEMBER(native.freeze),
      "Whether boxes that rest are left alone until something touches them; never changes a result.");

  section = "Bullet";
  add(Rate{}, "StepsPerSecond", "1/s", "", MEMBER(bullet.steps_per_second),
      "Least number of steps a simulated second, instead of SimulationStepsPerSecond; presets: bullet 240, "
      "bullet-stock 240.");
  add(Whole<IterationRange>{}, "Iterations", "", "", MEMBER(bullet.iterations),
      "Iterations of the contact solver a step; presets: bullet 50, bullet-stock 10.");
  add(Whole<DirectionRange>{}, "FrictionDirections", "", "", MEMBER(bullet.friction_directions),
      "Friction directions a contact point; presets: bullet 2, bullet-stock 1.");
  add(Truth{}, "RandomOrder", "", "", MEMBER(bullet.random_order),
      "Whether each iteration takes the contacts in a new random order; presets: bullet true, bullet-stock false.");
  add(Truth{}, "SplitImpulse", "", "", MEMBER(bullet.split_impulse),
      "Whether penetrations are corrected apart from velocities; presets: bullet true, bullet-stock true.");
  add(Any{}, "SplitImpulseThreshold", "m", "", MEMBER(bullet.split_impulse_threshold),
      "Distance below which SplitImpulse acts: 0 makes rebounds exact and keeps overlaps from popping, at the price of "
      "creep; presets: bullet -0.04, bullet-stock -0.04.");
  add(Share{}, "Erp", "", "", MEMBER(bullet.erp),
      "Share of a penetration corrected a step through velocities; presets: bullet 0.2, bullet-stock 0.2.");
  add(Share{}, "Erp2", "", "", MEMBER(bullet.erp2),
      "Share of a penetration corrected a step by SplitImpulse; presets: bullet 0.2, bullet-stock 0.2.");
  add(Share{}, "WarmStart", "", "", MEMBER(bullet.warm_start),
      "Share of the last step's impulses that the solver starts from; presets: bullet 0.85, bullet-stock 0.85.");
  add(NotNegative{}, "LinearSlop", "m", "", MEMBER(bullet.linear_slop),
      "Penetration that is left alone; presets: bullet 0, bullet-stock 0.");
  add(NotNegative{}, "RestitutionVelocity", "m/s", "", MEMBER(bullet.restitution_velocity),
      "Approach speed below which nothing rebounds; presets: bullet 0.2, bullet-stock 0.2.");
  add(OneOf<BulletSleepings>{}, "Sleeping", "", "", MEMBER(bullet.sleeping),
      "Whether boxes at rest sleep until the acceleration changes; presets: bullet off, bullet-stock off.");

  section = "OpenCL";
  add(Text{}, "Device", "", "", MEMBER(opencl.device),
      "Part of the name of the device that bullet-opencl runs on; when absent the first GPU, else the first device.");
  add(Whole<IterationRange>{}, "Iterations", "", "20", MEMBER(opencl.iterations),
      "Iterations of the contact solver of bullet-opencl a step, rounded up to a multiple of 4.");
  add(Whole<BatchRange>{}, "LayoutsPerBatch", "", "16", MEMBER(opencl.layouts_per_batch),
      "Layouts that bullet-opencl steps together, each under all accelerations; less where the device's memory is "
      "short.");
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

std::vector<std::pair<std::string, std::string>> effective_settings(const Settings& settings) {
  std::vector<std::pair<std::string, std::string>> texts;
  const auto add = [&](const std::string& section, const SettingKey& key, int material) {
    texts.emplace_back(section + '/' + std::string(key.name), key.get(settings, material));
  };
  for (const SettingKey& key : setting_table())
    if (key.section != kMaterialSection) add(std::string(key.section), key, 0);
  for (const auto& [id, material] : settings.materials)
    for (const SettingKey& key : setting_table())
      if (key.section == kMaterialSection) add("Material " + std::to_string(id), key, id);
  return texts;
}

std::vector<SettingConflict> check_settings(const Settings& settings) {
  std::vector<SettingConflict> conflicts;
  const auto add = [&](const std::string& section, const char* name, const char* what, const char* accepted) {
    conflicts.push_back(
        {section, name, Error{.what = what, .value = '[' + section + "] " + name, .accepted = accepted}});
  };
  for (const auto& [id, material] : settings.materials) {
    const std::string section = "Material " + std::to_string(id);
    if (material.density && material.mass)
      add(section, "Mass", "a material has both a mass and a density", "give one of them");
    if (material.friction && settings.contact.friction_model == FrictionModel::pairs)
      add(section, "Friction", "a material has a friction of its own while FrictionModel is pairs",
          "leave it out, or take FrictionModel = product");
  }
  if (settings.batch_simulation && settings.batch_path.empty())
    add("Simulation Settings", "BatchSimulation", "a batch has no folder to read from",
        "give BatchPath, or take BatchSimulation = false");
  if (settings.screening.reference_pose == ReferencePose::settled && settings.screening.settle_seconds == 0.0)
    add("Screening", "ReferencePose", "the settled pose is asked for without time to settle",
        "give SettleSeconds, or take ReferencePose = layout");
  return conflicts;
}

}  // namespace holdfast::internal
