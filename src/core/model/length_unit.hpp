#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::internal {

/// A unit of length or mass, and how many metres or kilograms it is.
struct Unit {
  std::string_view word;
  double factor;
};

/// The first word of a factor is its name; the others are what files write as well.
inline constexpr std::array kLengthUnits = {Unit{"m", 1.0},
                                            Unit{"dm", 0.1},
                                            Unit{"cm", 0.01},
                                            Unit{"mm", 0.001},
                                            Unit{"in", 0.0254},
                                            Unit{"ft", 0.3048},
                                            Unit{"inch", 0.0254},
                                            Unit{"inches", 0.0254},
                                            Unit{"foot", 0.3048},
                                            Unit{"feet", 0.3048},
                                            Unit{"metre", 1.0},
                                            Unit{"metres", 1.0},
                                            Unit{"meter", 1.0},
                                            Unit{"meters", 1.0},
                                            Unit{"centimetres", 0.01},
                                            Unit{"centimeters", 0.01},
                                            Unit{"centimetre", 0.01},
                                            Unit{"centimeter", 0.01},
                                            Unit{"millimetres", 0.001},
                                            Unit{"millimeters", 0.001},
                                            Unit{"millimetre", 0.001},
                                            Unit{"millimeter", 0.001},
                                            Unit{"м", 1.0},
                                            Unit{"см", 0.01},
                                            Unit{"мм", 0.001}};
inline constexpr std::array kMassUnits = {Unit{"kg", 1.0},           Unit{"g", 0.001},           Unit{"t", 1000.0},
                                          Unit{"lb", 0.45359237},    Unit{"lbs", 0.45359237},    Unit{"kgs", 1.0},
                                          Unit{"kilogram", 1.0},     Unit{"kilograms", 1.0},     Unit{"gram", 0.001},
                                          Unit{"grams", 0.001},      Unit{"tonne", 1000.0},      Unit{"tonnes", 1000.0},
                                          Unit{"pound", 0.45359237}, Unit{"pounds", 0.45359237}, Unit{"кг", 1.0},
                                          Unit{"т", 1000.0},         Unit{"公斤", 1.0}};

constexpr std::optional<double> length_unit(std::string_view word) {
  for (const Unit& unit : kLengthUnits)
    if (unit.word == word) return unit.factor;
  return std::nullopt;
}

constexpr std::optional<double> mass_unit(std::string_view word) {
  for (const Unit& unit : kMassUnits)
    if (unit.word == word) return unit.factor;
  return std::nullopt;
}

inline std::string length_unit_name(double metres) {
  for (const Unit& unit : kLengthUnits)
    if (unit.factor == metres) return std::string(unit.word);
  return {};
}

/// A length in metres. Divided where the unit is a decimal part, so that 587 cm is the double nearest to 5.87.
inline double in_metres(double length, double unit) {
  if (unit == 0.01) return length / 100.0;
  if (unit == 0.001) return length / 1000.0;
  if (unit == 0.1) return length / 10.0;
  return length * unit;
}

}  // namespace holdfast::internal
