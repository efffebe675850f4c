#pragma once

#include <string>

#include "core/model/layout.hpp"

namespace holdfast::internal {

/// What a load is, as JSON in one line without its name: keys in one order, lengths in m, masses in kg, numbers with as
/// few digits as give them back. What is absent is left out. The SHA-256 of a load is that of this text.
std::string canonical_json(const Layout& load);

/// The same with the name in front, as a line of a file of loads.
std::string load_line(const Layout& load);

}  // namespace holdfast::internal
