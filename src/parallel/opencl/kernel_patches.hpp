#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace holdfast::internal {

/// A change of the text of one of Bullet's OpenCL programs, made in memory before it is compiled.
struct KernelPatch {
  std::string name;     ///< for messages
  std::string program;  ///< a text that only the program to be changed contains
  std::string find;     ///< what is replaced; must occur exactly once
  std::string replace;
};

/// Every change that this project makes to Bullet's pipeline, each with its reason beside it.
const std::vector<KernelPatch>& kernel_patches();

/// Applies the patches of a program to its source, and remembers which fitted.
class KernelPatcher {
 public:
  explicit KernelPatcher(const std::vector<KernelPatch>& patches)
      : patches_(patches), applied_(patches.size(), false) {}

  /// The source with the patches of its program. A patch whose text is not there exactly once leaves the source alone.
  std::string patched(std::string_view source);

  /// Names of the patches that did not fit, or whose program never came: none when all is well.
  std::vector<std::string> unapplied() const;

 private:
  const std::vector<KernelPatch>& patches_;
  std::vector<bool> applied_;
  std::vector<std::string> misfits_;
};

}  // namespace holdfast::internal
