#include "io/loads/check_load.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "core/base/number_text.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/container_sides.hpp"
#include "core/model/layout_check.hpp"
#include "core/model/length_unit.hpp"
#include "core/model/overlap_trim.hpp"
#include "core/model/unlikely_settings.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

std::string box_name(const Layout& layout, std::size_t index) {
  const std::string& name = layout.boxes[index].name;
  return "box " + std::to_string(index + 1) + (name.empty() ? "" : " (" + shown(name) + ')');
}

std::string millimetres(double metres) { return rounded_text(metres * 1000.0) + " mm"; }

std::string size_text(const Vec3& size) {
  return rounded_text(size.x()) + " x " + rounded_text(size.y()) + " x " + rounded_text(size.z()) + " m";
}

/// Whether boxes have positive extents, and corners at which sums do not overflow.
bool is_sound(const Box& box) {
  return box.corner_min.allFinite() && box.corner_max.allFinite() && (box.corner_max - box.corner_min).minCoeff() > 0.0;
}

/// Whether a box, shown another way, is inside a container.
bool is_inside(const ContainerSettings& container, const Vec3& low, const Vec3& high) {
  for (const ContainerSide& side : kContainerSides) {
    const double depth = side.far ? high[side.axis] - container.size[side.axis] : -low[side.axis];
    if (depth > kLayoutTolerance + 1e-9 && !is_open(container, side) &&
        !is_above_drop_side(container, side, low.z() + kLayoutTolerance))
      return false;
  }
  return true;
}

/// Looks at a load as a whole.
class WholeLook {
 public:
  WholeLook(const ReadLoad& load, const std::string& path, const Settings& settings)
      : layout_(load.layout),
        path_(path),
        settings_(settings),
        container_(container_of(settings, load.layout)),
        guessed_unit_(load.guessed_unit) {}

  std::optional<Error> mistake() const {
    if (layout_.boxes.empty()) return std::nullopt;
    // Box by box is told what is wrong with single boxes.
    const bool sound = std::all_of(layout_.boxes.begin(), layout_.boxes.end(), is_sound);
    if (!sound) return sizes_as_corners();
    const std::size_t count = outside_count();
    if (count == 0) return all_tiny();
    constexpr std::size_t kWhole = 3;  // fewer are told one by one
    if (auto error = count < kWhole ? std::nullopt : another_container(count)) return error;
    if (auto error = another_unit()) return error;
    return count < kWhole ? std::nullopt : another_unit_and_container();
  }

  /// The same where the file, or the user, says the unit.
  std::optional<Error> tiny_in_stated_unit() const {
    if (guessed_unit_ > 0.0 || layout_.boxes.empty() || !has_no_large_box()) return std::nullopt;
    return Error{.file = path_,
                 .what = "all boxes are shorter than 5 cm",
                 .value = "all lie within " + size_text(reach()),
                 .accepted = "if the unit, or a mark of thousands, is another one: --unit, and numbers without marks"};
  }

  /// Boxes that are outside the container, fixed ones left out.
  std::size_t outside_count() const {
    return static_cast<std::size_t>(std::count_if(layout_.boxes.begin(), layout_.boxes.end(), [&](const Box& box) {
      return is_sound(box) && !is_inside(container_, box.corner_min, box.corner_max) &&
             !properties_of(settings_, box).fixed;
    }));
  }

 private:
  template <class Corners>
  bool all_inside(Corners corners) const {
    return std::all_of(layout_.boxes.begin(), layout_.boxes.end(), [&](const Box& box) {
      const auto [low, high] = corners(box);
      return is_inside(container_, low, high);
    });
  }

  /// The far corner of all boxes.
  Vec3 reach() const {
    Vec3 most = Vec3::Zero();
    for (const Box& box : layout_.boxes) most = most.cwiseMax(box.corner_max);
    return most;
  }

  /// A load in metres that is read as centimetres has no box longer than a few centimetres, near a corner.
  std::optional<Error> all_tiny() const {
    if (guessed_unit_ == 0.0 || !has_no_large_box()) return std::nullopt;
    return Error{.file = path_,
                 .what = "all boxes are shorter than 5 cm",
                 .value = "all lie within " + size_text(reach()),
                 .accepted = "if the lengths are metres: --unit m; --unit cm says that they are meant"};
  }

  /// Whether all boxes are shorter than 5 cm, and all lie within a tenth of the container.
  bool has_no_large_box() const {
    constexpr double kLongest = 0.05;  // m
    constexpr double kTenth = 0.1;
    const bool has_large = std::any_of(layout_.boxes.begin(), layout_.boxes.end(), [](const Box& box) {
      return (box.corner_max - box.corner_min).maxCoeff() >= kLongest;
    });
    return !has_large && (reach().array() <= kTenth * container_.size.array()).all();
  }

