#include "app/report.hpp"

#include <fmt/format.h>

namespace holdfast {

ExitCode fail(ExitCode code, std::span<const Error> errors) {
  for (const Error& error : errors) fmt::print(stderr, "{}\n", error.message());
  return code;
}

ExitCode fail(ExitCode code, const Error& error) { return fail(code, std::span(&error, 1)); }

void warn(std::span<const Error> warnings) {
  for (const Error& warning : warnings) fmt::print(stderr, "warning: {}\n", warning.message());
}

}  // namespace holdfast
