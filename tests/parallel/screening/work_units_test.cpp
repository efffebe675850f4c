#include "parallel/screening/work_units.hpp"

#include <catch2/catch.hpp>

namespace work_units_test {

using namespace holdfast::internal;

namespace {

WorkUnits units_of(std::size_t layouts, std::size_t accelerations, std::size_t layouts_per_unit) {
  EngineTraits traits;
  traits.layouts_per_unit = layouts_per_unit;
  return {layouts, accelerations, traits};
}

/// Checks that the units hold every world once, consecutive and in world order: layout by layout, acceleration fastest.
void check_covers(const WorkUnits& units, std::size_t layouts, std::size_t accelerations) {
  std::size_t world = 0;
  for (std::size_t i = 0; i < units.count(); ++i) {
    const WorkUnit unit = units[i];
    CHECK(unit.layout_begin < unit.layout_end);
    CHECK(unit.acceleration_begin < unit.acceleration_end);
    CHECK(units.beginning_with(world) == i);
    for (std::size_t layout = unit.layout_begin; layout < unit.layout_end; ++layout)
      for (std::size_t acceleration = unit.acceleration_begin; acceleration < unit.acceleration_end; ++acceleration)
        CHECK(layout * accelerations + acceleration == world++);
  }
  CHECK(world == layouts * accelerations);
}

}  // namespace

TEST_CASE("work_units: an engine that shares nothing gets one world at a time", "[parallel][work_units]") {
  const WorkUnits units = units_of(3, 4, 1);
  CHECK(units.count() == 12);
  check_covers(units, 3, 4);
}

TEST_CASE("work_units: every world is in one unit, in order, for all sizes", "[parallel][work_units]") {
  for (std::size_t layouts = 1; layouts <= 5; ++layouts) {
    for (std::size_t accelerations = 1; accelerations <= 5; ++accelerations) {
      for (const std::size_t per_layout : {1U, 2U, 3U, 100U}) {
        CAPTURE(layouts, accelerations, per_layout);
        check_covers(units_of(layouts, accelerations, per_layout), layouts, accelerations);
      }
    }
  }
}

TEST_CASE("work_units: the last unit is smaller", "[parallel][work_units]") {
  const WorkUnits layouts = units_of(5, 2, 3);
  REQUIRE(layouts.count() == 2);
  CHECK(layouts[1].layout_begin == 3);
  CHECK(layouts[1].layout_end == 5);
}

TEST_CASE("work_units: several layouts take all their motions along", "[parallel][work_units]") {
  const WorkUnit unit = units_of(4, 7, 2)[0];
  CHECK(unit.acceleration_begin == 0);
  CHECK(unit.acceleration_end == 7);
}

TEST_CASE("work_units: nothing to do", "[parallel][work_units]") {
  CHECK(units_of(0, 3, 1).count() == 0);
  CHECK(units_of(3, 0, 1).count() == 0);
  CHECK(units_of(3, 0, 2).count() == 0);
}

TEST_CASE("work_units: a trait of 0 counts as 1", "[parallel][work_units]") { check_covers(units_of(2, 2, 0), 2, 2); }

TEST_CASE("work_units: a layout is shared by the units of its motions that are still to come",
          "[parallel][work_units]") {
  const WorkUnits units = units_of(3, 4, 1);
  CHECK(units.sharing_layouts(1, 0) == 4);
  CHECK(units.sharing_layouts(6, 6) == 2);
  CHECK(units.sharing_layouts(7, 6) == 2);
  CHECK(units.sharing_layouts(8, 6) == 4);
  CHECK(units_of(3, 4, 2).sharing_layouts(1, 0) == 1);
}

TEST_CASE("work_units: a unit's first world is where the unit begins", "[parallel][work_units]") {
  const WorkUnits units = units_of(5, 3, 2);
  CHECK(units.first_world(0) == 0);
  CHECK(units.first_world(1) == 6);
  CHECK(units.first_world(2) == 12);
  CHECK(units.first_world(units.beginning_with(6)) == 6);
}

TEST_CASE("work_units: the worlds of a layout may be one unit", "[parallel][work_units]") {
  const WorkUnits units(3, 4, {}, true);
  CHECK(units.count() == 3);
  check_covers(units, 3, 4);
  CHECK(units[1].acceleration_end == 4);
  CHECK(units.sharing_layouts(1, 0) == 1);
}

}  // namespace work_units_test
