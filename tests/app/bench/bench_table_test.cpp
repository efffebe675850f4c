#include "app/bench/bench_table.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

namespace bench_table_test {

using namespace holdfast::internal;

namespace {

/// A case of three runs with the given wall seconds, 100 worlds each.
BenchRow row_of(int threads, const std::vector<double>& seconds, const std::string& hash = "aa") {
  BenchRow row{{.engine = "bullet", .set = "all", .threads = threads}, {}};
  for (const double wall : seconds) {
    BenchSample sample;
    sample.wall_seconds = wall;
    sample.cpu_seconds = 8.0;
    sample.simulated_seconds = 16.0;
    sample.worlds = 100;
    sample.boxes = 5000;
    sample.steps = 1000;
    sample.steps_skipped = 250;
    sample.box_steps = 50'000;
    sample.peak_memory = 40.0;
    sample.stages = {0.8, 0.0, 6.4, 0.0, 0.0, 0.4};
    sample.hash = hash;
    row.samples.push_back(sample);
  }
  return row;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("bench_table: medians, spread, speedup and efficiency", "[app][bench]") {
  const std::vector<BenchRow> rows = {row_of(1, {10.0, 8.0, 11.0}), row_of(4, {4.0, 5.0, 4.0})};
  const std::string text = bench_tables(rows);
  INFO(text);
  // 100 worlds in 10 s, from 9.09 to 12.5 a second; four threads are 2.5 times as fast, a share of 62.5 %.
  CHECK(contains(text, "10.00   34.1 %"));
  CHECK(contains(text, "25.00   20.0 %     2.50        62 %     1.25e+04           0.5   25.0 %      40.0"));
  CHECK(contains(text, "10.00 %    0.00 %   80.00 %    0.00 %    0.00 %    5.00 %    5.00 %"));
}

TEST_CASE("bench_table: an efficiency is reported only against another number of threads", "[app][bench]") {
  const std::string text = bench_tables({row_of(4, {4.0})});
  INFO(text);
  CHECK(contains(text, "      -           -  "));
}

TEST_CASE("bench_table: runs that disagree are refused", "[app][bench]") {
  CHECK_FALSE(check_same_results({row_of(1, {1.0}), row_of(2, {1.0})}));
  const auto error = check_same_results({row_of(1, {1.0}), row_of(2, {1.0}, "bb")});
  REQUIRE(error);
  CHECK(contains(error->message(), "bullet of all with 2 threads, hash bb instead of aa"));
  std::vector<BenchRow> others = {row_of(1, {1.0}), row_of(1, {1.0}, "bb")};
  others[1].bench_case.engine = "bullet-f64";
  CHECK_FALSE(check_same_results(others));
}

TEST_CASE("bench_table: the CSV has a line a run", "[app][bench]") {
  const std::string text = bench_csv({row_of(2, {10.0, 8.0})});
  CHECK(std::count(text.begin(), text.end(), '\n') == 3);
  CHECK(contains(text, "\r\nbullet,all,2,1,1,aa,100,5000,1000,250,50000,16,8,8,40,0,0.8,0,6.4,0,0,0.4\r\n"));
}

}  // namespace bench_table_test
