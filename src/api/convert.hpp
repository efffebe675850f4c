#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/given_container.hpp"
#include "core/model/settings.hpp"
#include "core/model/verdict.hpp"
#include "holdfast/holdfast.hpp"

/// Between the types of holdfast.hpp and those inside.
namespace holdfast::internal {

/// Numbers of a box in a row of `LayoutView`: two corners and a material.
inline constexpr std::size_t kNumbersPerBox = 7;

/// What an error of the input says, to the caller of the library.
holdfast::Problem problem_of(const Error& error);

/// The exception that says what these errors say.
holdfast::Error exception_of(const std::vector<Error>& errors);

/// The value, or its errors as an exception.
template <class T>
T value_or_throw(Result<T> result) {
  if (!result) throw exception_of(result.errors());
  return std::move(*result);
}

/// A layout of the caller, checked as a layout file is.
/// @param name   what messages and results call it
/// @param errors gets all that is wrong with it
ReadLayout read_layout(const holdfast::Layout& layout, const std::string& name, holdfast::LengthUnit unit,
                       const Settings& settings, std::vector<Error>& errors);
ReadLayout read_layout(const holdfast::LayoutView& layout, const std::string& name, holdfast::LengthUnit unit,
                       const Settings& settings, std::vector<Error>& errors);

/// An acceleration of the caller, checked as an acceleration file is.
Result<Acceleration> read_acceleration(const holdfast::Acceleration& acceleration);

/// The box with everything that it has, its lengths as they are.
holdfast::Box public_box(const Box& box);

/// What a layout says of its container, its lengths as they are.
holdfast::Container public_container(const GivenContainer& container);

/// The layout with everything that it has, its lengths in a unit.
holdfast::Layout public_layout(const Layout& layout, holdfast::LengthUnit unit);
holdfast::Acceleration public_acceleration(const Acceleration& acceleration);

/// Fills a world of the caller, whose memory is used again.
void fill_world(const WorldRecord& record, const Thresholds& thresholds, bool keep_boxes,
                holdfast::WorldOutcome& world);

/// Says of a world that was left undone that it was cancelled.
void mark_cancelled(holdfast::WorldOutcome& world);

/// Moves the series into a world of the caller.
void move_series(internal::Series&& series, holdfast::Series& to);

}  // namespace holdfast::internal
