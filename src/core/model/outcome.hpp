#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vector.hpp"
#include "core/model/status.hpp"
#include "holdfast/outcomes.hpp"

/// What an outcome consists of, as types and as a description that can be visited; both are made of the rows of
/// holdfast/outcome_fields.h.
namespace holdfast::internal {

using holdfast::ReplicaVerdict;
using holdfast::StopReason;
using holdfast::Verdict;

/// What a field is of, and where it is shown, as outcome_fields.h explains.
enum class FieldScope : std::uint8_t { recorded, message, stored, derived };

/// The columns of a row of outcome_fields.h.
struct OutcomeField {
  FieldScope scope;
  std::string_view name;
  std::string_view type;
  std::string_view dataset;
  std::string_view label;
  std::uint64_t since;
  std::string_view unit;
  std::string_view sentence;
};

/// A row of the names of an enumeration.
struct OutcomeName {
  std::string_view name;
  std::uint32_t code;
  std::string_view sentence;
};

// Types of the members; those of a program are in outcomes.hpp.
#define HOLDFAST_ROW_u32 HOLDFAST_CPP_u32
#define HOLDFAST_ROW_u64 HOLDFAST_CPP_u64
#define HOLDFAST_ROW_hash HOLDFAST_CPP_hash
#define HOLDFAST_ROW_f32 HOLDFAST_CPP_f32
#define HOLDFAST_ROW_f64 HOLDFAST_CPP_f64
#define HOLDFAST_ROW_time HOLDFAST_CPP_time
#define HOLDFAST_ROW_vec3(name) Float3 name = {};
#define HOLDFAST_ROW_flag HOLDFAST_CPP_flag
#define HOLDFAST_ROW_text HOLDFAST_CPP_text
#define HOLDFAST_ROW_status(name) Status name = Status::ok;
#define HOLDFAST_ROW_caveat(name) Caveat name = Caveat::none;
#define HOLDFAST_ROW_verdict HOLDFAST_CPP_verdict
#define HOLDFAST_ROW_stop_reason HOLDFAST_CPP_stop_reason
#define HOLDFAST_COLUMN_u32(name) std::vector<std::uint32_t> name;
#define HOLDFAST_COLUMN_u64(name) std::vector<std::uint64_t> name;
#define HOLDFAST_COLUMN_f32(name) std::vector<float> name;
#define HOLDFAST_COLUMN_f64(name) std::vector<double> name;
#define HOLDFAST_COLUMN_vec3(name) std::vector<Float3> name;

#define HOLDFAST_IF_FOUND_recorded(code) code
#define HOLDFAST_IF_FOUND_message(code) code
#define HOLDFAST_IF_FOUND_stored(code) code
#define HOLDFAST_IF_FOUND_derived(code)
#define HOLDFAST_IF_JUDGED_recorded(code)
#define HOLDFAST_IF_JUDGED_message(code)
#define HOLDFAST_IF_JUDGED_stored(code)
#define HOLDFAST_IF_JUDGED_derived(code) code

#define HOLDFAST_FOUND_MEMBER(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_FOUND_##scope(HOLDFAST_ROW_##type(name))
#define HOLDFAST_JUDGED_MEMBER(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_JUDGED_##scope(HOLDFAST_ROW_##type(name))
#define HOLDFAST_COLUMN(scope, type, name, dataset, label, since, unit, sentence) HOLDFAST_COLUMN_##type(name)

#define HOLDFAST_VISIT(scope, type, name, dataset, label, since, unit, sentence) \
  visit(OutcomeField{FieldScope::scope, #name, #type, dataset, label, since, unit, sentence}, &Rows::name...);
#define HOLDFAST_VISIT_FOUND(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_FOUND_##scope(HOLDFAST_VISIT(scope, type, name, dataset, label, since, unit, sentence))
#define HOLDFAST_VISIT_JUDGED(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_JUDGED_##scope(HOLDFAST_VISIT(scope, type, name, dataset, label, since, unit, sentence))
#define HOLDFAST_VISIT_PUBLIC(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_PUBLIC_##scope(HOLDFAST_VISIT(scope, type, name, dataset, label, since, unit, sentence))

/// What the simulation finds of a world: a row of /worlds. In a world that was not simulated most numbers are 0.
struct WorldRow {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_FOUND_MEMBER)
};

/// The judgement on a world by the thresholds: a row of /summary/worlds. If it was not simulated, the counts are
/// `kNotCounted` and the other numbers NaN.
struct WorldVerdict {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_JUDGED_MEMBER)
};

/// What the simulation finds of the boxes of a world, one entry per box: everything that verdicts depend on. The end
/// values have the same bits as those of the last sample.
struct EndTable {
  HOLDFAST_BOX_FIELDS(HOLDFAST_COLUMN)
};

/// The judgement on a box by the thresholds: a row of /summary/boxes. It depends only on values in the results file, so
/// that it can be derived again from the file.
struct BoxVerdict {
  HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_JUDGED_MEMBER)
};

