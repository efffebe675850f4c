// Calls the library again and again, from C++ or through its C interface, and prints what the calls cost.
//
//     call_cost c++|c ACCELERATION THREADS CALLS each|together LAYOUT...
//
// A call evaluates one layout, in turn, or all of them together, at accuracy `screening`. One line of JSON says the
// wall time of all calls; the overhead of a call, which is its wall time less `cpu_seconds`, the processor time of
// building and simulating its worlds, as median and 99th percentile (on several threads it means nothing); the
// processor time of the process for all calls; and its resident memory after a tenth of the calls and after all.
// compare.py makes tables of it.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <holdfast/holdfast.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "holdfast/holdfast.h"

namespace {

using Seconds = std::chrono::duration<double>;

/// Evaluates so many layouts from the given one on. Returns the processor time of their worlds, s.
using Call = std::function<double(std::size_t first, std::size_t count)>;

constexpr const char* kAccuracy = "screening";

Call call_of_cpp(const holdfast::Acceleration& acceleration, int threads, std::vector<holdfast::Layout> layouts) {
  const auto screen = std::make_shared<holdfast::Screen>(
      std::vector{acceleration}, holdfast::ScreenOptions{.accuracy = kAccuracy, .threads = threads});
  return [screen, layouts = std::move(layouts), worlds = std::vector<holdfast::WorldOutcome>()](
             std::size_t first, std::size_t count) mutable {
    screen->evaluate(std::span(layouts).subspan(first, count), worlds);
    double simulated = 0.0;
    for (const holdfast::WorldOutcome& world : worlds) simulated += world.cpu_seconds;
    return simulated;
  };
}

void require(int code, const holdfast_screen* screen) {
  if (code != HOLDFAST_OK) throw std::runtime_error(holdfast_screen_message(screen));
}

Call call_of_c(const holdfast::Acceleration& acceleration, int threads, const std::vector<holdfast::Layout>& layouts) {
  holdfast_screen_options options = {};
  options.size = sizeof options;
  options.accuracy = kAccuracy;
  options.threads = threads;
  holdfast_screen* made = nullptr;
  require(holdfast_screen_new(nullptr, &options, &made), made);
  const std::shared_ptr<holdfast_screen> screen(made, holdfast_screen_free);
  std::vector<double> segments;
  for (const holdfast::Segment& segment : acceleration.segments) {
    segments.insert(segments.end(), {segment.start, segment.duration});
    segments.insert(segments.end(), segment.acceleration.begin(), segment.acceleration.end());
  }
  require(holdfast_screen_add_acceleration(made, nullptr, segments.data(), acceleration.segments.size()), made);
  std::vector<double> boxes;
  std::vector<std::size_t> offsets = {0};
  for (const holdfast::Layout& layout : layouts) {
    for (const holdfast::Box& box : layout.boxes) {
      boxes.insert(boxes.end(), box.corner_min.begin(), box.corner_min.end());
      boxes.insert(boxes.end(), box.corner_max.begin(), box.corner_max.end());
      boxes.push_back(box.material);
    }
    offsets.push_back(offsets.back() + layout.boxes.size());
  }
  return [screen, boxes = std::move(boxes), offsets = std::move(offsets),
          outcomes = std::vector<holdfast_outcome>(layouts.size())](std::size_t first, std::size_t count) mutable {
    const holdfast_layouts part = {sizeof part, boxes.data(), boxes.size() / 7, &offsets[first], count, nullptr};
    outcomes.front().size = sizeof(holdfast_outcome);
    require(holdfast_screen_evaluate(screen.get(), &part, outcomes.data(), outcomes.size()), screen.get());
    double simulated = 0.0;
    for (std::size_t i = 0; i < count; ++i) simulated += outcomes[i].cpu_seconds;
    return simulated;
  };
}

/// Resident memory of this process, KiB.
long resident() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long size = 0;
    if (word == "VmRSS:" && status >> size) return size;
  }
  return 0;
}

void measure(const Call& call, std::size_t calls, std::size_t layout_count, std::size_t at_once) {
  for (std::size_t first = 0; first < layout_count; first += at_once) call(first, at_once);
  std::vector<double> overheads(calls);
  long early = resident();
  const std::clock_t processor_begin = std::clock();
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < calls; ++i) {
    const auto called = std::chrono::steady_clock::now();
    const double simulated = call(i * at_once % layout_count, at_once);
    overheads[i] = Seconds(std::chrono::steady_clock::now() - called).count() - simulated;
    if (i == calls / 10) early = resident();
  }
  const double wall = Seconds(std::chrono::steady_clock::now() - begin).count();
  const double processor = static_cast<double>(std::clock() - processor_begin) / CLOCKS_PER_SEC;
  const long late = resident();
  std::sort(overheads.begin(), overheads.end());
  std::printf(
      "{\"wall\": %.9g, \"processor\": %.9g, \"median\": %.9g, \"percentile99\": %.9g, \"early\": %ld, \"late\": "
      "%ld}\n",
      wall, processor, overheads[calls / 2], overheads[calls * 99 / 100], early, late);
}

void run(char** words, std::size_t layout_count) {
  const holdfast::Acceleration acceleration = holdfast::read_acceleration(words[2]);
  const int threads = std::stoi(words[3]);
  const holdfast::Screen reader(std::vector{acceleration});
  std::vector<holdfast::Layout> layouts;
  for (std::size_t i = 0; i < layout_count; ++i) layouts.push_back(reader.read_layout(words[6 + i]));
  const bool is_c = std::strcmp(words[1], "c") == 0;
  const Call call = is_c ? call_of_c(acceleration, threads, layouts) : call_of_cpp(acceleration, threads, layouts);
  measure(call, std::stoul(words[4]), layout_count, std::strcmp(words[5], "each") == 0 ? 1 : layout_count);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 7) {
    std::fprintf(stderr, "usage: call_cost c++|c ACCELERATION THREADS CALLS each|together LAYOUT...\n");
    return 2;
  }
  try {
    run(argv, static_cast<std::size_t>(argc) - 6);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "call_cost: %s\n", error.what());
    return 1;
  }
  return 0;
}
