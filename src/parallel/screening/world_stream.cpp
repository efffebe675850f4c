#include "parallel/screening/world_stream.hpp"

#include <unistd.h>

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "parallel/screening/stage_costs.hpp"
#include "parallel/screening/unit_runner.hpp"
#include "parallel/screening/work_in_hand.hpp"
#include "parallel/screening/work_units.hpp"

namespace holdfast::internal {

namespace {

constexpr std::chrono::duration<double> kLongestWait = std::chrono::hours(24 * 365);

}  // namespace

/// A layout in flight. Its units run on several threads, each of which writes worlds of its own.
class WorldStream::Job {
  /// The layout of a job, as a run of one.
  class OneLayout final : public LayoutSource {
   public:
    explicit OneLayout(ReadLayout layout) : layout_(std::move(layout)) {}

    std::size_t count() const override { return 1; }
    const std::string& label(std::size_t /*layout*/) const override { return layout_.layout.name; }
    std::shared_ptr<const ReadLayout> take(std::size_t /*layout*/, std::size_t /*takers*/) override {
      return {std::shared_ptr<void>(), &layout_};  // owned by this, which outlives its units
    }

   private:
    ReadLayout layout_;
  };

 public:
  Job(std::uint64_t ticket, ReadLayout layout, const WorldStream& stream)
      : units(1, stream.accelerations_.size(), stream.engine_.traits(), stream.settings_.screening.first_failure),
        units_left(units.count()),
        accelerations_(stream.accelerations_),
        layout_(std::move(layout)),
        runner_(stream.engine_, stream.settings_, stream.record_series_, layout_, accelerations_, abort, costs_,
                stream.analyses_) {
    result.ticket = ticket;
    result.worlds.resize(accelerations_.size());
    for (std::size_t i = 0; i < accelerations_.size(); ++i) result.worlds[i].row.acceleration = i;
    if (!stream.settings_.screening.first_failure) return;
    order_.resize(accelerations_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
  }

  /// Simulates a unit. An error says what kept it from being simulated.
  std::optional<Error> run(const WorkUnit& unit) {
    const std::string& label = layout_.label(0);
    const std::string& name = accelerations_[unit.acceleration_begin].acceleration.name;
    const WorkInHand in_hand(label, name);
    try {
      std::optional<UnitRecord> record = runner_.run(unit, 1, order_);
      for (std::size_t i = 0; record && i < record->worlds.size(); ++i)
        result.worlds[unit.acceleration_begin + i] = std::move(record->worlds[i]);
      return std::nullopt;
    } catch (const std::bad_alloc&) {
      return out_of_memory(label, "memory ran out when its world under " + name + " was simulated");
    } catch (const std::exception& error) {
      return Error{.file = label, .what = "the system refused", .value = error.what()};
    }
  }

  /// Called once, when no unit is left.
  void conclude() {
    result.cancelled = std::any_of(result.worlds.begin(), result.worlds.end(), [](const WorldRecord& world) {
      return world.row.stop_reason == StopReason::not_run && world.row.status == Status::ok;
    });
  }

  std::atomic<bool> abort = false;
  const WorkUnits units;

  // Guarded by the stream's mutex.
  std::size_t units_begun = 0;
  std::size_t units_left;          ///< not done
  std::list<Job*> place{1, this};  ///< among the finished jobs; made now, for what ends a job must not fail
  Finished result;                 ///< written by the units, each its own worlds, while any is left

 private:
  std::span<const ReadAcceleration> accelerations_;
  std::vector<std::size_t> order_;  ///< with FirstFailure: of the accelerations
  OneLayout layout_;
  StageCosts costs_;
  UnitRunner runner_;
};

WorldStream::WorldStream(const Engine& engine, const Settings& settings,
                         const std::vector<ReadAcceleration>& accelerations, const AnalysisMethods& analyses,
                         bool record_series, int threads, std::function<void()> on_finished)
    : engine_(engine),
      settings_(settings),
      accelerations_(accelerations),
      analyses_(analyses),
      record_series_(record_series),
      thread_count_(threads),
      on_finished_(std::move(on_finished)) {}

WorldStream::~WorldStream() {
  cancel();
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  work_is_there_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorldStream::submit(std::uint64_t ticket, ReadLayout layout) {
  const auto job = std::make_shared<Job>(ticket, std::move(layout), *this);
  start();
  {
    const std::scoped_lock lock(mutex_);
    const auto place = jobs_.emplace(ticket, job).first;
    try {
      waiting_.push_back(job);
    } catch (...) {
      jobs_.erase(place);
      throw;
    }
  }
  work_is_there_.notify_all();
}

void WorldStream::start() {
  if (process_ == 0) process_ = getpid();
  try {
    while (threads_.size() < static_cast<std::size_t>(thread_count_)) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;  // fewer do as well
  }
}

void WorldStream::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_is_there_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::shared_ptr<Job> job = waiting_.front();
    const WorkUnit unit = job->units[job->units_begun];
    if (++job->units_begun == job->units.count()) waiting_.pop_front();
    lock.unlock();
    std::optional<Error> error = job->run(unit);
    lock.lock();
    if (error && !job->result.error) job->result.error = std::move(error);
    if (--job->units_left > 0) continue;
    job->conclude();
    finished_.splice(finished_.end(), job->place);
    layout_is_finished_.notify_one();
    if (on_finished_) on_finished_();
  }
}

WorldStream::Job* WorldStream::next(Order order) const {
  if (order == Order::as_finished) return finished_.empty() ? nullptr : finished_.front();
  if (jobs_.empty() || jobs_.begin()->second->units_left > 0) return nullptr;
  return jobs_.begin()->second.get();
}

std::optional<WorldStream::Finished> WorldStream::take(std::chrono::duration<double> wait, Order order) {
  std::unique_lock lock(mutex_);
  if (jobs_.empty()) return std::nullopt;
  // A clock does not count further than some hundred years.
  const std::chrono::duration<double> bounded = wait > kLongestWait ? kLongestWait : wait;
  if (bounded.count() > 0.0) layout_is_finished_.wait_for(lock, bounded, [&] { return next(order) != nullptr; });
  Job* const job = next(order);
  if (job == nullptr) return std::nullopt;
  finished_.remove(job);
  Finished result = std::move(job->result);
  jobs_.erase(result.ticket);
  return result;
}

std::size_t WorldStream::in_flight() const {
  const std::scoped_lock lock(mutex_);
  return jobs_.size();
}

void WorldStream::cancel() noexcept {
  const std::scoped_lock lock(mutex_);
  for (const auto& [ticket, job] : jobs_) job->abort = true;
}

bool WorldStream::is_of_parent() const { return process_ != 0 && process_ != getpid(); }

}  // namespace holdfast::internal
