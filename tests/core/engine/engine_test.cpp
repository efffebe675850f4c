#include "core/engine/engine.hpp"

#include <catch2/catch.hpp>

namespace engine_test {

using namespace holdfast::internal;

TEST_CASE("engine: the residual that is kept is the largest relative to its scale", "[core][engine]") {
  Counters counters;
  counters.note_residual(0.0, 0.04);
  CHECK(counters.residual_scale == 0.0);
  counters.note_residual(0.002, 0.04);
  counters.note_residual(0.003, 0.4);  // larger, but not relative to its scale
  CHECK(counters.max_residual == 0.002);
  CHECK(counters.residual_scale == 0.04);
  counters.note_residual(0.001, 0.01);
  CHECK(counters.max_residual == 0.001);
  CHECK(counters.residual_scale == 0.01);
  counters.note_residual(1e-9, 0.0);  // nothing pulls: any residual is large
  CHECK(counters.max_residual == 1e-9);
  CHECK(counters.residual_scale == 0.0);
  counters.note_residual(1.0, 0.04);
  CHECK(counters.max_residual == 1e-9);
}

}  // namespace engine_test
