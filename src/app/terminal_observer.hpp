#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/progress.hpp"
#include "app/screening.hpp"
#include "core/engine/run_observer.hpp"
#include "io/results/run_description.hpp"
#include "parallel/schedulers/ticker.hpp"

namespace holdfast::internal {

/// Shows a run at a terminal: progress and notes on standard error, one JSON object per world, and
/// per layout with margins, on standard output.
class TerminalObserver final : public RunObserver {
 public:
  /// All must outlive this.
  TerminalObserver(const ScreeningJob& job, const RunDescription& description, const StopRequest& stop)
      : job_(job), description_(description), stop_(stop) {}

  void started(const RunProgress& progress) override;
  void warned(const Error& warning) override;
  void layout_begins(const LayoutRecord& layout) override;
  void layout_finished(const LayoutRecord& layout) override;
  void world_finished(const WorldRecord& world, std::size_t index) override;
  void ended() override;

 private:
  /// The line on the terminal, brought up to date four times per second by a thread of its own.
  struct Display {
    Display(const RunProgress& progress, bool quiet) : line(progress, "worlds", stderr, quiet) {}
    ProgressLine line;
    bool stop_shown = false;
  };

  void note(std::string text);
  void tick();

  const ScreeningJob& job_;
  const RunDescription& description_;
  const StopRequest& stop_;
  std::size_t warning_count_ = 0;
  std::map<std::uint64_t, std::vector<std::string>> box_names_;  ///< of layouts whose worlds are to come, by index
  std::mutex notes_mutex_;
  std::vector<std::string> notes_;  ///< lines that the display's thread will print
  std::optional<Display> display_;
  std::unique_ptr<Ticker> ticker_;
};

}  // namespace holdfast::internal
