#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/stage_costs.hpp"
#include "core/layout.hpp"
#include "core/result.hpp"
#include "core/settings.hpp"

namespace holdfast {

/// A layout as read, or why it cannot be used: then only its name, and its hash where the file could be read, are
/// there.
struct ReadLayout {
  Layout layout;
  std::string error;  ///< empty when the layout can be used
  std::vector<Error> warnings;
};

/// The layouts of a run. A file is read once, by the first unit of work that takes it, so that all its worlds are of
/// the same boxes whatever becomes of the file; and forgotten with the last. Shared by all threads.
class LayoutShelf {
 public:
  LayoutShelf(const std::vector<std::string>& paths, const Settings& settings, StageCosts& costs)
      : paths_(paths), settings_(settings), costs_(costs) {}

  /// @param layout index into the paths
  /// @param takers times that the run takes this layout, the same at each
  std::shared_ptr<const ReadLayout> take(std::size_t layout, std::size_t takers);

 private:
  struct Place {
    std::once_flag read;
    ReadLayout layout;
    std::size_t takers = 0;  ///< that are still to come
  };

  const std::vector<std::string>& paths_;
  const Settings& settings_;
  StageCosts& costs_;
  std::mutex mutex_;
  std::map<std::size_t, std::shared_ptr<Place>> places_;
};

}  // namespace holdfast
