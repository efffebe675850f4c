#include "app/outcome_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "analyses/analysis.hpp"
#include "core/engine/simulate.hpp"
#include "io/results/load_names.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

constexpr std::size_t kWorstShown = 5;
constexpr std::size_t kUnstableShown = 10;

/// What the table says of one world.
struct WorldLine {
  std::uint64_t layout = 0;
  std::uint64_t acceleration = 0;
  std::uint32_t boxes = 0, fallen = 0, moved = 0, tilted = 0, critical_box = 0;
  float peak_displacement = 0.0F;
  bool is_at_least = false;  ///< it ended when its verdict was decided

  /// Worse first; the names' order decides between equals.
  auto badness() const { return std::tuple(fallen, moved + tilted, peak_displacement); }
};

/// Layouts under one acceleration, each counted once, by its verdict.
struct AccelerationLine {
  std::array<std::uint64_t, kVerdictCount> layouts{};
  std::optional<WorldLine> worst;

  std::uint64_t& of(Verdict verdict) { return layouts.at(static_cast<std::size_t>(verdict)); }
  std::uint64_t of(Verdict verdict) const { return layouts.at(static_cast<std::size_t>(verdict)); }
};

/// A layout that did not even stand under gravity alone.
struct UnstableLine {
  std::uint32_t boxes = 0, unstable = 0;
};

class Tally {
 public:
  Tally(ResultsReader& results, const Thresholds& thresholds, std::span<const double> planned_ends)
      : info_(results.info()),
        names_(results),
        is_judged_again_(thresholds != info_.thresholds),
        planned_ends_(planned_ends),
        accelerations_(info_.accelerations.size()) {}

  /// False when a world names an acceleration that the file does not have.
  bool add(const SummarySlice& slice) {
    for (std::size_t i = 0; i < slice.rows.size(); ++i) {
      if (slice.rows[i].acceleration >= accelerations_.size()) return false;
      add(slice.rows[i], slice.worlds[i]);
    }
    return true;
  }

  OutcomeTable table() {
    constexpr const char* kLine = "{:<{}}  {:>6}  {:>6}  {:>6}{}  {:>8}  {:>6}  {}\n";
    std::string text =
        "\n" + fmt::format(kLine, "layouts that", name_width(), "stayed", "moved", "fell",
                           where_any(Verdict::not_needed, "not needed"), "unstable", "failed", "the worst one");
    std::uint64_t failed = 0;
    for (std::size_t i = 0; i < accelerations_.size(); ++i) {
      const AccelerationLine& line = accelerations_[i];
      text += fmt::format(kLine, printable(info_.accelerations[i]), name_width(), line.of(Verdict::stayed),
                          line.of(Verdict::moved), line.of(Verdict::fell),
                          where_any(Verdict::not_needed, line.of(Verdict::not_needed)), line.of(Verdict::unstable),
                          line.of(Verdict::failed), line.worst ? name_of_layout(line.worst->layout) : "-");
      failed += line.of(Verdict::failed);
    }
    return {text + worst_lines() + unstable_lines() + failed_lines() + caveat_lines() + skipped_line() + saved_line(),
            failed};
  }

 private:
  void add(const WorldRow& row, const WorldVerdict& world) {
    AccelerationLine& line = accelerations_[row.acceleration];
    steps_ += row.steps;
    steps_skipped_ += row.steps_skipped;
    if (!planned_ends_.empty() && (row.stop_reason != StopReason::not_run || row.status == Status::not_needed)) {
      const double planned_end = planned_ends_[row.acceleration];
      time_ += planned_end;
      time_saved_ += time_saved(row.status, row.stop_reason, row.end_time, planned_end);
    }
    ++line.of(world.verdict);
    for (std::size_t i = 0; i < std::size(kCaveatNames); ++i)
      if (has(row.caveats, static_cast<Caveat>(kCaveatNames[i].code))) ++caveats_.at(i);
    if (row.stop_reason == StopReason::decided) ++decided_;
    if (world.verdict == Verdict::failed) {
      failures_.emplace(row.message, 0).first->second += 1;
      return;
    }
    if (world.verdict == Verdict::not_needed) return;
    if (world.verdict == Verdict::fell || world.verdict == Verdict::moved)
      add_to_worst({row.layout, row.acceleration, row.boxes, world.fallen, world.moved, world.tilted,
                    world.critical_box, world.peak_displacement, row.stop_reason == StopReason::decided},
                   line);
    if (world.verdict == Verdict::unstable) unstable_[row.layout] = {row.boxes, world.unstable};
  }

  /// An entry of a column that the table has only where there are such verdicts.
  template <class Entry>
  std::string where_any(Verdict verdict, const Entry& entry) const {
    const bool any = std::any_of(accelerations_.begin(), accelerations_.end(),
                                 [&](const AccelerationLine& line) { return line.of(verdict) > 0; });
    return any ? fmt::format("  {:>10}", entry) : "";
  }

  void add_to_worst(const WorldLine& world, AccelerationLine& line) {
    if (!line.worst || world.badness() > line.worst->badness()) line.worst = world;
    const auto worse = [](const WorldLine& a, const WorldLine& b) { return a.badness() > b.badness(); };
    worst_.insert(std::upper_bound(worst_.begin(), worst_.end(), world, worse), world);
    if (worst_.size() > kWorstShown) worst_.pop_back();
  }

  std::string name_of_layout(std::uint64_t layout) const { return printable(info_.layout_name(layout)); }

