#pragma once

#include <string>
#include <vector>

#include "io/loads/read_load.hpp"

namespace holdfast::internal {

/// Joins loads of a file that are parts of one, such as pallets, orders and layers: unless every second of their boxes
/// at least is where one of another load is. Loads with mistakes, and those of different containers, stay.
/// @param name of the file, which the joined load gets; its boxes come in the order of the file
void join_parts(std::vector<ReadLoad>& loads, const std::string& name);

}  // namespace holdfast::internal
