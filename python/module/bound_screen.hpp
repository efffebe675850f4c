#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <holdfast/holdfast.hpp>
#include <optional>
#include <string>
#include <vector>

#include "layouts.hpp"

namespace holdfast::python {

/// A screen as the Python package uses it. One thread at a time calls it, which the package sees to; only `cancel` may
/// be called by others. `on_main_thread` says whether the caller is Python's main thread.
class BoundScreen {
 public:
  explicit BoundScreen(const ScreenOptions& options) : screen_(options), keep_boxes_(options.keep_boxes) {}

  void add_acceleration(std::string name, const pybind11::object& segments, std::string purpose) {
    screen_.add_acceleration(acceleration_of(std::move(name), segments, std::move(purpose)));
  }

  /// Name, segments and purpose of each acceleration, those of the norm first.
  pybind11::list accelerations() const;

  /// Table of verdicts, messages, problems of marked layouts, and tables of boxes or None.
  pybind11::tuple evaluate(const pybind11::object& layouts, const pybind11::object& offsets,
                           std::vector<std::string> names, bool on_main_thread);

  /// Whether each layout stays under every acceleration, of shape (layouts,).
  pybind11::array holds(const pybind11::object& layouts, const pybind11::object& offsets,
                        std::vector<std::string> names, bool on_main_thread);

  /// The verdict of the only acceleration, and the series, of one layout. For screens that keep series.
  pybind11::tuple replay(const pybind11::object& layout, bool on_main_thread);

  /// Nine numbers of each layout, of shape (layouts, 9), base support and supported sides of its boxes, and problems of
  /// marked layouts.
  pybind11::tuple indicators(const pybind11::object& layouts, const pybind11::object& offsets,
                             std::vector<std::string> names);

  /// Margins and critical boxes, and the same within the limits, of shape (layouts, 4), quantiles of the replicas'
  /// margins, (3, layouts, 4), trials and processor seconds, and problems of marked layouts.
  pybind11::tuple margins(const pybind11::object& layouts, const pybind11::object& offsets,
                          std::vector<std::string> names, bool on_main_thread);

  /// False when it was cancelled.
  bool record(const pybind11::object& layouts, const pybind11::object& offsets, std::vector<std::string> names,
              const std::string& path, const RecordOptions& options, bool on_main_thread);

  /// The ticket and the problems of a layout that was taken; None when there is no room.
  pybind11::object submit(const pybind11::object& layout, const std::string& name);

  /// Ticket, table, messages and boxes of a finished layout, for which it waits as long as any is in flight; None when
  /// none is.
  pybind11::object poll(bool ordered, bool on_main_thread);

  void cancel() { screen_.cancel(); }
  std::size_t in_flight() const { return screen_.in_flight(); }
  pybind11::array read_layout(const std::string& path) const { return array_of(screen_.read_layout(path)); }

 private:
  pybind11::object boxes(std::span<const WorldOutcome> worlds) const;

  Screen screen_;
  bool keep_boxes_;
  std::vector<WorldOutcome> worlds_;  ///< of the last call, whose memory is used again
  FinishedLayout finished_;
};

}  // namespace holdfast::python
