#include "parallel/schedulers/ordered_run.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

namespace ordered_run_test {

using namespace holdfast::internal;

namespace {

struct Way {
  Scheduler scheduler;
  int threads;
};

std::vector<Way> ways() {
  std::vector<Way> ways;
  for (const Scheduler scheduler : {Scheduler::tbb, Scheduler::openmp, Scheduler::serial})
    if (!why_not_built(scheduler))
      for (const int threads : {1, 2, 4, 8}) ways.push_back({scheduler, threads});
  return ways;
}

/// Work that takes longer for some units than for others, and gives other threads their turn.
void take_time(std::size_t unit) {
  if (unit % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
  if (unit % 3 == 0) std::this_thread::yield();
}

std::vector<std::size_t> first(std::size_t count) {
  std::vector<std::size_t> units(count);
  std::iota(units.begin(), units.end(), 0U);
  return units;
}

/// What a run did with its units.
struct Log {
  std::atomic<std::size_t> worked = 0;
  std::vector<std::size_t> placed;
  std::vector<std::size_t> written;
};

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Runs `count` units; work leaves unit `gap` undone, write refuses after unit `last`.
void run_units(const Way& way, std::size_t count, Log& log, std::size_t gap = kNone, std::size_t last = kNone) {
  Workers workers(way.scheduler, way.threads);
  run_in_order(
      workers, count,
      [&](std::size_t unit) -> std::optional<std::unique_ptr<std::size_t>> {
        take_time(unit);
        ++log.worked;
        if (unit == gap) return std::nullopt;
        return std::make_unique<std::size_t>(unit);
      },
      [&](std::unique_ptr<std::size_t>&& unit) {
        log.placed.push_back(*unit);
        return std::move(unit);
      },
      [](std::unique_ptr<std::size_t>&& unit) { return std::make_unique<std::size_t>(*unit + 1000); },
      [&](std::unique_ptr<std::size_t>&& unit) {
        log.written.push_back(*unit - 1000);
        return log.written.back() != last;
      });
}

}  // namespace

TEST_CASE("ordered_run: every unit is placed and written once, in order", "[parallel][ordered_run]") {
  for (const Way& way : ways()) {
    CAPTURE(static_cast<int>(way.scheduler), way.threads);
    for (const std::size_t count : {0U, 1U, 7U, 300U}) {
      Log log;
      run_units(way, count, log);
      CHECK(log.worked == count);
      CHECK(log.placed == first(count));
      CHECK(log.written == first(count));
    }
  }
}

TEST_CASE("ordered_run: a unit left undone ends the run with the ones before it", "[parallel][ordered_run]") {
  for (const Way& way : ways()) {
    CAPTURE(static_cast<int>(way.scheduler), way.threads);
    for (const std::size_t gap : {0U, 1U, 50U, 299U}) {
      Log log;
      run_units(way, 300, log, gap);
      CHECK(log.placed == first(gap));
      CHECK(log.written == first(gap));
      CHECK(log.worked <= gap + 1 + kUnitsInFlight * static_cast<std::size_t>(way.threads));
    }
  }
}

TEST_CASE("ordered_run: a failed write is the last one", "[parallel][ordered_run]") {
  for (const Way& way : ways()) {
    CAPTURE(static_cast<int>(way.scheduler), way.threads);
    for (const std::size_t last : {0U, 20U, 299U}) {
      Log log;
      run_units(way, 300, log, kNone, last);
      CHECK(log.written == first(last + 1));
      CHECK(log.worked <= last + 1 + kUnitsInFlight * static_cast<std::size_t>(way.threads));
    }
  }
}

TEST_CASE("ordered_run: the number of units in flight is bounded", "[parallel][ordered_run]") {
  for (const Way& way : ways()) {
    CAPTURE(static_cast<int>(way.scheduler), way.threads);
    std::atomic<std::size_t> written = 0;
    std::atomic<std::size_t> begun = 0;
    std::atomic<std::size_t> most = 0;
    Workers workers(way.scheduler, way.threads);
    run_in_order(
        workers, 400,
        [&](std::size_t unit) -> std::optional<std::size_t> {
          const std::size_t in_flight = ++begun - written;
          std::size_t seen = most;
          while (in_flight > seen && !most.compare_exchange_weak(seen, in_flight)) {
          }
          // The first unit holds up the writing of all others.
          if (unit == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
          return unit;
        },
        [](std::size_t&& unit) { return unit; }, [](std::size_t&& unit) { return unit; },
        [&](std::size_t&&) {
          ++written;
          return true;
        });
    CHECK(written == 400);
    // A unit counts as written a moment after its place in the pipeline is free.
    const std::size_t bound =
        way.scheduler == Scheduler::serial ? 1 : kUnitsInFlight * static_cast<std::size_t>(way.threads);
    CHECK(most <= bound);
  }
}

TEST_CASE("ordered_run: place and write run for one unit at a time", "[parallel][ordered_run]") {
  for (const Way& way : ways()) {
    CAPTURE(static_cast<int>(way.scheduler), way.threads);
    std::atomic<int> placing = 0;
    std::atomic<int> writing = 0;
    bool alone = true;
    Workers workers(way.scheduler, way.threads);
    run_in_order(
        workers, 200, [](std::size_t unit) { return std::optional<std::size_t>(unit); },
        [&](std::size_t&& unit) {
          alone = alone && ++placing == 1;
          std::this_thread::yield();
          --placing;
          return unit;
        },
        [](std::size_t&& unit) { return unit; },
        [&](std::size_t&&) {
          const bool only = ++writing == 1;
          std::this_thread::yield();
          --writing;
          return only;
        });
    CHECK(alone);
    CHECK(writing == 0);
  }
}

TEST_CASE("ordered_run: the serial scheduler stays on the calling thread", "[parallel][ordered_run]") {
  const std::thread::id here = std::this_thread::get_id();
  bool only_here = true;
  const auto look = [&] { only_here = only_here && std::this_thread::get_id() == here; };
  Workers workers(Scheduler::serial, 8);
  run_in_order(
      workers, 20, [&](std::size_t unit) { return look(), std::optional<std::size_t>(unit); },
      [&](std::size_t&& unit) { return look(), unit; }, [&](std::size_t&& unit) { return look(), unit; },
      [&](std::size_t&&) { return look(), true; });
  CHECK(only_here);
}

TEST_CASE("ordered_run: no more threads work than asked for", "[parallel][ordered_run]") {
  for (const Way& way : ways()) {
    CAPTURE(static_cast<int>(way.scheduler), way.threads);
    std::atomic<int> working = 0;
    std::atomic<int> most = 0;
    Workers workers(way.scheduler, way.threads);
    run_in_order(
        workers, 100,
        [&](std::size_t unit) -> std::optional<std::size_t> {
          const int now = ++working;
          int seen = most;
          while (now > seen && !most.compare_exchange_weak(seen, now)) {
          }
          std::this_thread::sleep_for(std::chrono::microseconds(100));
          --working;
          return unit;
        },
        [](std::size_t&& unit) { return unit; }, [](std::size_t&& unit) { return unit; },
        [](std::size_t&&) { return true; });
    CHECK(most <= way.threads);
  }
}

}  // namespace ordered_run_test
