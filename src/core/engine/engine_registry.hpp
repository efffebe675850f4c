#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// An engine as everybody knows it: configuration, command line, library and pages are made from this table alone. To
/// add an engine, implement `engine.hpp` in a folder of its own and add an entry.
struct EngineEntry {
  std::string_view name;
  std::string_view sentence;            ///< what it is
  std::string_view plugin = "";         ///< file name of its plug-in; empty: the engine is part of the library
  std::string_view accuracy_keys = "";  ///< section of the key `Accuracy` that it obeys; empty: it has no accuracy
  /// Makes an engine that is part of the library, or says what it cannot model of the settings.
  Result<std::unique_ptr<Engine>> (*make)(const Settings& settings) = nullptr;
};

/// All engines, the default first.
std::span<const EngineEntry> engine_registry();

/// The engine of that name, or null.
const EngineEntry* find_engine(std::string_view name);

/// The error of a name that no engine has: with a suggestion, or with all names.
Error unknown_engine(std::string_view name);

/// The accuracy that the settings give their engine; empty when it has none.
std::string accuracy_of(const Settings& settings);

/// Gives the settings' engine an accuracy, or says what is accepted.
std::optional<Error> set_accuracy(Settings& settings, const std::string& accuracy);

}  // namespace holdfast::internal
