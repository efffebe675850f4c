#include "app/pages/accuracy_defaults.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "core/native/native_options.hpp"

namespace accuracy_defaults_test {

using namespace holdfast::internal;

TEST_CASE("accuracy_defaults: every absent key of [Native] has a default", "[app][accuracy_defaults]") {
  for (const SettingKey& key : setting_table()) {
    INFO(key.section << " " << key.name);
    const bool of_accuracy = key.section == "Native" && key.default_value.empty();
    CHECK(accuracy_default(key).empty() != of_accuracy);
  }
}

TEST_CASE("accuracy_defaults: numbers are those of native_options", "[app][accuracy_defaults]") {
  Settings settings;
  settings.native.accuracy = Accuracy::reference;
  const native::NativeOptions options = native::native_options(settings);
  CHECK(accuracy_default(*find_setting("Native", "RestTolerance")) == "Default: 1e-8.");
  const std::string iterations = "reference " + std::to_string(options.small_island.iterations) + " and " +
                                 std::to_string(options.large_island.iterations) + ", for small and large islands.";
  const std::string found = accuracy_default(*find_setting("Native", "Iterations"));
  CAPTURE(found);
  CHECK(found.ends_with(iterations));
  CHECK(accuracy_default(*find_setting("Native", "Sleep")) ==
        "Default: screening true, standard true, reference false.");
}

}  // namespace accuracy_defaults_test
