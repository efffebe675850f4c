// What a call of `Screen::evaluate` costs beyond the simulation, and what it leaves in memory.
//
//     screen_overhead [CALLS]
//
// One layout of one box under one acceleration, on one thread, again and again. Wall time less `cpu_seconds`, which is
// the processor time of building and simulating the world, is the overhead: medians and the 99th percentile. The
// resident memory after a tenth of the calls and after all of them shows whether calls leave something behind.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <holdfast/holdfast.hpp>
#include <string>
#include <vector>

namespace {

/// Resident memory of this process, KiB.
long resident() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long size = 0;
    if (word == "VmRSS:" && status >> size) return size;
  }
  return 0;
}

void measure(const char* what, std::size_t layout_count, int threads, int calls) {
  const holdfast::Acceleration brake{"brake", {{0.0, 0.5, {4.0, 0.0, 0.0}}}};
  holdfast::Screen screen({brake}, {.accuracy = "screening", .threads = threads});
  const std::vector<holdfast::Layout> layouts(layout_count, {"one", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 1}}});
  std::vector<holdfast::WorldOutcome> worlds;
  std::vector<double> overheads;
  overheads.reserve(static_cast<std::size_t>(calls));
  long early = 0;
  for (int call = 0; call < calls; ++call) {
    const auto begin = std::chrono::steady_clock::now();
    screen.evaluate(layouts, worlds);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    double simulated = 0.0;
    for (const holdfast::WorldOutcome& world : worlds) simulated += world.cpu_seconds;
    overheads.push_back(1e6 * (wall - simulated / threads));
    if (call == calls / 10) early = resident();
  }
  std::sort(overheads.begin(), overheads.end());
  std::printf("%-24s %6.1f us median  %7.1f us 99th percentile  %+ld KiB over the last 90 %% of %d calls\n", what,
              overheads[overheads.size() / 2], overheads[overheads.size() * 99 / 100], resident() - early, calls);
}

}  // namespace

int main(int argc, char** argv) {
  const int calls = argc > 1 ? std::atoi(argv[1]) : 20000;
  measure("1 layout, 1 thread", 1, 1, calls);
  measure("16 layouts, 1 thread", 16, 1, calls);
  measure("16 layouts, 2 threads", 16, 2, calls);
}
