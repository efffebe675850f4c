#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "analyses/analysis.hpp"
#include "core/engine/result_sink.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/verdict.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// Appends what became of a world to an object of JSON, from its acceleration and verdict to its hash. Units are in the
/// names, in SI. Values that a world has only when it was simulated are null otherwise.
/// @param box_names of the layout's boxes, or none: the critical box is named where it has a name
void append_outcome(nlohmann::ordered_json& json, const holdfast::WorldOutcome& world, const std::string& acceleration,
                    std::span<const std::string> box_names = {});

/// Appends how a box ended.
void append_box(nlohmann::ordered_json& json, const holdfast::BoxOutcome& box);

/// Text of JSON on one line. Names of files need not be UTF-8; what is not becomes a replacement character.
std::string one_line(const nlohmann::ordered_json& json);

/// One finished world as one line of JSON.
/// @param time_saved as in `simulate.hpp`, s
/// @param box_names  as of `append_outcome`
std::string world_json(const WorldRecord& world, const std::string& layout, const std::string& acceleration,
                       std::size_t index, const Thresholds& thresholds, double time_saved,
                       std::span<const std::string> box_names = {});

/// What analyses of layouts have found of one layout as one line of JSON; null where something is not known.
std::string layout_json(const LayoutRecord& layout, std::span<const Analysis* const> analyses);

}  // namespace holdfast::internal
