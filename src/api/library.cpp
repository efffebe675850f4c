#include <string>
#include <vector>

#include "analyses/analysis.hpp"
#include "api/engine_loader.hpp"
#include "api/guarded.hpp"
#include "api/version.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/model/norms.hpp"
#include "holdfast/holdfast.h"
#include "holdfast/holdfast.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/text_file.hpp"

// What the library offers beside its classes.
namespace holdfast {

using internal::guarded;
using internal::value_or_throw;

const char* version() noexcept { return internal::kVersion; }

}  // namespace holdfast

const char* holdfast_version() { return holdfast::version(); }

namespace holdfast {

std::vector<AnalysisNumber> analysis_numbers() {
  return guarded([] {
    std::vector<AnalysisNumber> numbers;
    for (const internal::WorldNumber& number : internal::world_numbers())
      numbers.push_back({std::string(number.name), std::string(number.type), std::string(number.sentence)});
    return numbers;
  });
}

Acceleration read_acceleration(const std::string& path) {
  return guarded([&] {
    const internal::TextFile file = value_or_throw(internal::read_text_file(path));
    std::vector<internal::Error> warnings;
    return internal::public_acceleration(value_or_throw(internal::parse_acceleration(file, warnings)));
  });
}

std::vector<Acceleration> norm_accelerations(const std::string& name) {
  return guarded([&] {
    std::vector<Acceleration> accelerations;
    for (const internal::Acceleration& made : value_or_throw(internal::find_norm(name)).accelerations())
      accelerations.push_back(internal::public_acceleration(made));
    return accelerations;
  });
}

std::vector<EngineInfo> engines() {
  return guarded([] {
    std::vector<EngineInfo> infos;
    for (const internal::EngineEntry& entry : internal::engine_registry()) {
      const auto missing = internal::why_not_loadable(entry);
      infos.push_back({std::string(entry.name), std::string(entry.sentence), missing ? missing->message() : ""});
    }
    return infos;
  });
}

}  // namespace holdfast
