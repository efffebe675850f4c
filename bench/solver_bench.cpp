// Contact problems of real worlds, written to files and solved alone: how contact solvers are compared.
//
//   solver_bench dump LAYOUT ACCELERATION FOLDER [--accuracy NAME] [--every N]
//   solver_bench solve FILES... [--solver admm] [--repeat N] [--reference ITERATIONS]

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/series_recorder.hpp"
#include "core/engine/simulate.hpp"
#include "core/native/native_world.hpp"
#include "core/native/solver/admm.hpp"
#include "core/native/solver/problem_bytes.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_file.hpp"
#include "solver_error.hpp"

namespace holdfast::internal::native {

namespace {

[[noreturn]] void fail(const std::string& what) {
  fmt::print(stderr, "solver_bench: {}\n", what);
  std::exit(1);
}

template <class T>
T value_or_fail(Result<T> result) {
  if (!result) fail(result.error().message());
  return std::move(*result);
}

int whole_number(const std::string& text) {
  char* end = nullptr;
  const long number = std::strtol(text.c_str(), &end, 10);
  if (end == text.c_str() || *end != '\0' || number < 1 || number > 1'000'000) fail("no number from 1: " + text);
  return static_cast<int>(number);
}

using Options = std::map<std::string, std::string>;

/// Writes every n-th problem that it is given, and has another solver solve it. A problem that goes on from the
/// solve before is left out: it cannot be solved alone.
class DumpingSolver final : public ContactSolver {
 public:
  DumpingSolver(std::filesystem::path folder, int every) : folder_(std::move(folder)), every_(every) {}

  std::span<const std::uint32_t> order(std::size_t count, std::span<const BodyPair> pairs) override {
    return solver_->order(count, pairs);
  }

  SolveResult solve(ContactProblem& problem, const SolveLimits& limits) override {
    if (!problem.continues && !problem.constraints.empty() && count_++ % every_ == 0) {
      const std::string bytes = bytes_of({problem, limits});
      std::ofstream file(folder_ / fmt::format("{:07}.problem", count_ - 1), std::ios::binary);
      if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        fail(fmt::format("{}: cannot be written", folder_.string()));
    }
    return solver_->solve(problem, limits);
  }

 private:
  std::filesystem::path folder_;
  int every_;
  int count_ = 0;
  std::unique_ptr<ContactSolver> solver_ = make_contact_solver();
};

/// The native engine for one world, with a solver of its own.
class DumpingEngine final : public Engine {
 public:
  DumpingEngine(const Settings& settings, std::filesystem::path folder, int every)
      : settings_(settings), folder_(std::move(folder)), every_(every) {}

  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override {
    const NativeOptions options = native_options(settings_);
    auto memory = std::make_unique<WorldMemory>(options, std::make_unique<DumpingSolver>(folder_, every_));
    return std::make_unique<OneWorld>(
        std::make_unique<NativeWorld>(batch, batch.worlds.front(), settings_, options, std::move(memory)));
  }

 private:
  class OneWorld final : public SteppedSimulation {
   public:
    explicit OneWorld(std::unique_ptr<NativeWorld> world) : world_(std::move(world)) {}
    void read_back(std::size_t /*world*/, StateColumns& state) const override { world_->read_back(state); }
    Counters counters(std::size_t /*world*/) const override { return world_->counters(); }
    Status status(std::size_t /*world*/) const override { return world_->status(); }

   private:
    double step(std::size_t /*world*/, const Phase& phase) override { return world_->advance(phase); }

    std::unique_ptr<NativeWorld> world_;
  };

  Settings settings_;
  std::filesystem::path folder_;
  int every_;
  EngineTraits traits_;
};

void dump(const std::vector<std::string>& arguments, const Options& options) {
  if (arguments.size() != 3) fail("dump takes a layout, an acceleration and a folder");
  Settings settings;
  const std::map<std::string, Accuracy> accuracies = {
      {"screening", Accuracy::screening}, {"standard", Accuracy::standard}, {"reference", Accuracy::reference}};
  const auto accuracy = accuracies.find(options.at("--accuracy"));
  if (accuracy == accuracies.end()) fail("no accuracy: " + options.at("--accuracy"));
  settings.native.accuracy = accuracy->second;
  std::vector<Error> warnings;
  const Layout layout = value_or_fail(parse_layout(value_or_fail(read_text_file(arguments[0])), settings, warnings));
  const Acceleration acceleration =
      value_or_fail(parse_acceleration(value_or_fail(read_text_file(arguments[1])), warnings));
  std::filesystem::create_directories(arguments[2]);
  const Acceleration* const accelerations[] = {&acceleration};
  const Layout* const layouts[] = {&layout};
  WorldBatch batch = make_batch(layouts, accelerations, settings);
  SeriesRecorder recorder(recording_plan(settings, false));
  Recorder* const recorders[] = {&recorder};
  const std::atomic<bool> abort = false;
  simulate(DumpingEngine(settings, arguments[2], whole_number(options.at("--every"))), batch, settings, recorders,
           abort);
}

/// Velocity errors of solves, against the same problems solved for long.
class ErrorTable {
 public:
  explicit ErrorTable(int iterations) : iterations_(iterations) {}

