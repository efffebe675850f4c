#include "parallel/schedulers/scheduler.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <thread>

namespace scheduler_test {

using namespace holdfast::internal;

TEST_CASE("scheduler: OpenMP is there exactly where its name is, and the others always", "[parallel][scheduler]") {
  const std::vector<std::string> names = scheduler_names();
  const bool named = std::find(names.begin(), names.end(), "openmp") != names.end();
  CHECK(!why_not_built(Scheduler::openmp) == named);
  CHECK_FALSE(why_not_built(Scheduler::tbb));
  CHECK_FALSE(why_not_built(Scheduler::serial));
}

TEST_CASE("scheduler: as many threads as asked for, or one per core", "[parallel][scheduler]") {
  CHECK(thread_count(1) == 1);
  CHECK(thread_count(37) == 37);
  CHECK(thread_count(0) >= 1);
  CHECK(thread_count(0) <= static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

}  // namespace scheduler_test
