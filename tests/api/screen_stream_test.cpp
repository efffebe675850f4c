#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <limits>
#include <thread>

#include "holdfast/holdfast.hpp"

namespace screen_stream_test {

namespace {

using holdfast::FinishedLayout;
using holdfast::Layout;
using holdfast::PollOrder;
using holdfast::Screen;
using holdfast::WorldOutcome;

constexpr double kPatience = 100.0;  // s

std::vector<holdfast::Acceleration> two_accelerations() {
  return {{"weak", {{0.0, 0.5, {3.0, 0.0, 0.0}}}}, {"strong", {{0.0, 0.5, {8.0, 0.0, 0.0}}}}};
}

/// A box that slides by its own length or more, starting at its number.
Layout box_at(int number) {
  const double x = 1.0 + 0.01 * number;
  return {"box " + std::to_string(number), {{{x, 1.0, 0.0}, {x + 0.5, 1.5, 0.5}, 1}}};
}

std::vector<Layout> boxes(int count) {
  std::vector<Layout> layouts;
  for (int i = 0; i < count; ++i) layouts.push_back(box_at(i));
  return layouts;
}

Layout sample() {
  return Screen(two_accelerations()).read_layout(HOLDFAST_SOURCE_DIR "/configs/layouts/BR0_012_block.txt");
}

}  // namespace

TEST_CASE("screen: layouts that are submitted give the bits of evaluate, in any order that is asked for",
          "[api][stream]") {
  const std::vector<Layout> layouts = boxes(20);
  for (const int threads : {1, 3}) {
    Screen screen(two_accelerations(), {.accuracy = "screening", .threads = threads, .most_in_flight = 7});
    const std::vector<WorldOutcome> expected = screen.evaluate(layouts);
    for (const PollOrder order : {PollOrder::as_submitted, PollOrder::as_finished}) {
      std::vector<std::uint64_t> tickets;
      std::uint64_t first = 0;
      FinishedLayout finished;
      for (std::size_t next = 0; tickets.size() < layouts.size();) {
        std::optional<std::uint64_t> ticket;
        while (next < layouts.size() && (ticket = screen.submit(layouts[next])))
          if (next++ == 0) first = *ticket;
        CHECK(screen.in_flight() <= 7);
        REQUIRE(screen.poll(finished, kPatience, order));
        REQUIRE(finished.worlds.size() == 2);
        for (std::size_t j = 0; j < 2; ++j) {
          CHECK(finished.worlds[j].state_hash == expected[2 * (finished.ticket - first) + j].state_hash);
          CHECK(finished.worlds[j].layout == finished.ticket);
          CHECK(finished.worlds[j].acceleration == j);
        }
        tickets.push_back(finished.ticket - first);
      }
      if (order == PollOrder::as_submitted) CHECK(std::is_sorted(tickets.begin(), tickets.end()));
      std::sort(tickets.begin(), tickets.end());
      for (std::size_t i = 0; i < tickets.size(); ++i) CHECK(tickets[i] == i);
      CHECK(screen.in_flight() == 0);
      CHECK_FALSE(screen.poll(finished, std::numeric_limits<double>::infinity(), order));
    }
  }
}

TEST_CASE("screen: evaluate may be called while layouts are in flight", "[api][stream]") {
  Screen screen(two_accelerations(), {.accuracy = "screening", .threads = 2});
  const std::vector<Layout> layouts = boxes(4);
  const std::vector<WorldOutcome> expected = screen.evaluate(layouts);
  for (const Layout& layout : layouts) REQUIRE(screen.submit(layout));
  CHECK_THROWS_WITH(screen.add_acceleration(two_accelerations()[0]), Catch::Contains("in flight"));
  const std::vector<WorldOutcome> worlds = screen.evaluate(layouts);
  for (std::size_t i = 0; i < worlds.size(); ++i) CHECK(worlds[i].state_hash == expected[i].state_hash);
  FinishedLayout finished;
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    REQUIRE(screen.poll(finished, kPatience, PollOrder::as_submitted));
    CHECK(finished.worlds[1].state_hash == expected[2 * i + 1].state_hash);
  }
}