  /// The columns of a problem: mean and worst error, residual of the reference, and what two methods disagree by in the
  /// mean, in units of the limits.
  std::string add(const StoredProblem& stored, const ContactProblem& found) {
    const double unit = stored.limits.velocity_unit;
    const LongSolve reference = solve_for_long(stored.problem, stored.limits, iterations_);
    const VelocityDifference error = velocity_difference(found, reference.problem);
    means_.push_back(error.mean / unit);
    worst_.push_back(error.worst / unit);
    const auto methods = method_difference(stored.problem, stored.limits, iterations_);
    if (methods) methods_.push_back(methods->mean / unit);
    return fmt::format(" {:10.2e} {:10.2e} {:10.2e} {:>10}", means_.back(), worst_.back(),
                       reference.result.residual / unit, methods ? fmt::format("{:.2e}", methods_.back()) : "-");
  }

  void print_summary() {
    fmt::print("velocity error over unit, quartiles and largest of {} problems: mean {}, worst {}\n", means_.size(),
               quartiles(means_), quartiles(worst_));
    fmt::print("two methods, mean difference over unit, of {} problems that both can solve: {}\n", methods_.size(),
               quartiles(methods_));
  }

 private:
  static std::string quartiles(std::vector<double>& values) {
    if (values.empty()) return "none";
    std::sort(values.begin(), values.end());
    const auto at = [&](std::size_t quarter) { return values[quarter * (values.size() - 1) / 4]; };
    return fmt::format("{:.1e} {:.1e} {:.1e} {:.1e}", at(1), at(2), at(3), at(4));
  }

  int iterations_;
  std::vector<double> means_, worst_, methods_;
};

void solve(const std::vector<std::string>& files, const Options& options) {
  if (files.empty()) fail("solve takes files of problems");
  if (options.at("--solver") != "admm") fail("no solver: " + options.at("--solver") + "; there is admm");
  const int repeat = whole_number(options.at("--repeat"));
  std::optional<ErrorTable> errors;
  if (options.at("--reference") != "none") errors.emplace(whole_number(options.at("--reference")));
  fmt::print("{:>7} {:>7} {:>11} {:>10} {:>7} {:>12} {:>9} {:>10}{}  file\n", "bodies", "points", "constraints",
             "iterations", "factors", "residual/unit", "converged", "time (us)",
             errors ? fmt::format(" {:>10} {:>10} {:>10} {:>10}", "mean error", "worst", "reference", "methods") : "");
  long iterations = 0, factorisations = 0;
  double seconds = 0.0;
  AdmmSolver solver;
  for (const std::string& path : files) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    Result<StoredProblem> read = problem_from(bytes);
    if (!read) fail(path + ": " + read.error().what);
    SolveResult result;
    double best = 0.0;
    ContactProblem problem;
    for (int i = 0; i < repeat; ++i) {
      problem = read->problem;
      solver.order(problem.bodies.size(), problem.pairs);
      const auto start = std::chrono::steady_clock::now();
      result = solver.solve(problem, read->limits);
      const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      best = i == 0 ? time : std::min(best, time);
    }
    int points = 0;
    for (const ContactConstraint& constraint : read->problem.constraints) points += constraint.count;
    fmt::print("{:7} {:7} {:11} {:10} {:7} {:13.3e} {:>9} {:10.1f}{}  {}\n", read->problem.bodies.size(), points,
               read->problem.constraints.size(), result.iterations, result.factorisations,
               result.residual / read->limits.velocity_unit, result.converged ? "yes" : "no", 1e6 * best,
               errors ? errors->add(*read, problem) : "", path);
    iterations += result.iterations;
    factorisations += result.factorisations;
    seconds += best;
  }
  fmt::print("{} problems: {} iterations, {} factorisations, {:.3f} s\n", files.size(), iterations, factorisations,
             seconds);
  if (errors) errors->print_summary();
}

}  // namespace

}  // namespace holdfast::internal::native

int main(int count, char** values) {
  using namespace holdfast::internal::native;
  const std::vector<std::string> words(values + 1, values + count);
  Options options = {
      {"--accuracy", "screening"}, {"--every", "1"}, {"--solver", "admm"}, {"--repeat", "1"}, {"--reference", "none"}};
  std::vector<std::string> arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("--")) {
      arguments.push_back(words[i]);
      continue;
    }
    const auto option = options.find(words[i]);
    if (option == options.end() || i + 1 == words.size()) fail("no such option, or no value: " + words[i]);
    option->second = words[++i];
  }
  if (arguments.empty() || (arguments.front() != "dump" && arguments.front() != "solve"))
    fail(
        "dump LAYOUT ACCELERATION FOLDER [--accuracy NAME] [--every N], or solve FILES... [--solver admm] [--repeat "
        "N] [--reference ITERATIONS]");
  const bool dumps = arguments.front() == "dump";
  arguments.erase(arguments.begin());
  dumps ? dump(arguments, options) : solve(arguments, options);
  return 0;
}
