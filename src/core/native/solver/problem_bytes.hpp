#pragma once

#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "core/native/solver/contact_problem.hpp"
#include "core/native/solver/contact_solver.hpp"

namespace holdfast::internal::native {

/// A contact problem as it was given to a solver, and how it was to be solved.
struct StoredProblem {
  ContactProblem problem;
  SolveLimits limits;
};

/// A contact problem as bytes, to be solved alone: every bit of it comes back.
///
/// The format is for tools on one machine: numbers are those of memory, in its byte order. It begins with the eight
/// bytes `HFCP0002`. Then follow, as `walk` in the source lists them, the limits and the problem; a column is its
/// length (64 bits) and its entries, a constraint its members without padding.
std::string bytes_of(const StoredProblem& stored);

/// The problem that the bytes hold, or what is wrong with them: another format, a wrong length, or an index of a body
/// or pair that is not there.
Result<StoredProblem> problem_from(std::string_view bytes);

}  // namespace holdfast::internal::native
