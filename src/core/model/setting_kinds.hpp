#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/container_sides.hpp"
#include "core/model/friction_pairs.hpp"
#include "core/model/length_unit.hpp"
#include "core/model/norms.hpp"
#include "core/model/settings.hpp"
#include "core/model/wrapped_text.hpp"

/// Kinds of values that a key may have. A kind has `kAccepted`, the clause for messages; `parse(text)`, which returns
/// an optional value; and `text(value)`, the value as one would write it in the file.
namespace holdfast::internal::setting_kinds {

/// A number for which `Range::holds`.
template <class Range>
struct Number : Range {
  static std::optional<double> parse(std::string_view text) {
    const std::optional<double> number = parse_number(text);
    return number && Range::holds(*number) ? number : std::nullopt;
  }
  static std::string text(double number) { return number_text(number); }
};

// A value above a million in any unit is a mistake: the run would never end, or products would overflow.
struct AnyRange {
  static constexpr std::string_view kAccepted = "a number from -1000000 to 1000000";
  static bool holds(double number) { return std::abs(number) <= 1e6; }
};
struct PositiveRange {
  static constexpr std::string_view kAccepted = "a number from 1e-12 to 1000000";
  static bool holds(double number) { return number >= 1e-12 && number <= 1e6; }
};
struct NotNegativeRange {
  static constexpr std::string_view kAccepted = "a number from 0 to 1000000";
  static bool holds(double number) { return number >= 0.0 && number <= 1e6; }
};
struct ShareRange {
  static constexpr std::string_view kAccepted = "a number from 0 to 1";
  static bool holds(double number) { return number >= 0.0 && number <= 1.0; }
};
struct AngleRange {
  static constexpr std::string_view kAccepted = "a number from 0 to 180";
  static bool holds(double number) { return number >= 0.0 && number <= 180.0; }
};
struct CoefficientRange {
  static constexpr std::string_view kAccepted = "a number from 0 to 10";
  static bool holds(double number) { return number >= 0.0 && number <= kLargestFriction; }
};
struct RateRange {
  static constexpr std::string_view kAccepted = "a number from 1 to 1000000";
  static bool holds(double number) { return number >= 1.0 && number <= 1e6; }
};
struct SpreadRange {
  static constexpr std::string_view kAccepted = "a number from 0 to 0.3";
  static bool holds(double number) { return number >= 0.0 && number <= 0.3; }
};
struct IntervalRange {
  static constexpr std::string_view kAccepted = "a number from 0.000001 to 1000000";
  static bool holds(double number) { return number >= 1e-6 && number <= 1e6; }
};

using Any = Number<AnyRange>;
using Positive = Number<PositiveRange>;
using Coefficient = Number<CoefficientRange>;
using NotNegative = Number<NotNegativeRange>;
using Share = Number<ShareRange>;
using Angle = Number<AngleRange>;
using Rate = Number<RateRange>;
using Spread = Number<SpreadRange>;
using Interval = Number<IntervalRange>;

/// The number of centimetres that gives exactly these metres when it is divided by 100, where there is one.
inline double centimetres(double metres) {
  const double rounded = std::round(metres * 1e11) / 1e9;
  return rounded / 100.0 == metres ? rounded : metres * 100.0;
}

/// Text of a length in centimetres; reading it gives exactly `metres`.
inline std::string centimetre_text(double metres) { return number_text(centimetres(metres)); }

/// A length that the file gives in centimetres. Divided by 100, so that 587 gives the double nearest to 5.87.
template <class Kind>
struct Centimetres : Kind {
  static std::optional<double> parse(std::string_view text) {
    const std::optional<double> number = Kind::parse(text);
    return number ? std::optional(*number / 100.0) : std::nullopt;
  }
  static std::string text(double metres) { return centimetre_text(metres); }
};

/// A length that the file gives in millimetres, up to 10 cm.
struct Millimetres {
  static constexpr std::string_view kAccepted = "a number from 0 to 100";
  static std::optional<double> parse(std::string_view text) {
    const std::optional<double> number = parse_number(text);
    return number && *number >= 0.0 && *number <= 100.0 ? std::optional(*number / 1000.0) : std::nullopt;
  }
  static std::string text(double metres) {
    const double rounded = std::round(metres * 1e12) / 1e9;
    return number_text(rounded / 1000.0 == metres ? rounded : metres * 1000.0);
  }
};

/// A unit of length, in metres.
struct LengthUnitName {
  static constexpr std::string_view kAccepted = "m, dm, cm, mm, in or ft";
  static std::optional<double> parse(std::string_view text) { return length_unit(text); }
  static std::string text(double metres) { return length_unit_name(metres); }
};

/// Axes of a file.
struct Axes {
  static constexpr std::string_view kAccepted =
      "x, y and z in the order of length, width and height, each with a minus where it counts from the far side, such "
      "as -z x y";
  static std::optional<FileAxes> parse(std::string_view text) { return parse_axes(text); }
  static std::string text(const FileAxes& axes) { return axes_text(axes); }
};

/// A time that the file gives in milliseconds. Divided by 1000, so that 20 gives the double nearest to 0.02.
struct Milliseconds {
  static constexpr std::string_view kAccepted = "a number from 0.1 to 1000";
  static std::optional<double> parse(std::string_view text) {
    const std::optional<double> number = parse_number(text);
    return number && *number >= 0.1 && *number <= 1000.0 ? std::optional(*number / 1000.0) : std::nullopt;
  }
  static std::string text(double seconds) {
    const double rounded = std::round(seconds * 1e12) / 1e9;
    return number_text(rounded / 1000.0 == seconds ? rounded : seconds * 1000.0);
  }
};

/// A friction coefficient, or a name that `find` knows.
template <class List>
struct NamedFriction : List {
  static std::optional<double> parse(std::string_view text) {
    const std::optional<double> named = List::find(text);
    return named ? named : Coefficient::parse(text);
  }
  static std::string text(double number) { return Coefficient::text(number); }
};

/// The coefficient of a pair.
struct OfPair {
  static constexpr std::string_view kAccepted =
      "a number from 0 to 10, or the name of a pair that `holdfast norms` lists, such as cardboard-pallet";
  static std::optional<double> find(std::string_view name) { return friction_of_pair_name(name); }
};
/// The factor of a box.
struct OfBox {
  static constexpr std::string_view kAccepted =
      "a number from 0 to 10, or a pair of one material with itself, such as cardboard-cardboard; other pairs are "
      "for BoxBox, BoxFloor and BoxWall with FrictionModel = pairs";
  static std::optional<double> find(std::string_view name) { return friction_factor_of_name(name); }
};
/// The factor of the container or the ground: no name says what it is without the box.
struct ContainerFactor : Coefficient {
  static constexpr std::string_view kAccepted =
      "a number from 0 to 10; names of pairs are for BoxFloor and BoxWall with FrictionModel = pairs";
};

/// Three lengths in centimetres. A comma does not separate them: `1,5 0` must not be read as three numbers.
struct CentimetreVector {
  static constexpr std::string_view kAccepted = "three numbers separated by spaces";
  static std::optional<Vec3> parse(std::string_view text) {
    const std::vector<std::string_view> words = words_of(text, " \t");
    if (words.size() != 3) return std::nullopt;
    Vec3 vector;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> number = parse_number(words[i]);
      if (!number) return std::nullopt;
      vector[static_cast<Eigen::Index>(i)] = *number / 100.0;
    }
    return vector;
  }
  static std::string text(const Vec3& vector) {
    return centimetre_text(vector.x()) + ' ' + centimetre_text(vector.y()) + ' ' + centimetre_text(vector.z());
  }
};

