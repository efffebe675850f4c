#include "analyses/replicas/replica_draw.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/model/contact_law.hpp"
#include "scenes.hpp"

namespace replica_draw_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

const Layout& two_materials() {
  static const Layout kLayout = layout_of({box({0, 0, 0}, {1, 1, 1}, 1), box({1, 0, 0}, {1, 1, 1}, -7)});
  return kLayout;
}

/// Mean and standard deviation of a number over many draws.
std::pair<double, double> moments_of(const ScreeningSettings& spreads,
                                     const std::function<double(const ReplicaDraw&)>& number) {
  constexpr std::uint32_t kDraws = 20000;
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint32_t i = 1; i <= kDraws; ++i) {
    const double value = number(draw_replica(two_materials(), 1, i, spreads));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kDraws;
  return {mean, std::sqrt(squares / kDraws - mean * mean)};
}

/// The coefficients of two surfaces of the container and of boxes, with the settings of a draw.
double pair_of(const Settings& settings, int material) {
  return friction_of_pair(settings.contact, {SurfaceKind::floor, settings.container.friction, 0.0},
                          {SurfaceKind::box, friction_of(settings, material), 0.0}, 1.0);
}

}  // namespace

TEST_CASE("replica_draw: minus zero is the place of zero", "[replica_draw]") {
  const Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1}, 1)});
  Layout negative = layout;
  negative.boxes[0].corner_min = {-0.0, -0.0, -0.0};
  CHECK(boxes_hash(negative) == boxes_hash(layout));
  CHECK(boxes_hash(negative) != boxes_hash(two_materials()));
}

TEST_CASE("replica_draw: numbers have the same bits on every machine", "[replica_draw]") {
  // Computed by the same formulas in Python.
  const ReplicaDraw draw = draw_replica(two_materials(), 0x0123456789abcdefULL, 3, {});
  CHECK(draw.materials.at(1) == 0x1.10fc49411bfd8p0);
  CHECK(draw.materials.at(-7) == 0x1.fb9b2e7809972p-1);
  CHECK(draw.container == 0x1.d9c89a0bfcc51p-1);
  CHECK(draw.box_floor == 0x1.238c52f6f5f2ep0);
  CHECK(draw.acceleration == 1.0);
}

TEST_CASE("replica_draw: coefficients vary by the spread about their nominal value", "[replica_draw]") {
  ScreeningSettings spreads;
  spreads.friction_spread = GENERATE(0.1, 0.2);
  spreads.acceleration_spread = 0.05;
  const double spread = spreads.friction_spread;
  const auto check = [&](double deviation, const std::function<double(const ReplicaDraw&)>& number) {
    const auto [mean, found] = moments_of(spreads, number);
    CHECK(mean == Approx(1.0).margin(0.015));
    CHECK(found == Approx(deviation).epsilon(0.03));
  };
  check(spread, [](const ReplicaDraw& draw) { return draw.materials.at(1) * draw.materials.at(1); });
  check(spread, [](const ReplicaDraw& draw) { return draw.materials.at(1) * draw.container; });
  check(spread / std::sqrt(2.0), [](const ReplicaDraw& draw) { return draw.materials.at(1) * draw.materials.at(-7); });
  check(spread, [](const ReplicaDraw& draw) { return draw.box_box; });
  check(spread, [](const ReplicaDraw& draw) { return draw.box_floor; });
  check(spread, [](const ReplicaDraw& draw) { return draw.box_wall; });
  check(0.05, [](const ReplicaDraw& draw) { return draw.acceleration; });
}

TEST_CASE("replica_draw: a draw belongs to its layout and number, and a factor to its material", "[replica_draw]") {
  const ReplicaDraw draw = draw_replica(two_materials(), 1, 1, {});
  CHECK(draw.container != draw_replica(two_materials(), 1, 2, {}).container);
  CHECK(draw.container != draw_replica(two_materials(), 2, 1, {}).container);
  const Layout one = layout_of({box({0, 0, 0}, {1, 1, 1}, -7)});
  CHECK(draw_replica(one, 1, 1, {}).materials == std::map<MaterialName, double>{{-7, draw.materials.at(-7)}});
  CHECK(boxes_hash(two_materials()) != boxes_hash(one));
}

TEST_CASE("replica_draw: the largest spread leaves all friction positive", "[replica_draw]") {
  ScreeningSettings spreads;
  spreads.friction_spread = 0.3;
  for (std::uint32_t i = 1; i < 20000; ++i) {
    const ReplicaDraw draw = draw_replica(two_materials(), 5, i, spreads);
    REQUIRE(draw.materials.at(1) > 0.3);
    REQUIRE(draw.box_floor > 0.09);
  }
}

