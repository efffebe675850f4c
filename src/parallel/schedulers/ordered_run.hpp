#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include <atomic>
#include <cstddef>
#include <optional>
#include <utility>

#include "parallel/schedulers/tsan_annotations.hpp"
#include "parallel/schedulers/workers.hpp"

namespace holdfast::internal {

/// Units in flight per thread, at most: enough that a long unit does not keep the others idle while its successors
/// wait to be written, few enough that memory stays flat.
inline constexpr std::size_t kUnitsInFlight = 8;

/// Runs units 0 … `count` − 1 through four stages; what comes out of one goes into the next.
///
///     work(i) -> placed in order -> packed -> written in order
///      any thread    one at a time    any thread   one at a time
///
/// `work` may run for many units at once and in any order; `place` and `write` see the units in their order, one
/// at a time, on whatever thread. The serial scheduler does all on the calling thread.
/// @param work  (std::size_t unit) -> std::optional<A>; nothing means "left undone", and so is all that follows
/// @param place (A&&) -> B
/// @param pack  (B&&) -> C
/// @param write (C&&) -> bool; false ends the run
template <class Work, class Place, class Pack, class Write>
void run_in_order(Workers& workers, std::size_t count, Work work, Place place, Pack pack, Write write) {
  using A = decltype(work(std::size_t{}));
  using B = std::optional<decltype(place(std::declval<typename A::value_type>()))>;
  using C = std::optional<decltype(pack(std::declval<typename B::value_type>()))>;

  // Seen and set by the serial stages only: after the first gap nothing more may be placed or written.
  bool placing = true;
  bool writing = true;
  const auto place_in_order = [&](A&& item) -> B {
    placing = placing && item.has_value();
    if (!placing) return std::nullopt;
    return place(std::move(*item));
  };
  const auto pack_one = [&](B&& item) -> C {
    if (!item) return std::nullopt;
    return pack(std::move(*item));
  };
  const auto write_in_order = [&](C&& item) { writing = writing && item && write(std::move(*item)); };

  const int threads = workers.threads();
  // One unit: other threads would cost more than they bring.
  const bool alone = count <= 1 || threads <= 1 || workers.scheduler() == Scheduler::serial || !may_use_threads();
  const Scheduler scheduler = alone ? Scheduler::serial : workers.scheduler();
  if (scheduler == Scheduler::tbb) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    std::atomic<bool> more = true;
    std::size_t next = 0;
    RunOrder order;
    leave_at(&order.begin);
    workers.arena().execute([&] {
      tbb::parallel_pipeline(
          kUnitsInFlight * static_cast<std::size_t>(threads),
          tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                              [&](tbb::flow_control& control) -> std::size_t {
                                                const StageOrder stage(order, &next);
                                                if (next < count && more) return next++;
                                                control.stop();
                                                return 0;
                                              }) &
              tbb::make_filter<std::size_t, Handed<A>>(tbb::filter_mode::parallel,
                                                       [&](std::size_t unit) -> Handed<A> {
                                                         const StageOrder stage(order);
                                                         return work(unit);
                                                       }) &
              tbb::make_filter<Handed<A>, Handed<B>>(tbb::filter_mode::serial_in_order,
                                                     [&](Handed<A> item) -> Handed<B> {
                                                       const StageOrder stage(order, &placing);
                                                       return place_in_order(item.take());
                                                     }) &
              tbb::make_filter<Handed<B>, Handed<C>>(tbb::filter_mode::parallel,
                                                     [&](Handed<B> item) -> Handed<C> {
                                                       const StageOrder stage(order);
                                                       return pack_one(item.take());
                                                     }) &
              tbb::make_filter<Handed<C>, void>(tbb::filter_mode::serial_in_order, [&](Handed<C> item) {
                const StageOrder stage(order, &writing);
                write_in_order(item.take());
                if (!writing) more = false;
              }));
    });
    see_from(&order.end);
    return;
  }

#ifdef _OPENMP
  if (scheduler == Scheduler::openmp) {
    bool more = true;
#pragma omp parallel for ordered schedule(dynamic, 1) num_threads(threads)
    for (std::size_t unit = 0; unit < count; ++unit) {
      bool go_on = false;
#pragma omp atomic read
      go_on = more;
      A item = go_on ? work(unit) : A();
#pragma omp ordered
      {
        // NOLINTNEXTLINE(bugprone-use-after-move): clang-tidy takes the ordered region for a loop of its own
        write_in_order(pack_one(place_in_order(std::move(item))));
        if (!writing) {
#pragma omp atomic write
          more = false;
        }
      }
    }
    return;
  }
#endif

  for (std::size_t unit = 0; unit < count && writing; ++unit) write_in_order(pack_one(place_in_order(work(unit))));
}

}  // namespace holdfast::internal
