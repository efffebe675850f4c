#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace holdfast::internal {

/// A change to the text of one of Bullet's OpenCL programs, applied in memory before compilation.
struct KernelPatch {
  std::string name;     ///< for messages
  std::string program;  ///< a text that only the program to be changed contains
  std::string find;     ///< text to replace; must occur exactly once
  std::string replace;
};

/// All changes that this project makes to Bullet's pipeline, each with its reason.
const std::vector<KernelPatch>& kernel_patches();

/// Applies patches to the sources of programs, and records which of them were applied.
class KernelPatcher {
 public:
  explicit KernelPatcher(const std::vector<KernelPatch>& patches)
      : patches_(patches), applied_(patches.size(), false) {}

  /// The source with the patches of its program. A patch whose text does not occur exactly once is not applied.
  std::string patched(std::string_view source);

  /// Names of the patches that were not applied, also because their program was not built; empty if all were applied.
  std::vector<std::string> unapplied() const;

 private:
  const std::vector<KernelPatch>& patches_;
  std::vector<bool> applied_;
  std::vector<std::string> misfits_;
};

}  // namespace holdfast::internal
