#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The layouts of a run: those of files, each with one or several loads. A text of StableCargo's is read by the first
/// unit of work that takes it, so that all its worlds have the same boxes whatever becomes of the file, and forgotten
/// with the last; one that has changed since the run began cannot be used. Tables and JSON are read whole when the run
/// begins. Shared by all threads.
class LayoutFiles final : public LayoutSource {
 public:
  /// Looks into all files.
  /// @param settings must outlive this
  LayoutFiles(const std::vector<std::string>& paths, const Settings& settings);

  std::size_t count() const override { return places_.size(); }
  const std::string& label(std::size_t layout) const override { return places_[layout]->label; }
  std::shared_ptr<const ReadLayout> take(std::size_t layout, std::size_t takers) override;

  std::vector<std::string> names() const;   ///< as results have them
  std::vector<std::string> hashes() const;  ///< SHA-256; empty where a file cannot be read

  /// What is said of files as a whole.
  const std::vector<Error>& notes() const { return notes_; }

  /// Some of the layouts, by their indices.
  std::shared_ptr<LayoutFiles> chosen(std::span<const std::size_t> layouts) const;

 private:
  struct Place {
    std::string path, name, hash, label;
    bool is_read = false;  ///< when the run began
    std::mutex mutex;
    std::shared_ptr<const ReadLayout> layout;  ///< while it has been read, and not all have taken it
    std::size_t takers = 0;                    ///< that are still to come, once one has
  };

  explicit LayoutFiles(const Settings& settings) : settings_(settings) {}
  void add(const std::string& path, const Settings& settings);

  const Settings& settings_;
  std::vector<std::shared_ptr<Place>> places_;
  std::vector<Error> notes_;
};

}  // namespace holdfast::internal
