// Searches for the fullest loading of a container that holds all accelerations: a biased random-key genetic algorithm
// with holdfast in the loop, or after it. docs/guide/search.md compares the two.
//
//     loading_search bench/instances.txt 7 configs/accelerations/road_*.txt --seconds 120
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <holdfast/holdfast.hpp>
#include <stdexcept>

#include "options.hpp"
#include "search.hpp"

namespace {

/// Share of the budget that goes to a search by fill alone. Making a loading takes a hundredth of the time of a check
/// or less, so that full ones to begin with are cheap. Checking afterwards, the other half goes to checks.
constexpr double kByFillBeforeLoop = 0.03, kByFillBeforeChecks = 0.5;

constexpr std::size_t kChecksAtOnce = 32;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Prints a line whenever a fuller loading was found.
class Report {
 public:
  Report(const Search& search, const DynamicCheck& check) : search_(search), check_(check) {
    std::printf("%8s %10s %9s %8s %6s %8s %10s\n", "seconds", "generation", "loadings", "checked", "held", "fill",
                "that holds");
  }

  void after_generation(int generation) {
    const double fill = search_.fullest().fill, holding = search_.fullest_that_holds().fill;
    if (fill <= fill_ && holding <= holding_) return;
    fill_ = fill, holding_ = holding;
    std::printf("%8.2f %10d %9zu %8zu %6zu %8.4f %10.4f\n", processor_seconds(), generation, search_.loadings(),
                check_.checked(), check_.held(), fill_, holding_);
    std::fflush(stdout);
  }

  void at_end() const {
    const double seconds = processor_seconds();
    std::printf(
        "In %.1f s of processor time, %.0f %% of it simulation: %zu loadings, %.0f per second; %zu checked, %zu held\n",
        seconds, 100 * check_.cpu_seconds() / seconds, search_.loadings(),
        static_cast<double>(search_.loadings()) / seconds, check_.checked(), check_.held());
    std::printf("Fullest loading: %.4f; fullest that holds: ", fill_);
    if (search_.fullest_that_holds().boxes.empty())
      std::printf("none\n");
    else
      std::printf("%.4f\n", holding_);
  }

 private:
  const Search& search_;
  const DynamicCheck& check_;
  double fill_ = 0, holding_ = 0;
};

/// Writes a layout file, or a table where the boxes have masses; nothing for a loading without boxes.
void write(const Loading& loading, const Instance& instance, const std::filesystem::path& path) {
  if (loading.boxes.empty()) return;
  std::ofstream file(path);
  if (instance.has_masses())
    file << "x1\ty1\tz1\tx2\ty2\tz2\tmaterial\tweight\n";
  else
    file << instance.types.size() << '\t' << loading.boxes.size() << '\n';
  for (const auto& [place, type] : loading.boxes) {
    for (const Extents& corner : {place.low, place.high})
      for (const int coordinate : corner) file << coordinate << '\t';
    file << type + 1;
    if (instance.has_masses()) file << '\t' << instance.types[static_cast<std::size_t>(type)].mass;
    file << '\n';
  }
  if (!file.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

void run(const Options& options) {
  const Decoder decoder(read_instance(options.instances, options.problem));
  DynamicCheck check(decoder.instance(), options.accelerations, options.threads);
  if (!options.asked_folder.empty()) {
    std::filesystem::create_directories(options.asked_folder);
    check.on_loading = [&](const Loading& loading, std::size_t number) {
      char name[32];
      std::snprintf(name, sizeof name, "%06zu.txt", number);
      write(loading, decoder.instance(), std::filesystem::path(options.asked_folder) / name);
    };
  }
  Search search(decoder, check, {.population = options.population, .seed = options.seed});
  Report report(search, check);
  int generation = 0;
  const auto spent = [&] {
    return std::max(processor_seconds() / options.seconds, static_cast<double>(generation) / options.generations);
  };

  const bool in_loop = options.check == CheckWhen::in_loop;
  while (spent() < (in_loop ? kByFillBeforeLoop : kByFillBeforeChecks)) {
    search.generation_by_fill();
    report.after_generation(++generation);
  }
  if (in_loop) {
    search.forget_fitness();
    while (spent() < 1) {
      search.generation_by_fill_that_holds();
      report.after_generation(++generation);
    }
  } else {
    // Fullest first, so that the first that holds is the fullest that does.
    while (spent() < 1 && search.fullest_that_holds().boxes.empty() && search.check_fullest(kChecksAtOnce)) {
    }
    report.after_generation(generation);
  }
  report.at_end();

  if (options.out_folder.empty()) return;
  const std::filesystem::path folder = options.out_folder;
  std::filesystem::create_directories(folder);
  write(search.fullest(), decoder.instance(), folder / "fullest.txt");
  write(search.fullest_that_holds(), decoder.instance(), folder / "fullest_that_holds.txt");
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words.front() == "--help") {
    std::fputs(kUsage, words.empty() ? stderr : stdout);
    return words.empty() ? 2 : 0;
  }
  try {
    run(read_options(words));
  } catch (const holdfast::Error& error) {
    for (const holdfast::Problem& problem : error.problems()) std::fprintf(stderr, "%s\n", problem.message.c_str());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
