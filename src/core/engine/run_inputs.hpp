#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/layout.hpp"

namespace holdfast::internal {

/// A layout of a run, or why it cannot be used: then only its name, and its hash where it is known, are there.
struct ReadLayout {
  Layout layout;
  std::string error;  ///< empty when the layout can be used
  std::vector<Error> warnings;
};

/// An acceleration of a run; one that cannot be used has a message, and no segments.
struct ReadAcceleration {
  Acceleration acceleration;
  std::string error;  ///< empty when the acceleration can be used
};

/// Where the layouts of a run come from: files, or memory. Shared by all threads.
class LayoutSource {
 public:
  LayoutSource() = default;
  LayoutSource(const LayoutSource&) = delete;
  LayoutSource& operator=(const LayoutSource&) = delete;
  virtual ~LayoutSource() = default;

  virtual std::size_t count() const = 0;

  /// What messages call a layout: a path, or a name. Valid as long as the source.
  virtual const std::string& label(std::size_t layout) const = 0;

  /// The layout, the same object for all who take it.
  /// @param takers number of times that the run takes this layout, the same at each call; after the last one the source
  ///               may forget it
  virtual std::shared_ptr<const ReadLayout> take(std::size_t layout, std::size_t takers) = 0;
};

}  // namespace holdfast::internal