/// A whole number from `Range::kMin` to `Range::kMax`.
template <class Range>
struct Whole : Range {
  static std::optional<int> parse(std::string_view text) {
    const std::optional<long> number = parse_integer(text);
    if (!number || *number < Range::kMin || *number > Range::kMax) return std::nullopt;
    return static_cast<int>(*number);
  }
  static std::string text(int number) { return std::to_string(number); }
};

struct ThreadRange {
  static constexpr std::string_view kAccepted = "a whole number from 0 to 1024";
  static constexpr int kMin = 0, kMax = 1024;
};
struct IterationRange {
  static constexpr std::string_view kAccepted = "a whole number from 1 to 100000";
  static constexpr int kMin = 1, kMax = 100000;
};
struct CutRange {
  static constexpr std::string_view kAccepted = "a whole number from 0 to 1000";
  static constexpr int kMin = 0, kMax = 1000;
};
struct BatchRange {
  static constexpr std::string_view kAccepted = "a whole number from 1 to 100000";
  static constexpr int kMin = 1, kMax = 100000;
};
struct DirectionRange {
  static constexpr std::string_view kAccepted = "1 or 2";
  static constexpr int kMin = 1, kMax = 2;
};

/// A number of replicas: none, or as many as can tell that a world holds.
struct ReplicaCount : Whole<CutRange> {
  static constexpr std::string_view kAccepted = "0 or a whole number from 27 to 1000";
  static std::optional<int> parse(std::string_view text) {
    const std::optional<int> number = Whole<CutRange>::parse(text);
    return number && (*number == 0 || *number >= kFewestReplicas) ? number : std::nullopt;
  }
};

