#include "app/pages/accuracy_defaults.hpp"

#include <array>
#include <cstddef>
#include <set>
#include <string_view>

#include "core/base/number_text.hpp"
#include "core/model/setting_kinds.hpp"
#include "core/native/native_options.hpp"

namespace holdfast::internal {

namespace {

using native::Effort;
using native::NativeOptions;

/// A key whose default depends on the accuracy, and the text of that default.
struct KeyOfAccuracy {
  std::string_view name;
  std::string (*text)(const NativeOptions& options);
  std::string_view islands;  ///< "" where there is one value for all islands
};

constexpr std::string_view kSmallAndLarge = ", for small and large islands";

/// The number as one writes it: 1e-9, where `number_text` has 1e-09.
std::string text_of(double number) {
  std::string text = number_text(number);
  const std::size_t zero = text.find("e-0");
  if (zero != std::string::npos) text.erase(zero + 2, 1);
  return text;
}

/// The text of a field in both kinds of islands.
template <class Value>
std::string in_islands(const NativeOptions& options, Value Effort::*field) {
  return text_of(options.small_island.*field) + " and " + text_of(options.large_island.*field);
}

constexpr std::array kKeys = {
    KeyOfAccuracy{"StepsPerSecond", [](const auto& options) { return text_of(options.steps_per_second); }, ""},
    KeyOfAccuracy{"Tolerance", [](const auto& options) { return in_islands(options, &Effort::tolerance); },
                  kSmallAndLarge},
    KeyOfAccuracy{"Iterations", [](const auto& options) { return in_islands(options, &Effort::iterations); },
                  kSmallAndLarge},
    KeyOfAccuracy{"RestTolerance", [](const auto& options) { return text_of(options.rest_tolerance); }, ""},
    KeyOfAccuracy{"ImpactCuts", [](const auto& options) { return in_islands(options, &Effort::impact_cuts); },
                  kSmallAndLarge},
    KeyOfAccuracy{"Sleep", [](const auto& options) { return setting_kinds::Truth::text(options.sleep); }, ""},
};

}  // namespace

std::string accuracy_default(const SettingKey& key) {
  if (key.section != "Native") return "";
  for (const auto& [name, text, islands] : kKeys) {
    if (name != key.name) continue;
    std::string sentence;
    std::set<std::string> defaults;
    for (const auto& [word, accuracy] : setting_kinds::Accuracies::kWords) {
      Settings settings;
      settings.native.accuracy = accuracy;
      const std::string of_accuracy = text(native::native_options(settings));
      defaults.insert(of_accuracy);
      sentence += (sentence.empty() ? "Default: " : ", ") + std::string(word) + ' ' + of_accuracy;
    }
    if (defaults.size() == 1) sentence = "Default: " + *defaults.begin();
    return sentence.append(islands) + '.';
  }
  return "";
}

}  // namespace holdfast::internal
