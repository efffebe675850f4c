#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analyses/analysis.hpp"
#include "core/engine/result_sink.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/model/verdict.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// Layouts of a call, in memory.
class MemoryLayouts final : public LayoutSource {
 public:
  explicit MemoryLayouts(std::vector<ReadLayout> layouts) : layouts_(std::move(layouts)) {}

  std::size_t count() const override { return layouts_.size(); }
  const std::string& label(std::size_t layout) const override { return layouts_[layout].layout.name; }
  std::shared_ptr<const ReadLayout> take(std::size_t layout, std::size_t /*takers*/) override {
    return {std::shared_ptr<void>(), &layouts_[layout]};  // owned by this, which outlives the run
  }

 private:
  std::vector<ReadLayout> layouts_;
};

/// A unit whose results are in place already.
class DoneUnit final : public SinkUnit {
 public:
  std::optional<Error> write() override { return std::nullopt; }
};

/// Writes what became of a world into memory of the caller, which is used again.
class WorldTaker {
 public:
  WorldTaker(const Thresholds& thresholds, bool keep_boxes) : thresholds_(thresholds), keep_boxes_(keep_boxes) {}
  /// Moves the series out of the record.
  void take(WorldRecord&& record, holdfast::WorldOutcome& world) const;

 private:
  Thresholds thresholds_;
  bool keep_boxes_;
};

/// Writes the results of worlds into memory of the caller.
class MemorySink final : public ResultSink {
 public:
  /// @param worlds one per world of the run, in its order
  MemorySink(std::span<holdfast::WorldOutcome> worlds, std::size_t acceleration_count, const WorldTaker& taker)
      : worlds_(worlds), acceleration_count_(acceleration_count), taker_(taker) {}

  std::unique_ptr<SinkUnit> place(UnitRecord& unit) override;

 private:
  std::span<holdfast::WorldOutcome> worlds_;
  std::size_t acceleration_count_;
  const WorldTaker& taker_;
};

}  // namespace holdfast::internal