/// true or false, in the usual spellings.
struct Truth {
  static constexpr std::string_view kAccepted = "true or false (also yes, no, 1, 0)";
  static std::optional<bool> parse(std::string_view text) {
    const std::string lower = lower_case(text);
    if (lower == "true" || lower == "yes" || lower == "1") return true;
    if (lower == "false" || lower == "no" || lower == "0") return false;
    return std::nullopt;
  }
  static std::string text(bool value) { return value ? "true" : "false"; }
};

/// A word that stands for a value.
template <class Value>
struct Word {
  std::string_view word;
  Value value;
};
template <class Value>
Word(std::string_view, Value) -> Word<Value>;

/// One of `List::kWords`.
template <class List>
struct OneOf : List {
  using Value = std::remove_cvref_t<decltype(List::kWords[0].value)>;
  static std::optional<Value> parse(std::string_view text) {
    for (const auto& [word, value] : List::kWords)
      if (word == text) return value;
    return std::nullopt;
  }
  static std::string text(Value wanted) {
    for (const auto& [word, value] : List::kWords)
      if (value == wanted) return std::string(word);
    return {};
  }
};

struct UpAxes {
  static constexpr std::string_view kAccepted = "z or y";
  static constexpr std::array kWords{Word{"z", UpAxis::z}, Word{"y", UpAxis::y}};
};
struct ContainerMotions {
  static constexpr std::string_view kAccepted = "prescribed or free";
  static constexpr std::array kWords{Word{"prescribed", ContainerMotion::prescribed},
                                     Word{"free", ContainerMotion::free}};
};
struct FrictionModels {
  static constexpr std::string_view kAccepted = "product or pairs";
  static constexpr std::array kWords{Word{"product", FrictionModel::product}, Word{"pairs", FrictionModel::pairs}};
};
struct StoppingConditions {
  static constexpr std::string_view kAccepted = "timeout or sleeping";
  static constexpr std::array kWords{Word{"timeout", StoppingCondition::timeout},
                                     Word{"sleeping", StoppingCondition::sleeping}};
};
struct ReferencePoses {
  static constexpr std::string_view kAccepted = "layout or settled";
  static constexpr std::array kWords{Word{"layout", ReferencePose::layout}, Word{"settled", ReferencePose::settled}};
};
struct StopConditions {
  static constexpr std::string_view kAccepted = "end, moved or fallen";
  static constexpr std::array kWords{Word{"end", StopWhen::end}, Word{"moved", StopWhen::moved},
                                     Word{"fallen", StopWhen::fallen}};
};
struct WallNorms {
  static constexpr std::string_view kAccepted = "en12642-l, en12642-xl, en283 or iso-container";
  static constexpr std::array kWords{Word{"en12642-l", WallNorm::en12642_l}, Word{"en12642-xl", WallNorm::en12642_xl},
                                     Word{"en283", WallNorm::en283}, Word{"iso-container", WallNorm::iso_container}};
};
struct Accuracies {
  static constexpr std::string_view kAccepted = "screening, standard or reference";
  static constexpr std::array kWords{Word{"screening", Accuracy::screening}, Word{"standard", Accuracy::standard},
                                     Word{"reference", Accuracy::reference}};
};
struct BulletSleepings {
  static constexpr std::string_view kAccepted = "off or wake_on_change";
  static constexpr std::array kWords{Word{"off", BulletSleeping::off},
                                     Word{"wake_on_change", BulletSleeping::wake_on_change}};
};

