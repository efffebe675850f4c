#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "api/guarded.hpp"
#include "api/screen_state.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast {

namespace {

/// Layouts in flight per thread where the options do not say: enough that no thread waits for the next poll.
constexpr std::size_t kInFlightPerThread = 16;

}  // namespace

std::unique_ptr<internal::WorldStream> Screen::State::make_stream() const {
  return std::make_unique<internal::WorldStream>(*engine, settings, read_accelerations, world_analyses,
                                                 options.keep_series, workers->threads(), options.on_finished);
}

internal::WorldStream& Screen::State::stream() {
  if (world_stream->is_of_parent()) {
    auto own = make_stream();
    static_cast<void>(world_stream.release());  // its threads are those of another process, and cannot be waited for
    world_stream = std::move(own);
  }
  return *world_stream;
}

bool Screen::State::has_room() {
  const std::size_t most = options.most_in_flight > 0
                               ? options.most_in_flight
                               : kInFlightPerThread * static_cast<std::size_t>(workers->threads());
  return stream().in_flight() < most;
}

std::uint64_t Screen::State::submit(std::vector<internal::ReadLayout> layout) {
  need_accelerations();
  stream().submit(next_ticket, std::move(layout.front()));
  return next_ticket++;
}

std::optional<std::uint64_t> Screen::submit(const Layout& layout) {
  return internal::guarded([&]() -> std::optional<std::uint64_t> {
    if (!state_->has_room()) return std::nullopt;
    return state_->submit(state_->read(std::span(&layout, 1), state_->next_ticket));
  });
}

std::optional<std::uint64_t> Screen::submit(const LayoutView& layout) {
  return internal::guarded([&]() -> std::optional<std::uint64_t> {
    if (!state_->has_room()) return std::nullopt;
    return state_->submit(state_->read(std::span(&layout, 1), state_->next_ticket));
  });
}

bool Screen::poll(FinishedLayout& finished, double seconds, PollOrder order) {
  return internal::guarded([&] {
    using Order = internal::WorldStream::Order;
    const std::chrono::duration<double> wait(std::isnan(seconds) ? 0.0 : std::max(0.0, seconds));
    auto taken =
        state_->stream().take(wait, order == PollOrder::as_submitted ? Order::as_submitted : Order::as_finished);
    if (!taken) return false;
    finished.ticket = taken->ticket;
    finished.worlds.resize(taken->worlds.size());
    for (std::size_t i = 0; i < finished.worlds.size(); ++i) {
      internal::WorldRecord& record = taken->worlds[i];
      record.row.layout = taken->ticket;
      state_->taker->take(std::move(record), finished.worlds[i]);
      internal::mark_cancelled(finished.worlds[i]);
    }
    if (taken->error) throw internal::exception_of({*taken->error});
    return true;
  });
}

std::size_t Screen::in_flight() const noexcept {
  return state_->world_stream->is_of_parent() ? 0 : state_->world_stream->in_flight();
}

}  // namespace holdfast
