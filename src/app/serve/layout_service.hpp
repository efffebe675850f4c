#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/exit_code.hpp"
#include "app/serve/answers.hpp"
#include "app/serve/layout_request.hpp"
#include "app/serve/line_stream.hpp"
#include "app/serve/wake_up.hpp"
#include "app/stop_signal.hpp"
#include "core/model/settings.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// Reads layouts from standard input, evaluates them and writes answers to standard output, line by line, until the
/// input ends or a signal comes. One thread reads, writes and waits for both; those of the screen simulate.
///
/// Nothing more is read while a fixed number of lines per thread is without an answer. A screen evaluates lines with
/// the same options; when they change, the lines before are finished first, and a new screen is made.
class LayoutService {
 public:
  /// Throws `holdfast::Error` when there can be no such screen.
  /// @param options  of all screens, apart from what lines say
  /// @param settings that the options' config gives
  /// @param threads  of a screen
  LayoutService(std::vector<holdfast::Acceleration> accelerations, holdfast::ScreenOptions options,
                const Settings& settings, std::size_t threads, bool ordered, const StopSignal& stop);

  ExitCode run();

 private:
  /// A line without an answer.
  struct Open {
    std::uint64_t ticket = 0;  ///< of its answer
    AnsweredLine line;
  };
  /// One that waits until the lines before it are finished, because its options are others.
  struct Waiting {
    Open open;
    std::string text;  ///< the line
    LayoutRequest request;
  };

  void make_screen(const RequestOptions& wanted);
  std::size_t most_open() const;
  bool may_read() const { return !stop_.no_more && !waiting_ && answers_.outstanding() < most_open(); }
  void take_lines();
  void take(const InputLine& line);
  void submit(const Open& open, std::string_view text, const LayoutRequest& request);
  void submit_waiting();
  void give_finished();
  void wait();

  std::vector<holdfast::Acceleration> accelerations_;
  std::vector<std::string> names_;  ///< of the accelerations
  holdfast::ScreenOptions screen_options_;
  Settings settings_;
  std::size_t threads_;
  const StopSignal& stop_;
  LineStream input_;
  AnswerQueue answers_;
  std::uint64_t layouts_ = 0;  ///< lines that were not empty

  WakeUp finished_;
  RequestOptions options_;                 ///< of the screen
  std::vector<std::string> screen_names_;  ///< of its accelerations
  std::optional<holdfast::Screen> screen_;
  std::map<std::uint64_t, Open> in_flight_;  ///< by the ticket of the screen
  std::optional<Waiting> waiting_;
};

}  // namespace holdfast::internal