/// One of `List::kNames`, kept as text.
template <class List>
struct Name : List {
  static std::optional<std::string> parse(std::string_view text) {
    const auto found = std::find(List::kNames.begin(), List::kNames.end(), text);
    return found == List::kNames.end() ? std::nullopt : std::optional<std::string>(*found);
  }
  static std::string text(const std::string& name) { return name; }
};

/// A norm, kept by the name that equal choices share; or none.
struct NormName {
  static inline const std::string kAccepted = norm_names();
  static std::optional<std::string> parse(std::string_view text) {
    if (text.empty()) return "";
    const Result<ChosenNorm> norm = find_norm(text);
    return norm ? std::optional(norm->name()) : std::nullopt;
  }
  static std::string text(const std::string& name) { return name; }
};

/// A type of the catalogue of containers, kept by its name there; or none.
struct ContainerTypeName {
  static constexpr std::string_view kAccepted = "a name that `holdfast containers` lists, such as 40hc";
  static std::optional<std::string> parse(std::string_view text) {
    if (text.empty()) return "";
    const ContainerType* const type = find_container(text);
    return type == nullptr ? std::nullopt : std::optional<std::string>(type->name);
  }
  static std::string text(const std::string& name) { return name; }
};

/// "a, b or c".
template <class Names>
std::string joined_with_or(const Names& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + std::string(names[i]);
  return text;
}

struct Engines {
  static inline const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> names;
    for (const EngineEntry& entry : engine_registry()) names.push_back(entry.name);
    return names;
  }();
  static inline const std::string kAccepted = joined_with_or(kNames);
};
struct Schedulers {
  static constexpr std::string_view kAccepted = "tbb, openmp or serial";
  static constexpr std::array kWords{Word{"tbb", Scheduler::tbb}, Word{"openmp", Scheduler::openmp},
                                     Word{"serial", Scheduler::serial}};
};

/// Any of the container's sides, each at most once.
struct Sides {
  static constexpr std::string_view kAccepted = "any of front, rear, left, right, roof, separated by spaces or commas";
  static std::optional<std::vector<std::string>> parse(std::string_view text) {
    std::vector<std::string> sides;
    for (const std::string_view word : words_of(text, " \t,")) {
      if (!can_be_open(word)) return std::nullopt;
      if (std::find(sides.begin(), sides.end(), word) == sides.end()) sides.emplace_back(word);
    }
    return sides;
  }
  static std::string text(const std::vector<std::string>& sides) {
    std::string joined;
    for (const std::string& side : sides) joined += (joined.empty() ? "" : " ") + side;
    return joined;
  }
};

/// Walls of the container with their heights in centimetres, each at most once.
struct DropSides {
  static constexpr std::string_view kAccepted =
      "names of walls (front, rear, left, right), each once and followed by a height from 1 to 1000000, such as "
      "left 60 right 60";
  static std::optional<std::vector<DropSide>> parse(std::string_view text) {
    const std::vector<std::string_view> words = words_of(text, " \t,");
    std::vector<DropSide> sides;
    for (std::size_t i = 0; i < words.size(); i += 2) {
      if (!can_be_open(words[i]) || words[i] == "roof" || i + 1 == words.size()) return std::nullopt;
      const std::optional<double> height = Centimetres<Positive>::parse(words[i + 1]);
      const auto same = [&](const DropSide& known) { return known.side == words[i]; };
      if (!height || *height < 0.01 || std::any_of(sides.begin(), sides.end(), same)) return std::nullopt;
      sides.push_back({std::string(words[i]), *height});
    }
    return sides;
  }
  static std::string text(const std::vector<DropSide>& sides) {
    std::string joined;
    for (const DropSide& drop : sides)
      joined += (joined.empty() ? "" : " ") + drop.side + ' ' + centimetre_text(drop.height);
    return joined;
  }
};

/// Any text, also an empty one.
struct Text {
  static constexpr std::string_view kAccepted = "any text";
  static std::optional<std::string> parse(std::string_view text) { return std::string(text); }
  static std::string text(const std::string& text) { return text; }
};

/// A path; it may be empty.
struct Path : Text {
  static constexpr std::string_view kAccepted = "a path";
};

/// A path that must not be empty.
struct NeededPath : Path {
  static std::optional<std::string> parse(std::string_view text) {
    return text.empty() ? std::nullopt : Path::parse(text);
  }
};

}  // namespace holdfast::internal::setting_kinds
