#include "options.hpp"

#include <charconv>
#include <stdexcept>

const char* const kUsage =
    "usage: loading_search INSTANCES PROBLEM ACCELERATION... [options]\n"
    "Searches for the fullest loading of a container that holds all accelerations.\n"
    "  --check loop|after  check loadings while searching, or when the search has ended (loop)\n"
    "  --seconds S         budget of processor time of all threads together (120)\n"
    "  --generations N     end after N generations, if that is sooner\n"
    "  --population N      loadings per generation, at least 10 (50)\n"
    "  --seed N            another seed, another search (1)\n"
    "  --threads N         threads that simulate; 0: one per core (0)\n"
    "  --out FOLDER        write the fullest loadings there as layout files\n"
    "  --asked FOLDER      write every loading that is checked there, in their order\n";

namespace {

template <typename Number>
Number number_of(const std::string& name, const std::string& word, Number least) {
  Number value = {};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !(value >= least))
    throw std::runtime_error(name + ": '" + word + "' is no number from " + std::to_string(least));
  return value;
}

}  // namespace

Options read_options(const std::vector<std::string>& words) {
  Options options;
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& name = words[i];
    if (!name.starts_with("--")) {
      paths.push_back(name);
      continue;
    }
    if (++i == words.size()) throw std::runtime_error(name + " needs a value");
    const std::string& value = words[i];
    if (name == "--check") {
      if (value != "loop" && value != "after")
        throw std::runtime_error("--check is 'loop' or 'after', not '" + value + "'");
      options.check = value == "loop" ? CheckWhen::in_loop : CheckWhen::afterwards;
    } else if (name == "--seconds") {
      options.seconds = number_of(name, value, 0.0);
    } else if (name == "--generations") {
      options.generations = number_of(name, value, 1);
    } else if (name == "--population") {
      options.population = number_of(name, value, std::size_t{10});
    } else if (name == "--seed") {
      options.seed = number_of(name, value, std::uint64_t{0});
    } else if (name == "--threads") {
      options.threads = number_of(name, value, 0);
    } else if (name == "--out") {
      options.out_folder = value;
    } else if (name == "--asked") {
      options.asked_folder = value;
    } else {
      throw std::runtime_error("there is no option " + name);
    }
  }
  if (paths.size() < 3)
    throw std::runtime_error("a file of instances, a problem and at least one acceleration are needed");
  options.instances = paths[0];
  options.problem = number_of("problem", paths[1], 1);
  options.accelerations.assign(paths.begin() + 2, paths.end());
  return options;
}
