#include "core/native/solver/problem_bytes.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace holdfast::internal::native {

namespace {

constexpr std::string_view kMagic = "HFCP0002";

/// Appends what it is called with.
struct Writer {
  std::string bytes;

  template <class T>
  void number(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  std::size_t length(const std::vector<T>& column) {
    number(std::uint64_t{column.size()});
    return column.size();
  }
};

/// Takes what it is called with from the bytes; nothing is taken beyond their end.
struct Reader {
  std::string_view bytes;
  bool complete = true;

  template <class T>
  void number(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    complete = complete && bytes.size() >= sizeof value;
    if (!complete) return;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
  }
  template <class T>
  std::size_t length(std::vector<T>& column) {
    std::uint64_t count = 0;
    number(count);
    // Every entry takes at least a byte.
    complete = complete && count <= bytes.size();
    column.resize(complete ? count : 0);
    return column.size();
  }
};

template <class Archive, class Limits>
void walk_limits(Archive& archive, Limits& limits) {
  archive.number(limits.tolerance);
  archive.number(limits.velocity_unit);
  archive.number(limits.iterations);
  archive.number(limits.more_iterations);
  archive.number(limits.mean_residual);
  archive.number(limits.worst_residual);
  archive.number(limits.sticking);
  archive.number(limits.sliding);
  archive.number(limits.idle_penalty);
  archive.number(limits.refit_every);
  archive.number(limits.refit_share);
  archive.number(limits.projection);
  archive.number(limits.plain_iterations);
}

template <class Archive, class Constraint>
void walk_constraint(Archive& archive, Constraint& constraint) {
  archive.number(constraint.arms);
  archive.number(constraint.impulse);
  archive.number(constraint.contact_velocity);
  archive.number(constraint.velocity_bias);
  archive.number(constraint.expected_impulse);
  archive.number(constraint.penalty);
  archive.number(constraint.inverse_penalty);
  archive.number(constraint.directions);
  archive.number(constraint.friction);
  archive.number(constraint.a);
  archive.number(constraint.b);
  archive.number(constraint.count);
  archive.number(constraint.effective_mass);
}

template <class Archive, class Column>
void walk_column(Archive& archive, Column& column) {
  const std::size_t count = archive.length(column);
  for (std::size_t i = 0; i < count; ++i) archive.number(column[i]);
}

/// Every number of a problem, in the order of the format.
template <class Archive, class Stored>
void walk(Archive& archive, Stored& stored) {
  walk_limits(archive, stored.limits);
  auto& problem = stored.problem;
  for (std::size_t i = 0, count = archive.length(problem.bodies); i < count; ++i) {
    archive.number(problem.bodies[i].mass);
    for (Eigen::Index k = 0; k < 9; ++k) archive.number(problem.bodies[i].inertia.data()[k]);
    archive.number(problem.bodies[i].radius);
  }
  walk_column(archive, problem.free_velocity);
  walk_column(archive, problem.velocity);
  for (std::size_t i = 0, count = archive.length(problem.constraints); i < count; ++i)
    walk_constraint(archive, problem.constraints[i]);
  walk_column(archive, problem.mid_arms);
  walk_column(archive, problem.normal_bounds);
  for (std::size_t i = 0, count = archive.length(problem.pairs); i < count; ++i) {
    archive.number(problem.pairs[i].first);
    archive.number(problem.pairs[i].second);
  }
  walk_column(archive, problem.constraint_pair);
  archive.number(problem.impulse_per_mass);
}

/// Whether lengths and indices belong together.
bool is_consistent(const ContactProblem& problem) {
  const std::size_t bodies = problem.bodies.size();
  const std::size_t constraints = problem.constraints.size();
  const auto is_one_each = [&](std::size_t count) { return count == 0 || count == constraints; };
  if (problem.free_velocity.size() != bodies || problem.velocity.size() != bodies + 1) return false;
  if (!is_one_each(problem.mid_arms.size()) || !is_one_each(problem.normal_bounds.size())) return false;
  if (problem.constraint_pair.size() != constraints) return false;
  const auto is_body = [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) <= bodies; };
  return std::all_of(problem.pairs.begin(), problem.pairs.end(),
                     [&](const BodyPair& pair) { return pair.first < bodies && pair.second < bodies; }) &&
         std::all_of(problem.constraint_pair.begin(), problem.constraint_pair.end(),
                     [&](std::uint32_t pair) { return pair == kNoPair || pair < problem.pairs.size(); }) &&
         std::all_of(problem.constraints.begin(), problem.constraints.end(), [&](const ContactConstraint& constraint) {
           return is_body(constraint.a) && is_body(constraint.b) && constraint.count > 0 && constraint.count <= kLanes;
         });
}

}  // namespace

std::string bytes_of(const StoredProblem& stored) {
  Writer writer{std::string(kMagic)};
  walk(writer, stored);
  return std::move(writer.bytes);
}

Result<StoredProblem> problem_from(std::string_view bytes) {
  if (!bytes.starts_with(kMagic))
    return Error{.what = "is no contact problem", .accepted = "a file of `solver_bench dump`"};
  Reader reader{bytes.substr(kMagic.size())};
  StoredProblem stored;
  walk(reader, stored);
  if (!reader.complete || !reader.bytes.empty()) return Error{.what = "is not as long as a contact problem"};
  if (!is_consistent(stored.problem)) return Error{.what = "names bodies or pairs that are not there"};
  return stored;
}

}  // namespace holdfast::internal::native
