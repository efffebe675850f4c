#pragma once

#include <string>

namespace holdfast::internal {

/// What each accuracy of the native engine stands for, as JSON: under its name the fields of `native::NativeOptions`,
/// of which `small_island` and `large_island` are objects with the fields of `native::Effort`.
std::string accuracies_json();

}  // namespace holdfast::internal