// The visitors call `visit(field, &Row::member...)` for every field, of one or several structures that have it.

/// Counters of an engine.
template <class... Rows, class Visit>
void visit_counters(Visit&& visit) {
  HOLDFAST_COUNTER_FIELDS(HOLDFAST_VISIT)
}
/// What is found of a world.
template <class... Rows, class Visit>
void visit_world_row(Visit&& visit) {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_VISIT_FOUND)
}
/// How a world is judged.
template <class... Rows, class Visit>
void visit_world_verdict(Visit&& visit) {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_VISIT_JUDGED)
}
/// What a program gets of a world, `holdfast::WorldOutcome`.
template <class... Rows, class Visit>
void visit_outcome(Visit&& visit) {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_VISIT_PUBLIC)
}
/// What is found of a world's boxes.
template <class... Rows, class Visit>
void visit_ends(Visit&& visit) {
  HOLDFAST_BOX_FIELDS(HOLDFAST_VISIT)
}
/// How a box is judged.
template <class... Rows, class Visit>
void visit_box_verdict(Visit&& visit) {
  HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_VISIT)
}
/// What a program gets of a box, `holdfast::BoxOutcome`.
template <class... Rows, class Visit>
void visit_box_outcome(Visit&& visit) {
  HOLDFAST_BOX_FIELDS(HOLDFAST_VISIT_PUBLIC)
  HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_VISIT_PUBLIC)
}

// What a program gets, from where it is found: calls `visit(field, value, &Public::member)`.
#define HOLDFAST_WORLD_VALUE_recorded(name) row.name
#define HOLDFAST_WORLD_VALUE_message(name) row.name
#define HOLDFAST_WORLD_VALUE_derived(name) verdict.name
#define HOLDFAST_BOX_VALUE_recorded(name) ends.name[box]
#define HOLDFAST_BOX_VALUE_derived(name) verdict.name
#define HOLDFAST_VISIT_VALUE(structure, from, scope, type, name, dataset, label, since, unit, sentence)              \
  HOLDFAST_IF_PUBLIC_##scope(                                                                                        \
      visit(OutcomeField{FieldScope::scope, #name, #type, dataset, label, since, unit, sentence}, from##scope(name), \
            &holdfast::structure::name);)
#define HOLDFAST_VISIT_WORLD_VALUE(...) HOLDFAST_VISIT_VALUE(WorldOutcome, HOLDFAST_WORLD_VALUE_, __VA_ARGS__)
#define HOLDFAST_VISIT_BOX_VALUE(...) HOLDFAST_VISIT_VALUE(BoxOutcome, HOLDFAST_BOX_VALUE_, __VA_ARGS__)
template <class Visit>
void visit_world_values(const WorldRow& row, const WorldVerdict& verdict, Visit&& visit) {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_VISIT_WORLD_VALUE)
}
template <class Visit>
void visit_box_values(const EndTable& ends, std::size_t box, const BoxVerdict& verdict, Visit&& visit) {
  HOLDFAST_BOX_FIELDS(HOLDFAST_VISIT_BOX_VALUE)
  HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_VISIT_BOX_VALUE)
}

#define HOLDFAST_NAME_ROW(name, c_name, code, sentence) OutcomeName{#name, code, sentence},
inline constexpr OutcomeName kVerdictNames[] = {HOLDFAST_VERDICTS(HOLDFAST_NAME_ROW)};
inline constexpr OutcomeName kStatusNames[] = {HOLDFAST_STATUS_BITS(HOLDFAST_NAME_ROW)};
inline constexpr OutcomeName kCaveatNames[] = {HOLDFAST_CAVEAT_BITS(HOLDFAST_NAME_ROW)};
inline constexpr OutcomeName kStopReasonNames[] = {HOLDFAST_STOP_REASONS(HOLDFAST_NAME_ROW)};
inline constexpr OutcomeName kReplicaVerdictNames[] = {HOLDFAST_REPLICA_VERDICTS(HOLDFAST_NAME_ROW)};

/// Largest code of a verdict, and one more: codes that are not used any more count.
inline constexpr std::size_t kVerdictCount = std::size_t{kVerdictNames[std::size(kVerdictNames) - 1].code} + 1;
inline constexpr std::size_t kReplicaVerdictCount = std::size(kReplicaVerdictNames);

/// Names as in outcome_fields.h, of a status and of caveats those of their bits, joined by '+': "ok", "",
/// "non_finite+not_converged". "unknown" for a code without name, which a damaged file may contain.
std::string to_string(Verdict verdict);
std::string to_string(Status status);
std::string to_string(Caveat caveats);
std::string to_string(StopReason reason);
std::string to_string(ReplicaVerdict verdict);

}  // namespace holdfast::internal
