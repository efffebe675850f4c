#include "validate/laboratory/engine_settings.hpp"

#include <catch2/catch.hpp>
#include <map>

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

TEST_CASE("engine settings: native at all accuracies and one setting of every other engine have bounds", "[validate]") {
  std::map<std::string, int> bounded;
  for (const EngineSetting& setting : engine_settings())
    bounded[setting.engine] += has_bounds(setting.engine, setting.name) ? 1 : 0;
  CHECK(bounded == std::map<std::string, int>{
                       {"native", 3}, {"bullet", 1}, {"bullet-f64", 1}, {"bullet-stock", 1}, {"bullet-opencl", 1}});
}

}  // namespace engine_settings_test
