// Takes one world forward in pieces with holdfast::core, and prints where its box is, and the state hash at the end.
#include <cstdio>
#include <holdfast/holdfast.hpp>

int main() {
  const holdfast::Layout layout{"one box", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 1}}};
  const holdfast::Acceleration brake{"brake", {{0.0, 1.0, {7.0, 0.0, 0.0}}}};
  try {
    holdfast::World world(layout, brake);
    for (double time = 0.0; world.time() < world.end_time(); time += 0.25) {
      world.advance(time);
      std::printf("%.2f s: x = %.4f m\n", world.time(), world.poses()[0].position[0]);
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(world.state_hash()));
  } catch (const holdfast::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
