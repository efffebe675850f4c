#include "parallel/opencl/kernel_patches.hpp"

#include <catch2/catch.hpp>
#include <set>

namespace kernel_patches_test {

using namespace holdfast::internal;

namespace {

const std::vector<KernelPatch> kTwo = {{"friction", "void solve(", "0.7f", "0.5f"}, {"step", "void setup(", "dt", "h"}};

}  // namespace

TEST_CASE("kernel_patches: a program gets its own patches and no other", "[parallel][kernel_patches]") {
  KernelPatcher patcher(kTwo);
  CHECK(patcher.patched("void solve(float dt) { mu = 0.7f; }") == "void solve(float dt) { mu = 0.5f; }");
  CHECK(patcher.unapplied() == std::vector<std::string>{"step"});
  CHECK(patcher.patched("void setup(float dt)") == "void setup(float h)");
  CHECK(patcher.unapplied().empty());
}

TEST_CASE("kernel_patches: a text that is not there once is left alone and named", "[parallel][kernel_patches]") {
  for (const char* source : {"void solve() { mu = 0.8f; }", "void solve() { mu = 0.7f + 0.7f; }"}) {
    KernelPatcher patcher(kTwo);
    CHECK(patcher.patched(source) == source);
    CHECK(patcher.unapplied() == std::vector<std::string>{"friction", "step"});
  }
}

TEST_CASE("kernel_patches: a misfit in one program is not made good by another", "[parallel][kernel_patches]") {
  KernelPatcher patcher(kTwo);
  patcher.patched("void solve() {}");
  patcher.patched("void solve() { 0.7f; }");
  CHECK(patcher.unapplied() == std::vector<std::string>{"friction", "step"});
}

TEST_CASE("kernel_patches: each has a name of its own", "[parallel][kernel_patches]") {
  std::set<std::string> names;
  for (const KernelPatch& patch : kernel_patches()) {
    CHECK(names.insert(patch.name).second);
    CHECK_FALSE(patch.find.empty());
    CHECK(patch.find != patch.replace);
  }
}

}  // namespace kernel_patches_test
