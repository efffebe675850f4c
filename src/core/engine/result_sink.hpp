#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/layout.hpp"

namespace holdfast::internal {

/// A layout as the results keep it. A bad layout has no boxes.
struct LayoutRecord {
  std::uint64_t index = 0;  ///< in the run
  std::shared_ptr<const Layout> layout;
  Findings found;  ///< by the analyses that were asked for
};

/// The finished worlds of one unit of work.
struct UnitRecord {
  std::vector<LayoutRecord> layouts;  ///< those whose first world is in this unit, by rising index
  std::vector<WorldRecord> worlds;    ///< in the order of the run
  std::vector<Error> warnings;        ///< of the layouts, for the user; not kept
};

/// A unit on its way into a sink. Used by one thread at a time; must not outlive its sink.
class SinkUnit {
 public:
  SinkUnit() = default;
  SinkUnit(const SinkUnit&) = delete;
  SinkUnit& operator=(const SinkUnit&) = delete;
  virtual ~SinkUnit() = default;

  /// Work that needs no order, such as compression. Called once, by any thread.
  virtual void pack() {}

  /// Hands the unit over. Called once, after `pack`, in the order of the worlds, by one thread at a time. An error ends
  /// the run.
  virtual std::optional<Error> write() = 0;
};

/// Where the results of a run go: a file, or memory.
class ResultSink {
 public:
  ResultSink() = default;
  ResultSink(const ResultSink&) = delete;
  ResultSink& operator=(const ResultSink&) = delete;
  virtual ~ResultSink() = default;

  /// Gives a unit its place. Called in the order of the worlds, by one thread at a time.
  /// @param unit the sink may move the worlds' series out of it; the caller keeps the rest
  virtual std::unique_ptr<SinkUnit> place(UnitRecord& unit) = 0;

  /// Called once, after the last unit: afterwards all units written are safe.
  virtual std::optional<Error> finish() { return std::nullopt; }
};

}  // namespace holdfast::internal