  std::optional<Error> another_unit() const {
    const double unit = guessed_unit_;
    if (unit == 0.0) return std::nullopt;
    for (const double other : {0.01, 0.001, 1.0, 0.0254}) {
      const double factor = other / unit;
      if (factor > 0.9) continue;  // boxes that are outside would be so all the more
      const Vec3 reached = factor * reach();
      // A load in that unit is none that is merely much smaller than the container.
      constexpr double kLeastShare = 0.1;
      if ((reached.array() >= kLeastShare * container_.size.array()).count() < 2) continue;
      if (!all_inside(
              [&](const Box& box) { return std::pair<Vec3, Vec3>(factor * box.corner_min, factor * box.corner_max); }))
        continue;
      return Error{.file = path_,
                   .what = "the boxes do not fit the container in " + length_unit_name(unit),
                   .value = "up to " + size_text(reach()),
                   .accepted = "everything fits if the lengths are " + length_unit_name(other) + ": --unit " +
                               length_unit_name(other)};
    }
    return std::nullopt;
  }

  /// The same in a container of the catalogue.
  std::optional<Error> another_unit_and_container() const {
    if (guessed_unit_ == 0.0) return std::nullopt;
    for (const double unit : {0.001, 0.0254}) {
      const double factor = unit / guessed_unit_;
      if (factor > 0.9) continue;
      const auto in_unit = [&](const Box& box) {
        return std::pair<Vec3, Vec3>(factor * box.corner_min, factor * box.corner_max);
      };
      const ContainerType* const type = holding_type(in_unit);
      // Not a load that is merely much smaller than the container.
      constexpr double kLeastShare = 0.4;
      const Vec3 reached = factor * reach();
      if (type == nullptr || (reached.array() >= kLeastShare * type->shape().size.array()).count() < 2) continue;
      const std::string name = length_unit_name(unit);
      return Error{.file = path_,
                   .what = "the boxes do not fit the container in " + length_unit_name(guessed_unit_),
                   .value = "up to " + size_text(reach()),
                   .accepted = "everything fits another one if the lengths are " + name + ": --unit " + name +
                               " --container " + std::string(type->name)};
    }
    return std::nullopt;
  }

  /// Numbers of a place and a size, read as two corners.
  std::optional<Error> sizes_as_corners() const {
    std::size_t impossible = 0;
    for (const Box& box : layout_.boxes) {
      if (!box.corner_min.allFinite() || !box.corner_max.allFinite()) return std::nullopt;
      if ((box.corner_max - box.corner_min).minCoeff() <= 0.0) ++impossible;
      if (box.corner_max.minCoeff() <= 0.0) return std::nullopt;
    }
    if (impossible == 0) return std::nullopt;
    if (!all_inside(
            [](const Box& box) { return std::pair<Vec3, Vec3>(box.corner_min, box.corner_min + box.corner_max); }))
      return std::nullopt;
    return Error{.file = path_,
                 .what = "the numbers seem to be places and sizes, and are read as two corners",
                 .value = std::to_string(impossible) + " boxes would have no extent",
                 .accepted = "name the columns in the first line: x y z length width height material"};
  }

  std::optional<Error> another_container(std::size_t outside) const {
    const ContainerType* const found =
        holding_type([](const Box& box) { return std::pair<Vec3, Vec3>(box.corner_min, box.corner_max); });
    if (found == nullptr) return std::nullopt;
    return Error{.file = path_,
                 .what = std::to_string(outside) + " of " + std::to_string(layout_.boxes.size()) +
                         " boxes are outside the container of " + size_text(container_.size),
                 .value = "up to " + size_text(reach()),
                 .accepted = "--container " + std::string(found->name) + " holds them"};
  }

  /// The first closed type that holds all boxes: the catalogue begins with what is most common. Null where none does.
  template <class Corners>
  const ContainerType* holding_type(Corners corners) const {
    const std::span<const ContainerType> types = container_catalogue();
    const auto found = std::find_if(types.begin(), types.end(), [&](const ContainerType& type) {
      ContainerSettings container;
      static_cast<ContainerShape&>(container) = type.shape();
      return container.open_sides.empty() &&
             std::all_of(layout_.boxes.begin(), layout_.boxes.end(), [&](const Box& box) {
               const auto [low, high] = corners(box);
               return is_inside(container, low, high);
             });
    });
    return found == types.end() ? nullptr : &*found;
  }

  const Layout& layout_;
  const std::string& path_;
  const Settings& settings_;
  ContainerSettings container_;
  double guessed_unit_;
};

/// Named materials that neither a section nor a pair of [Friction] describes, while others are described.
void warn_of_materials(const Layout& layout, const std::string& path, const Settings& settings,
                       std::vector<Error>& warnings) {
  const FrictionTable& pairs = settings.contact.materials;
  if (settings.materials.empty() && pairs.empty()) return;
  std::set<std::string> unknown;
  for (const Box& box : layout.boxes)
    if (!box.material.is_number() && !settings.materials.contains(box.material) &&
        pairs.index_of(box.material.text()) == FrictionTable::kOther)
      unknown.insert(box.material.text());
  if (unknown.empty()) return;
  std::string names;
  for (const std::string& name : unknown) names += (names.empty() ? "" : ", ") + shown(name);
  warnings.push_back(
      {.file = path,
       .what = unknown.size() == 1 ? "a material that is not described" : "materials that are not described",
       .value = names,
       .accepted = "the common keys hold; [Material " + *unknown.begin() + "] describes it"});
}

