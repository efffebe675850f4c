#include "app/validate/validation_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "api/engine_loader.hpp"
#include "app/progress.hpp"
#include "parallel/schedulers/ordered_run.hpp"
#include "parallel/schedulers/ticker.hpp"

namespace holdfast::internal {

namespace {

/// One thing to measure: a case, or a load, with a setting.
struct Task {
  const EngineSetting* setting = nullptr;
  const Case* known = nullptr;
  const LoadWorld* load = nullptr;
};

/// What came out of a task.
struct Finding {
  Task task;
  std::vector<Measurement> measurements;  ///< of a case
  LoadRun load;                           ///< of a load
  RunCost cost;
};

/// All tasks, setting by setting: cases in their order, then loads.
std::vector<Task> tasks_of(const ValidationPlan& plan, const std::vector<EngineSetting>& references) {
  std::vector<Task> tasks;
  const auto add_loads = [&](const EngineSetting& setting) {
    for (const LoadWorld& load : plan.loads) tasks.push_back({&setting, nullptr, &load});
  };
  if (!plan.loads.empty())
    for (const EngineSetting& reference : references) add_loads(reference);
  for (const EngineSetting& setting : plan.settings) {
    for (const Case& known : plan.cases)
      if (known.quick || !setting.quick_cases_only) tasks.push_back({&setting, &known, nullptr});
    // A setting that is a reference would be compared with itself.
    const bool is_reference = std::any_of(references.begin(), references.end(), [&](const EngineSetting& reference) {
      return reference.engine == setting.engine && reference.name == setting.name;
    });
    if (!is_reference && setting.loads) add_loads(setting);
  }
  return tasks;
}

Finding measure(const Task& task, const std::atomic<bool>& stop) {
  Laboratory laboratory(make_engine, *task.setting, stop);
  Finding finding{.task = task};
  if (task.known != nullptr) {
    finding.measurements = task.known->measure(laboratory);
  } else {
    finding.load = run_load(laboratory, *task.load);
  }
  finding.cost = laboratory.cost();
  return finding;
}

/// Collects findings into rows and costs. The runs of the references are kept, those of a setting until compared.
class Collector {
 public:
  Collector(const ValidationPlan& plan, const std::vector<EngineSetting>& references)
      : load_count_(plan.loads.size()), references_(references) {}

  void add(Finding&& finding) {
    const EngineSetting& setting = *finding.task.setting;
    if (finding.task.known != nullptr) {
      const Case& known = *finding.task.known;
      for (Measurement& measurement : finding.measurements) {
        result_.rows.push_back(
            {known.suite, known.name, setting.engine, setting.name, std::move(measurement), finding.cost.cpu_seconds});
      }
      charge(known.suite, setting, finding.cost);
      return;
    }
    charge("load", setting, finding.cost);
    runs_.push_back(std::move(finding.load));
    if (runs_.size() < load_count_) return;
    finish_loads(setting);
  }

  ValidationResult take() { return std::move(result_); }

 private:
  void charge(const std::string& suite, const EngineSetting& setting, const RunCost& cost) {
    std::vector<SuiteCost>& costs = result_.costs;
    const auto same = [&](const SuiteCost& entry) {
      return entry.suite == suite && entry.engine == setting.engine && entry.setting == setting.name;
    };
    auto entry = std::find_if(costs.begin(), costs.end(), same);
    if (entry == costs.end()) entry = costs.insert(costs.end(), {suite, setting.engine, setting.name, {}});
    entry->cost.cpu_seconds += cost.cpu_seconds;
    entry->cost.box_seconds += cost.box_seconds;
  }

  /// All loads of a setting are there: compare them, or keep them when they are the reference.
  void finish_loads(const EngineSetting& setting) {
    const std::vector<LoadRun> runs = std::exchange(runs_, {});
    if (&setting == &references_[0]) {
      first_ = runs;
      return;
    }
    const bool is_second = &setting == &references_[1];
    if (is_second) second_ = runs;
    double cpu_seconds = 0.0;
    for (const LoadRun& run : runs) cpu_seconds += run.cpu_seconds;
    for (Measurement& measurement : compare_loads(runs, first_, second_)) {
      result_.rows.push_back({"load", is_second ? "second_reference" : "real_loads", setting.engine, setting.name,
                              std::move(measurement), cpu_seconds});
    }
  }

  std::size_t load_count_;
  const std::vector<EngineSetting>& references_;
  std::vector<LoadRun> runs_, first_, second_;
  ValidationResult result_;
};

}  // namespace

ValidationResult run_validation(const ValidationPlan& plan, const std::atomic<bool>& stop) {
  const std::vector<EngineSetting>& references = load_references();
  const std::vector<Task> tasks = tasks_of(plan, references);
  Collector collector(plan, references);
  RunProgress progress{.total = tasks.size()};
  {
    ProgressLine line(progress, "cases", stderr, plan.quiet);
    const Ticker ticker(std::chrono::milliseconds(250), [&] { line.show(); });
    Workers workers(Scheduler::tbb, plan.threads);
    run_in_order(
        workers, tasks.size(),
        [&](std::size_t i) -> std::optional<Finding> {
          if (stop) return std::nullopt;
          return measure(tasks[i], stop);
        },
        [](Finding&& finding) { return std::move(finding); }, [](Finding&& finding) { return std::move(finding); },
        [&](Finding&& finding) {
          if (stop) return false;
          collector.add(std::move(finding));
          ++progress.done;
          return true;
        });
  }
  ValidationResult result = collector.take();
  result.complete = progress.done == progress.total;
  return result;
}

}  // namespace holdfast::internal
