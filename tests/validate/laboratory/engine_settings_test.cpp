#include "validate/laboratory/engine_settings.hpp"

#include <catch2/catch.hpp>

#include "validate/laboratory/scene.hpp"

namespace engine_settings_test {

using namespace holdfast::internal;

TEST_CASE("engine settings: every setting has a step that a scene's step factor can multiply", "[validate]") {
  for (const EngineSetting& setting : engine_settings()) {
    INFO(setting.engine << " " << setting.name);
    Settings settings = Scene{}.settings;
    setting.choose(settings);
    CHECK(settings.steps_per_second.has_value());
  }
}

}  // namespace engine_settings_test
