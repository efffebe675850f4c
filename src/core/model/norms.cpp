#include "core/model/norms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/closest_word.hpp"
#include "core/base/number_text.hpp"
#include "core/model/push_direction.hpp"

namespace holdfast::internal {

namespace {

using enum LoadDirection;

/// Four accelerations, one per direction.
/// @param weight_along c_z of front and rear
/// @param purpose      of all
constexpr std::array<NormAcceleration, 4> all_around(double to_front, double to_rear, double across,
                                                     double weight_along = 1.0, std::string_view purpose = "") {
  return {{{front, to_front, weight_along, purpose},
           {rear, to_rear, weight_along, purpose},
           {left, across, 1.0, purpose},
           {right, across, 1.0, purpose}}};
}

constexpr auto kRoad = all_around(0.8, 0.5, 0.5);
constexpr auto kRoadTipping = all_around(0.8, 0.5, 0.6, 1.0, "tipping");
constexpr std::array<NormAcceleration, 8> kRail = {{{front, 1.0, 1.0, "sliding"},
                                                    {front, 0.6, 1.0, "tipping"},
                                                    {rear, 1.0, 1.0, "sliding"},
                                                    {rear, 0.6, 1.0, "tipping"},
                                                    {left, 0.5, 0.7, "sliding"},
                                                    {left, 0.5, 1.0, "tipping"},
                                                    {right, 0.5, 0.7, "sliding"},
                                                    {right, 0.5, 1.0, "tipping"}}};
constexpr auto kSeaA = all_around(0.3, 0.3, 0.5, 0.5);
constexpr auto kSeaB = all_around(0.3, 0.3, 0.7, 0.3);
constexpr auto kSeaC = all_around(0.4, 0.4, 0.8, 0.2);
constexpr auto kOneSize = all_around(1.0, 1.0, 1.0);

constexpr std::array kNorms = {
    Norm{"road", kRoad, "EN 12195-1, road; Directive 2014/47/EU, Annex III"},
    Norm{"road-tipping", kRoadTipping, "EN 12195-1, tipping on the road, as quoted by Certifico, document 6589"},
    Norm{"rail-en12195", kRail, "EN 12195-1, rail, as quoted by GDV, the German insurers"},
    Norm{"sea-a", kSeaA, "DIN EN 12195-1:2011, sea area A (Baltic Sea), as quoted by GDV"},
    Norm{"sea-b", kSeaB, "DIN EN 12195-1:2011, sea area B (North Sea, Mediterranean Sea), as quoted by GDV"},
    Norm{"sea-c", kSeaC, "DIN EN 12195-1:2011, sea area C (all other seas), as quoted by GDV"},
    Norm{.name = "eumos-40509",
         .accelerations = kOneSize,
         .source = "EUMOS 40509, K g for at least 0.3 s, reached within 50 ms, as described by safeloadtesting.com",
         .profile = {.rise = 0.05, .hold = 0.3},
         .takes_size = true},
};

/// Time without acceleration before a norm's acceleration begins, and after it ends, s: boxes that it has set in
/// motion slide, fall and come to rest meanwhile.
constexpr double kRestBefore = 0.5, kRestAfter = 1.5;

/// Length of the constant pieces in which an acceleration grows, s.
constexpr double kPiece = 0.01;

/// The double that the decimal number itself gives, where rounding of a product or a sum gave a neighbour of it: 0.8 g
/// is the 7.848 m/s² of an acceleration file. Zero has no sign.
double decimal(double number) { return std::round(number * 1e6) / 1e6 + 0.0; }

std::string direction_of(const NormAcceleration& acceleration) {
  return std::string(kMarginDirections.at(static_cast<std::size_t>(acceleration.direction)).name);
}

/// Acceleration of the container, m/s².
Vec3 at_full_size(const NormAcceleration& acceleration, double size) {
  Vec3 full = push_acceleration(static_cast<std::size_t>(acceleration.direction), size);
  full.z() = (acceleration.weight_share - 1.0) * kStandardGravity;
  return full.unaryExpr(&decimal);
}

std::vector<Segment> segments_of(const NormProfile& profile, const Vec3& full) {
  std::vector<Segment> segments;
  double time = 0.0;
  const auto add = [&](double duration, const Vec3& acceleration) {
    segments.push_back({time, duration, acceleration});
    time = decimal(time + duration);
  };
  add(kRestBefore, Vec3::Zero());
  const double pieces = std::round(profile.rise / kPiece);
  // Each piece has the mean of the even rise, so that the change of velocity is the same.
  for (double piece = 0.5; piece < pieces; piece += 1.0) add(kPiece, (full * (piece / pieces)).unaryExpr(&decimal));
  add(profile.hold, full);
  add(kRestAfter, Vec3::Zero());
  return segments;
}

/// "0g8" for 0.8, "1g0" for 1: file names lose what follows a point.
std::string size_in_name(double size) {
  std::string text = number_text(size);
  if (text.find('.') == std::string::npos) text += ".0";
  std::replace(text.begin(), text.end(), '.', 'g');
  return text;
}

/// What a user writes: `road`, `eumos-40509:K`.
std::string pattern_of(const Norm& norm) { return std::string(norm.name) + (norm.takes_size ? ":K" : ""); }

Error unknown_norm(std::string_view given, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Norm& norm : kNorms) names.push_back(norm.name);
  const auto meant = closest_word(name, names);
  return {.what = "unknown norm",
          .value = std::string(given),
          .accepted = (meant ? "did you mean " + std::string(*meant) + "? " : "") + "accepted are " + norm_names()};
}

}  // namespace