  std::size_t name_width() const {
    std::size_t width = std::string_view("layouts that").size();
    for (const std::string& name : info_.accelerations) width = std::max(width, name.size());
    return width;
  }

  std::string worst_lines() {
    if (worst_.empty()) return "";
    std::string text = "\nworst worlds\n";
    for (const WorldLine& world : worst_) {
      text += fmt::format(
          "  {} under {}: of {} boxes{} {} fell, {} moved, {} tilted; farthest {:.2f} m{}\n",
          name_of_layout(world.layout), printable(info_.accelerations[world.acceleration]), world.boxes,
          world.is_at_least ? " at least" : "", world.fallen, world.moved, world.tilted, world.peak_displacement,
          world.critical_box > 0 ? fmt::format("; {} first", names_.box_text(world.layout, world.critical_box)) : "");
    }
    return text;
  }

  std::string unstable_lines() const {
    if (unstable_.empty()) return "";
    std::string text = "\nunstable: beyond a limit while settling, before any acceleration\n";
    std::size_t shown = 0;
    for (const auto& [layout, line] : unstable_) {
      if (shown++ == kUnstableShown) break;
      text += fmt::format("  {}: {} of {} boxes\n", name_of_layout(layout), line.unstable, line.boxes);
    }
    if (unstable_.size() > kUnstableShown) text += fmt::format("  and {} more\n", unstable_.size() - kUnstableShown);
    return text;
  }

  std::string failed_lines() const {
    if (failures_.empty()) return "";
    std::string text = "\nfailed\n";
    std::size_t shown = 0;
    for (const auto& [reason, count] : failures_) {
      if (shown++ == kUnstableShown) break;
      text += fmt::format("  {} world{}: {}\n", count, count == 1 ? "" : "s", printable(reason));
    }
    if (failures_.size() > kUnstableShown)
      text += fmt::format("  and {} more reasons\n", failures_.size() - kUnstableShown);
    return text;
  }

  /// What has to be known beside the verdicts.
  std::string caveat_lines() const {
    std::string text;
    for (std::size_t i = 0; i < std::size(kCaveatNames); ++i)
      if (caveats_.at(i) > 0) text += worlds_line(caveats_.at(i), kCaveatNames[i].name, kCaveatNames[i].sentence);
    if (is_judged_again_ && decided_ > 0)
      text += worlds_line(
          decided_, "ended early",
          "by a limit of the run, as unstable loads do; a verdict is at least what that says, so simulate again for "
          "looser ones");
    return (text.empty() ? "" : "\ncaveats\n" + text) +
           "\nThe load is judged as it stands: straps, air bags and stretch film are not modelled.\n";
  }

  static std::string worlds_line(std::uint64_t count, std::string_view name, std::string_view sentence) {
    return fmt::format("  {} world{} {}: {}\n", count, count == 1 ? "" : "s", name, sentence);
  }

  /// Nothing where the engine computes every step.
  std::string skipped_line() const {
    if (steps_skipped_ == 0) return "";
    return fmt::format("\nsteps skipped, since nothing moved in them: {:.1f} % of {}\n",
                       100.0 * static_cast<double>(steps_skipped_) / static_cast<double>(steps_), steps_);
  }

  /// Nothing where no world ended early and all were needed.
  std::string saved_line() const {
    if (time_saved_ == 0.0) return "";
    return fmt::format("\nsimulated time saved, since worlds ended early or were not needed: {:.1f} % of {:.0f} s\n",
                       100.0 * time_saved_ / time_, time_);
  }

  const ResultsInfo& info_;
  LoadNames names_;
  bool is_judged_again_ = false;  ///< by other limits than those of the run
  std::span<const double> planned_ends_;
  std::vector<AccelerationLine> accelerations_;
  std::vector<WorldLine> worst_;
  std::map<std::uint64_t, UnstableLine> unstable_;                ///< by layout
  std::map<std::string, std::uint64_t> failures_;                 ///< worlds by reason
  std::array<std::uint64_t, std::size(kCaveatNames)> caveats_{};  ///< worlds that have each
  std::uint64_t decided_ = 0;                                     ///< worlds that ended by a limit
  std::uint64_t steps_ = 0;
  std::uint64_t steps_skipped_ = 0;
  double time_ = 0.0;  ///< that all worlds would have taken, s
  double time_saved_ = 0.0;
};

}  // namespace

Result<OutcomeTable> outcome_table(ResultsReader& results, const Thresholds& thresholds,
                                   std::span<const double> planned_ends) {
  Tally tally(results, thresholds, planned_ends);
  const auto add = [&](const SummarySlice& slice) -> std::optional<Error> {
    if (tally.add(slice)) return std::nullopt;
    return Error{.file = results.info().path,
                 .what = "is damaged: a world has an acceleration that is not in the file"};
  };
  if (const auto error = derive_summary(results, thresholds, add)) return *error;
  OutcomeTable table = tally.table();
  if (results.info().judged_at_end())
    table.text.insert(0,
                      "\njudged by where boxes are at the end: the file is of an earlier version, which has nothing of "
                      "what they did on the way\n");
  return table;
}

Result<std::string> analysis_tables(ResultsReader& results) {
  std::string text;
  for (const Analysis* analysis : all_analyses()) {
    if (analysis->table == nullptr || !results.info().has(analysis->tables)) continue;
    const Result<std::string> table = analysis->table(results);
    if (!table) return table.errors();
    text += *table;
  }
  return text;
}

}  // namespace holdfast::internal
