#include "parallel/schedulers/scheduler.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <thread>

using namespace holdfast;

TEST_CASE("scheduler: names and schedulers belong together", "[parallel][scheduler]") {
  CHECK(scheduler_of("tbb") == Scheduler::tbb);
  CHECK(scheduler_of("serial") == Scheduler::serial);
  for (const std::string& name : scheduler_names()) CHECK(scheduler_of(name).has_value());
  CHECK_FALSE(scheduler_of("").has_value());
  CHECK_FALSE(scheduler_of("TBB").has_value());
  CHECK_FALSE(scheduler_of("threads").has_value());
}

TEST_CASE("scheduler: OpenMP is there exactly where its name is", "[parallel][scheduler]") {
  const std::vector<std::string> names = scheduler_names();
  const bool named = std::find(names.begin(), names.end(), "openmp") != names.end();
  CHECK(scheduler_of("openmp").has_value() == named);
}

TEST_CASE("scheduler: as many threads as asked for, or one a core", "[parallel][scheduler]") {
  CHECK(thread_count(1) == 1);
  CHECK(thread_count(37) == 37);
  CHECK(thread_count(0) >= 1);
  CHECK(thread_count(0) <= static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}
