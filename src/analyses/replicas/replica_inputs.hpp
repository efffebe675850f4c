#pragma once

#include <cstdint>
#include <vector>

#include "analyses/replicas/replica_draw.hpp"
#include "core/model/layout.hpp"
#include "core/model/play.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What the replicas of a layout vary, and how: for all of its worlds, and for its margins.
class ReplicaInputs {
 public:
  /// @param layout kept by reference
  ReplicaInputs(const Layout& layout, const Settings& settings);

  /// Draws of all replicas; that of replica `number` is at `number - 1`.
  const std::vector<ReplicaDraw>& draws() const { return draws_; }

  /// Whether boxes stand elsewhere in each replica.
  bool shifts_boxes() const { return !play_.empty(); }

  /// The layout of a replica, from 1.
  Layout layout(std::uint32_t number) const;

 private:
  const Layout& layout_;
  std::uint64_t boxes_;        ///< hash of the layout's boxes
  std::vector<BoxPlay> play_;  ///< empty where boxes are not shifted
  std::vector<ReplicaDraw> draws_;
};

}  // namespace holdfast::internal
