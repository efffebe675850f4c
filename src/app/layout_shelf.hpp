#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/screening/stage_costs.hpp"
#include "core/base/result.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast {

/// A layout as read, or why it cannot be used: then only its name, and its hash where the file could be read, are
/// there.
struct ReadLayout {
  Layout layout;
  std::string error;  ///< empty when the layout can be used
  std::vector<Error> warnings;
};

/// SHA-256 of each layout's file as it is now; empty where it cannot be read.
std::vector<std::string> hash_layouts(const std::vector<std::string>& paths);

/// The layouts of a run. A file is read once, by the first unit of work that takes it, so that all its worlds are of
/// the same boxes whatever becomes of the file; and forgotten with the last. One that is no longer what it was when the
/// run began cannot be used. Shared by all threads.
class LayoutShelf {
 public:
  /// @param hashes SHA-256 of each file when the run began, see `hash_layouts`
  LayoutShelf(const std::vector<std::string>& paths, const std::vector<std::string>& hashes, const Settings& settings,
              StageCosts& costs)
      : paths_(paths), hashes_(hashes), settings_(settings), costs_(costs) {}

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
  const std::vector<std::string>& hashes_;
  const Settings& settings_;
  StageCosts& costs_;
  std::mutex mutex_;
  std::map<std::size_t, std::shared_ptr<Place>> places_;
};

}  // namespace holdfast