/// Weights that loads do not have, and boxes of which the file says none though it does of others.
void warn_of_weights(const Layout& layout, const std::string& path, const Settings& settings,
                     std::vector<Error>& warnings) {
  std::size_t weighed = 0;
  std::size_t cargo = 0;
  double mass = 0.0;
  double volume = 0.0;
  for (const Box& box : layout.boxes) {
    if (properties_of(settings, box).fixed) continue;
    ++cargo;
    if (!box.mass) continue;
    ++weighed;
    mass += *box.mass;
    volume += (box.corner_max - box.corner_min).prod();
  }
  if (weighed == 0) return;
  if (weighed < cargo)
    warnings.push_back(
        {.file = path,
         .what = std::to_string(cargo - weighed) + " of " + std::to_string(cargo) + " boxes have no weight",
         .accepted = "that of their material or of their volume is taken"});
  // Foam and lead: no average of a load is beyond them.
  constexpr double kLightest = 1.0;     // kg/m³
  constexpr double kHeaviest = 8000.0;  // kg/m³
  if (mass < kLightest * volume || mass > kHeaviest * volume)
    warnings.push_back({.file = path,
                        .what = "boxes of " + rounded_text(mass / volume) + " kg/m³ on the average",
                        .value = rounded_text(mass) + " kg in " + rounded_text(volume) + " m³",
                        .accepted = "if a unit is another one: --unit for lengths, and for weights a choice such as "
                                    "--columns \"Weight = weight (t)\""});
  const ContainerSettings container = container_of(settings, layout);
  const ContainerType* const type = find_container(container.type);
  if (type != nullptr && type->payload > 0.0 && mass > type->payload)
    warnings.push_back({.file = path,
                        .what = "the load weighs " + rounded_text(mass) + " kg",
                        .accepted = "a container of type " + std::string(type->name) + " carries " +
                                    rounded_text(type->payload) + " kg"});
}

/// What is unlikely about the load's own container; of that of the configuration its reader warns.
void warn_of_container(const Layout& layout, const std::string& path, const Settings& settings,
                       std::vector<Error>& warnings) {
  const std::vector<UnlikelySetting> known = unlikely_settings(settings.container, settings.screening);
  for (const UnlikelySetting& unlikely : unlikely_settings(container_of(settings, layout), settings.screening))
    if (std::none_of(known.begin(), known.end(),
                     [&](const UnlikelySetting& other) { return other.what == unlikely.what; }))
      warnings.push_back({.file = path, .what = std::string(unlikely.what)});
}

/// JSON pointer of a box; empty in other files.
/// @param number of the box, from 1
std::string pointer_of(const ReadLoad& load, long number) {
  const auto index = static_cast<std::size_t>(number - 1);
  if (!load.box_pointers.empty()) return load.box_pointers.at(index);
  return load.list_pointer.empty() ? "" : load.list_pointer + '/' + std::to_string(index);
}

void find_mistakes(ReadLoad& load, const std::string& path, const Settings& settings) {
  if (!load.errors.empty()) return;
  const double tolerance = settings.loads.overlap_tolerance.value_or(kFileOverlapTolerance);
  Layout& layout = load.layout;
  const WholeLook look(load, path, settings);
  if (const auto mistake = look.mistake()) {
    load.errors.push_back(*mistake);
    return;
  }
  load.outside = look.outside_count();
  if (const auto warning = look.tiny_in_stated_unit()) load.warnings.push_back(*warning);
  const Trimmed trimmed = trim_overlaps(layout, settings, tolerance);
  load.errors = check_layout(layout, settings, path, load.warnings);
  for (Error& error : load.errors)
    if (const std::string pointer = error.box > 0 ? pointer_of(load, error.box) : ""; !pointer.empty())
      error.what = shown(pointer) + ": " + error.what;
  if (!load.errors.empty()) return;
  if (trimmed.pairs > 0)
    load.warnings.push_back({.file = path,
                             .what = trimmed.pairs == 1 ? "an overlap is trimmed, half from each box, with masses kept"
                                                        : "overlaps are trimmed, half from each box, with masses kept",
                             .value = (trimmed.pairs == 1 ? "" : std::to_string(trimmed.pairs) + ", the largest ") +
                                      box_name(layout, trimmed.first) + " and " + box_name(layout, trimmed.second) +
                                      " by " + millimetres(trimmed.largest),
                             .accepted = "up to " + millimetres(tolerance) + " by [Loads] OverlapTolerance"});
  warn_of_materials(layout, path, settings, load.warnings);
  warn_of_weights(layout, path, settings, load.warnings);
  warn_of_container(layout, path, settings, load.warnings);
}

}  // namespace

void check_load(ReadLoad& load, const std::string& path, const Settings& settings) {
  find_mistakes(load, path, settings);
  const std::size_t own_name = load.layout.name.rfind('#');
  if (own_name == std::string::npos) return;
  for (Error& warning : load.warnings)
    if (warning.file == path) warning.file += shown(load.layout.name.substr(own_name));
}

}  // namespace holdfast::internal
