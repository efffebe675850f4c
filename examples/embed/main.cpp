// Screens layouts in memory with the installed library, and prints one line per world: layout, acceleration, verdict
// and state hash.
//
//     embed ACCELERATION LAYOUT...
#include <cstdio>
#include <holdfast/holdfast.hpp>
#include <vector>

namespace {

const char* name_of(holdfast::Verdict verdict) {
  // No verdict has the code 5.
  static constexpr const char* kNames[] = {"stayed", "moved", "fell", "unstable", "failed", nullptr, "not_needed"};
  return kNames[static_cast<int>(verdict)];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: embed ACCELERATION LAYOUT...\n");
    return 2;
  }
  try {
    holdfast::Screen screen({holdfast::read_acceleration(argv[1])}, {.accuracy = "screening"});
    std::vector<holdfast::Layout> layouts;
    for (int i = 2; i < argc; ++i) layouts.push_back(screen.read_layout(argv[i]));

    for (const holdfast::WorldOutcome& world : screen.evaluate(layouts))
      std::printf("%s %s %s %016llx\n", layouts[world.layout].name.c_str(),
                  screen.accelerations()[world.acceleration].name.c_str(), name_of(world.verdict),
                  static_cast<unsigned long long>(world.state_hash));
  } catch (const holdfast::Error& error) {
    for (const holdfast::Problem& problem : error.problems()) std::fprintf(stderr, "%s\n", problem.message.c_str());
    return 1;
  }
}