TEST_CASE("screen: a bad layout is not submitted, or comes back marked", "[api][stream]") {
  Layout bad = box_at(0);
  bad.boxes.push_back(bad.boxes[0]);
  Screen strict(two_accelerations());
  CHECK_THROWS_WITH(strict.submit(bad), Catch::Contains("box 2 overlaps box 1"));
  CHECK(strict.in_flight() == 0);
  Screen tolerant(two_accelerations(), {.bad_layouts = holdfast::BadLayouts::mark});
  REQUIRE(tolerant.submit(bad));
  CHECK(tolerant.problems().size() == 1);
  FinishedLayout finished;
  REQUIRE(tolerant.poll(finished, kPatience));
  CHECK(finished.worlds[0].status == holdfast::status::bad_layout);
  CHECK_THAT(finished.worlds[1].message, Catch::Contains("overlaps"));
}

TEST_CASE("screen: cancel ends what is in flight, and what is submitted later is whole", "[api][stream]") {
  Screen screen(two_accelerations(), {.accuracy = "reference", .threads = 2, .most_in_flight = 100});
  const Layout layout = sample();
  for (int i = 0; i < 20; ++i) REQUIRE(screen.submit(layout));
  std::thread([&] { screen.cancel(); }).join();
  FinishedLayout finished;
  for (std::size_t i = 0; i < 20; ++i) REQUIRE(screen.poll(finished, kPatience, PollOrder::as_submitted));
  CHECK(finished.worlds[0].stop_reason == holdfast::StopReason::not_run);
  CHECK(finished.worlds[0].message == "cancelled");
  REQUIRE(screen.submit(box_at(0)));
  REQUIRE(screen.poll(finished, kPatience));
  CHECK(finished.worlds[1].stop_reason == holdfast::StopReason::sleeping);
}

TEST_CASE("screen: destroyed with layouts in flight it drops them", "[api][stream]") {
  Screen screen(two_accelerations(), {.accuracy = "reference", .threads = 2, .most_in_flight = 100});
  const Layout layout = sample();
  for (int i = 0; i < 100; ++i) REQUIRE(screen.submit(layout));
  CHECK(screen.in_flight() > 0);
}

TEST_CASE("screen: a forked process has nothing in flight and evaluates the same", "[api][stream]") {
  Screen screen(two_accelerations(), {.accuracy = "screening", .threads = 2});
  const std::vector<Layout> layouts = boxes(8);
  const std::vector<WorldOutcome> expected = screen.evaluate(layouts);
  for (const Layout& layout : layouts) REQUIRE(screen.submit(layout));
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    bool good = screen.in_flight() == 0;
    {
      Screen own = std::move(screen);  // destroyed in this process too
      FinishedLayout finished;
      good = good && own.submit(layouts[3]) && own.poll(finished, kPatience);
      good = good && finished.worlds[1].state_hash == expected[7].state_hash;
      good = good && own.evaluate(layouts).back().state_hash == expected.back().state_hash;
    }
    _exit(good ? 0 : 1);
  }
  int status = 1;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  FinishedLayout finished;
  for (std::size_t i = 0; i < layouts.size(); ++i) REQUIRE(screen.poll(finished, kPatience));
}

TEST_CASE("screen: every layout that finishes is announced", "[api][stream]") {
  std::atomic<int> announced = 0;
  Screen screen(two_accelerations(), {.accuracy = "screening", .threads = 2, .on_finished = [&] { ++announced; }});
  for (const Layout& layout : boxes(5)) REQUIRE(screen.submit(layout));
  FinishedLayout finished;
  for (int i = 0; i < 5; ++i) REQUIRE(screen.poll(finished, kPatience));
  CHECK(announced == 5);
}

}  // namespace screen_stream_test
