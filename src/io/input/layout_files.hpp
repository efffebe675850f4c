#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/engine/run_inputs.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// SHA-256 of each layout's file as it is now; empty where it cannot be read.
std::vector<std::string> hash_layouts(const std::vector<std::string>& paths);

/// The layouts of a run, each in a file. A file is read once, by the first unit of work that takes it, so that all its
/// worlds have the same boxes whatever becomes of the file; and forgotten with the last. A file that has changed since
/// the run began cannot be used. Shared by all threads.
class LayoutFiles final : public LayoutSource {
 public:
  /// All must outlive this.
  /// @param hashes SHA-256 of each file when the run began, see `hash_layouts`
  LayoutFiles(const std::vector<std::string>& paths, const std::vector<std::string>& hashes, const Settings& settings)
      : paths_(paths), hashes_(hashes), settings_(settings) {}

  std::size_t count() const override { return paths_.size(); }
  const std::string& label(std::size_t layout) const override { return paths_[layout]; }
  std::shared_ptr<const ReadLayout> take(std::size_t layout, std::size_t takers) override;

 private:
  struct Entry {
    std::once_flag read;
    ReadLayout layout;
    std::size_t takers = 0;  ///< that are still to come
  };

  const std::vector<std::string>& paths_;
  const std::vector<std::string>& hashes_;
  const Settings& settings_;
  std::mutex mutex_;
  std::map<std::size_t, std::shared_ptr<Entry>> entries_;
};

}  // namespace holdfast::internal
