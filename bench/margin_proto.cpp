
#include <fmt/format.h>
#include <time.h>
#include <cstdlib>
#include "core/engine/margin_search.hpp"
#include "core/native/native_engine.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_file.hpp"
using namespace holdfast::internal;
double cpu() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}
int main(int n, char** a) {
  Settings settings;
  settings.native.accuracy = std::getenv("STD") ? Accuracy::standard : Accuracy::screening;
  NativeEngine engine(settings);
  std::atomic<bool> abort = false;
  for (int i = 1; i < n; ++i) {
    std::vector<Error> w;
    auto text = read_text_file(a[i]);
    auto layout = parse_layout(*text, settings, w);
    if (!layout) {
      fmt::print("{}: bad\n", a[i]);
      continue;
    }
    const double c0 = cpu();
    auto m = find_margins(engine, *layout, settings, abort);
    fmt::print("{:40} {:4} boxes", text->name, layout->boxes.size());
    for (int d = 0; d < 4; ++d) fmt::print("  {:6.3f} ({})", m->margin[d], m->critical_box[d]);
    fmt::print("  {} trials {:.1f} ms\n", m->trials, 1e3 * (cpu() - c0));
  }
}