std::span<const Norm> norms() { return kNorms; }

std::string numbers_of(const Norm& norm, std::string_view size) {
  std::string text;
  for (const NormAcceleration& acceleration : norm.accelerations) {
    std::string notes(acceleration.purpose);
    if (acceleration.weight_share != 1.0)
      notes += (notes.empty() ? "c_z " : ", c_z ") + number_text(acceleration.weight_share);
    text += (text.empty() ? "" : ", ") + direction_of(acceleration) + ' ' +
            (norm.takes_size ? std::string(size) : number_text(acceleration.size)) + " g" +
            (notes.empty() ? "" : " (" + notes + ')');
  }
  return text;
}

std::string ChosenNorm::name() const {
  return std::string(norm->name) + (size ? ':' + number_text(*size) : std::string());
}

std::string ChosenNorm::numbers() const { return numbers_of(*norm, size ? number_text(*size) : "K"); }

std::array<double, kDirectionCount> ChosenNorm::needed_margins() const {
  std::array<double, kDirectionCount> needed = {};
  for (const NormAcceleration& stated : norm->accelerations) {
    if (stated.weight_share != 1.0) continue;
    double& most = needed.at(static_cast<std::size_t>(stated.direction));
    most = std::max(most, size.value_or(1.0) * stated.size);
  }
  return needed;
}

std::vector<Acceleration> ChosenNorm::accelerations() const {
  std::vector<Acceleration> accelerations;
  for (const NormAcceleration& stated : norm->accelerations) {
    const double full = size.value_or(1.0) * stated.size;
    Acceleration& made = accelerations.emplace_back();
    made.name = std::string(norm->name) + '-' + direction_of(stated);
    if (!stated.purpose.empty() && !norm->name.ends_with(stated.purpose))
      made.name += '-' + std::string(stated.purpose);
    made.name += '-' + size_in_name(full);
    made.segments = segments_of(norm->profile, at_full_size(stated, full));
    made.purpose = stated.purpose;
  }
  return accelerations;
}

std::string norm_names() {
  std::string names;
  for (const Norm& norm : kNorms) names += (names.empty() ? "" : ", ") + pattern_of(norm);
  return names + " (K g, from " + number_text(kLeastNormSize) + " to " + number_text(kLargestNormSize) + ')';
}

Result<ChosenNorm> find_norm(std::string_view name) {
  const std::size_t colon = name.find(':');
  const std::string_view base = name.substr(0, colon);
  const auto norm = std::find_if(kNorms.begin(), kNorms.end(), [&](const Norm& known) { return known.name == base; });
  if (norm == kNorms.end()) return unknown_norm(name, base);
  const bool has_size = colon != std::string_view::npos;
  if (!norm->takes_size && !has_size) return ChosenNorm{&*norm, std::nullopt};
  const auto size = has_size && norm->takes_size ? parse_number(name.substr(colon + 1)) : std::nullopt;
  if (size && *size >= kLeastNormSize && *size <= kLargestNormSize) return ChosenNorm{&*norm, size};
  return Error{.what = norm->takes_size ? "a norm without its size K" : "a norm that takes no size",
               .value = std::string(name),
               .accepted = norm->takes_size
                               ? pattern_of(*norm) + " with K from " + number_text(kLeastNormSize) + " to " +
                                     number_text(kLargestNormSize) + " g, such as " + std::string(norm->name) + ":0.5"
                               : std::string(norm->name)};
}

}  // namespace holdfast::internal