TEST_CASE("replica_draw: the settings of a draw have its friction, and all else as before", "[replica_draw]") {
  Settings settings;
  settings.contact.friction_model = GENERATE(FrictionModel::product, FrictionModel::pairs);
  settings.materials[1].density = 400.0;
  settings.materials[1].friction = 0.6;
  ReplicaDraw draw{.materials = {{1, 0.5}, {-7, 2.0}}, .container = 3.0, .box_floor = 5.0};
  const Settings varied = with_friction(settings, draw);
  const bool product = settings.contact.friction_model == FrictionModel::product;
  CHECK(pair_of(varied, 1) == Approx((product ? 1.5 : 5.0) * pair_of(settings, 1)));
  CHECK(pair_of(varied, -7) == Approx((product ? 6.0 : 5.0) * pair_of(settings, -7)));
  CHECK(varied.materials.at(1).density == 400.0);
  CHECK_FALSE(varied.materials.at(-7).density);
}

TEST_CASE("replica_draw: a pair of materials and mats have factors of their own, in any order of rows",
          "[replica_draw]") {
  const auto pairs_of = [](std::vector<const char*> keys) {
    FrictionTable table;
    for (const char* key : keys) table.set(*parse_partners(key), 0.5);
    return table;
  };
  const FrictionTable table = pairs_of({"carton, pallet", "carton, floor", "2, any"});
  const ReplicaDraw draw = draw_replica(two_materials(), 1, 1, {}, table.rows());
  REQUIRE(draw.pairs.size() == 3);
  const FrictionTable turned = pairs_of({"any, 2", "floor, carton", "pallet, carton"});
  CHECK(draw_replica(two_materials(), 1, 1, {}, turned.rows()).pairs == draw.pairs);
  const FrictionTable fewer = pairs_of({"carton, floor"});
  CHECK(draw_replica(two_materials(), 1, 1, {}, fewer.rows()).pairs ==
        std::map<std::string, double>{{"carton, floor", draw.pairs.at("carton, floor")}});

  // All are drawn apart from each other, and from materials whatever their number.
  Layout many = layout_of({});
  for (int material = 0; material < 100; ++material)
    many.boxes.push_back(box({1.0 * material, 0, 0}, {1, 1, 1}, material));
  const ReplicaDraw all = draw_replica(many, 1, 1, {}, table.rows());
  CHECK(all.mats == draw.mats);
  std::set<double> drawn = {all.mats, all.box_box, all.box_floor, all.box_wall};
  for (const auto& [pair, factor] : all.pairs) drawn.insert(factor);
  CHECK(drawn.size() == 7);
  for (const auto& [material, factor] : all.materials)
    for (const double other : drawn) CHECK(std::abs(factor * factor - other) > 1e-9);

  double sum = 0.0;
  double squares = 0.0;
  constexpr std::uint32_t kDraws = 20000;
  for (std::uint32_t i = 1; i <= kDraws; ++i) {
    const ReplicaDraw one = draw_replica(two_materials(), 1, i, {}, fewer.rows());
    for (const double factor : {one.mats, one.pairs.at("carton, floor")}) {
      sum += factor;
      squares += factor * factor;
    }
  }
  const double mean = sum / (2 * kDraws);
  CHECK(mean == Approx(1.0).margin(0.015));
  CHECK(std::sqrt(squares / (2 * kDraws) - mean * mean) == Approx(0.1).epsilon(0.03));
}

TEST_CASE("replica_draw: the least friction is that of pairs and mats too", "[replica_draw]") {
  FrictionTable table;
  for (const char* key : {"carton, pallet", "carton, floor"}) table.set(*parse_partners(key), 0.5);
  ReplicaDraw least = draw_replica(two_materials(), 1, 1, {}, table.rows());
  ReplicaDraw expected = least;
  for (std::uint32_t i = 2; i <= 32; ++i) {
    const ReplicaDraw next = draw_replica(two_materials(), 1, i, {}, table.rows());
    lower_friction(least, next);
    expected.mats = std::min(expected.mats, next.mats);
    for (auto& [pair, factor] : expected.pairs) factor = std::min(factor, next.pairs.at(pair));
  }
  CHECK(least.mats == expected.mats);
  CHECK(least.pairs == expected.pairs);
  CHECK(least.mats < 1.0);

  Settings settings;
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.materials = table;
  settings.contact.mat_factor = 0.5;
  const Settings varied = with_friction(settings, least);
  CHECK(varied.contact.mat_factor == 0.5 * least.mats);
  for (const FrictionTable::Row& row : varied.contact.materials.rows())
    CHECK(row.coefficient == 0.5 * least.pairs.at(row.partners.text()));
}

}  // namespace replica_draw_test
