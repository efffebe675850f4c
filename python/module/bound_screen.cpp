#include "bound_screen.hpp"

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "interruptible.hpp"
#include "outcomes.hpp"
#include "problems.hpp"

namespace py = pybind11;

namespace holdfast::python {

namespace {

Layouts layouts_of(const py::object& layouts, const py::object& offsets, std::vector<std::string> names) {
  if (offsets.is_none()) return {layouts.cast<py::sequence>(), std::move(names)};
  return {layouts, offsets, std::move(names)};
}

/// A member of the margins, of shape (layouts, 4).
template <class Number>
py::array_t<Number> array_of(const std::vector<LayoutMargins>& margins, std::array<Number, 4> LayoutMargins::*member) {
  py::array_t<Number> array({static_cast<py::ssize_t>(margins.size()), py::ssize_t{4}});
  Number* next = array.mutable_data();
  for (const LayoutMargins& layout : margins) next = std::copy((layout.*member).begin(), (layout.*member).end(), next);
  return array;
}

}  // namespace

py::object BoundScreen::boxes(std::span<const WorldOutcome> worlds) const {
  if (!keep_boxes_) return py::none();
  return boxes_of(worlds, screen_.accelerations().size());
}

py::list BoundScreen::accelerations() const {
  py::list all;
  for (const Acceleration& acceleration : screen_.accelerations()) all.append(parts_of(acceleration));
  return all;
}

py::tuple BoundScreen::evaluate(const py::object& given, const py::object& offsets, std::vector<std::string> names,
                                bool on_main_thread) {
  const Layouts layouts = layouts_of(given, offsets, std::move(names));
  run_interruptible(screen_, on_main_thread, [&] { screen_.evaluate(layouts.views(), worlds_); });
  return py::make_tuple(table_of(worlds_, {layouts.views().size(), screen_.accelerations().size()}),
                        messages_of(worlds_), problems_of(screen_.problems()), boxes(worlds_));
}

py::array BoundScreen::holds(const py::object& given, const py::object& offsets, std::vector<std::string> names,
                             bool on_main_thread) {
  const Layouts layouts = layouts_of(given, offsets, std::move(names));
  std::vector<bool> found;
  run_interruptible(screen_, on_main_thread, [&] { found = screen_.holds(layouts.views()); });
  py::array_t<bool> holds(static_cast<py::ssize_t>(found.size()));
  std::copy(found.begin(), found.end(), holds.mutable_data());
  return holds;
}

py::tuple BoundScreen::replay(const py::object& layout, bool on_main_thread) {
  const Layouts layouts(py::make_tuple(layout), {});
  run_interruptible(screen_, on_main_thread, [&] { screen_.evaluate(layouts.views(), worlds_); });
  WorldOutcome& world = worlds_.front();
  const py::array table = table_of(worlds_, {1});
  return py::make_tuple(table, messages_of(worlds_), boxes(worlds_), series_of(std::move(world.series), world.boxes));
}

py::tuple BoundScreen::margins(const py::object& given, const py::object& offsets, std::vector<std::string> names,
                               bool on_main_thread) {
  const Layouts layouts = layouts_of(given, offsets, std::move(names));
  std::vector<LayoutMargins> found;
  run_interruptible(screen_, on_main_thread, [&] { found = screen_.margins(layouts.views()); });
  const auto count = static_cast<py::ssize_t>(found.size());
  py::array_t<double> spread({py::ssize_t{3}, count, py::ssize_t{4}});
  py::array_t<std::uint32_t> trials(count);
  py::array_t<double> cpu_seconds(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const LayoutMargins& layout = found[static_cast<std::size_t>(i)];
    const std::array quantiles = {layout.spread.low, layout.spread.median, layout.spread.high};
    for (std::size_t k = 0; k < quantiles.size(); ++k)
      std::copy(quantiles[k].begin(), quantiles[k].end(), spread.mutable_data(static_cast<py::ssize_t>(k), i, 0));
    trials.mutable_at(i) = layout.trials;
    cpu_seconds.mutable_at(i) = layout.cpu_seconds;
  }
  return py::make_tuple(array_of(found, &LayoutMargins::margin), array_of(found, &LayoutMargins::critical_box),
                        array_of(found, &LayoutMargins::margin_within_limits),
                        array_of(found, &LayoutMargins::critical_box_within_limits), spread, trials, cpu_seconds,
                        problems_of(screen_.problems()));
}

py::tuple BoundScreen::indicators(const py::object& given, const py::object& offsets, std::vector<std::string> names) {
  const Layouts layouts = layouts_of(given, offsets, std::move(names));
  const std::vector<LayoutIndicators> found = screen_.indicators(layouts.views());
  const auto count = static_cast<py::ssize_t>(found.size());
  py::array_t<double> of_layouts({count, py::ssize_t{9}});
  py::list base_support;
  py::list supported_sides;
  for (py::ssize_t i = 0; i < count; ++i) {
    const LayoutIndicators& layout = found[static_cast<std::size_t>(i)];
    double* row = of_layouts.mutable_data(i, 0);
    row = std::copy(layout.centre_of_gravity.begin(), layout.centre_of_gravity.end(), row);
    row = std::copy(layout.centre_offset.begin(), layout.centre_offset.end(), row);
    *row++ = layout.fill;
    *row++ = layout.badly_based;
    *row = layout.badly_braced;
    base_support.append(
        py::array_t<float>(static_cast<py::ssize_t>(layout.base_support.size()), layout.base_support.data()));
    supported_sides.append(py::array_t<std::uint8_t>(static_cast<py::ssize_t>(layout.supported_sides.size()),
                                                     layout.supported_sides.data()));
  }
  return py::make_tuple(of_layouts, base_support, supported_sides, problems_of(screen_.problems()));
}

bool BoundScreen::record(const py::object& given, const py::object& offsets, std::vector<std::string> names,
                         const std::string& path, const RecordOptions& options, bool on_main_thread) {
  const Layouts layouts = layouts_of(given, offsets, std::move(names));
  bool complete = false;
  run_interruptible(screen_, on_main_thread, [&] { complete = screen_.record(layouts.views(), path, options); });
  return complete;
}

py::object BoundScreen::submit(const py::object& layout, const std::string& name) {
  const Layouts layouts(py::make_tuple(layout), name.empty() ? std::vector<std::string>() : std::vector{name});
  const std::optional<std::uint64_t> ticket = screen_.submit(layouts.views().front());
  if (!ticket) return py::none();
  return py::make_tuple(*ticket, problems_of(screen_.problems()));
}

py::object BoundScreen::poll(bool ordered, bool on_main_thread) {
  const PollOrder order = ordered ? PollOrder::as_submitted : PollOrder::as_finished;
  while (screen_.in_flight() > 0) {
    bool finished = false;
    {
      const py::gil_scoped_release released;
      finished = screen_.poll(finished_, std::chrono::duration<double>(kSignalInterval).count(), order);
    }
    if (finished)
      return py::make_tuple(finished_.ticket, table_of(finished_.worlds, {finished_.worlds.size()}),
                            messages_of(finished_.worlds), boxes(finished_.worlds));
    if (on_main_thread && PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return py::none();
}

}  // namespace holdfast::python
