#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/native/island_stepper.hpp"
#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// The large buffers of a world. Nothing in them says anything to the world that gets them.
struct WorldMemory {
  explicit WorldMemory(const NativeOptions& options, std::unique_ptr<ContactSolver> solver = make_contact_solver())
      : stepper(options, std::move(solver)) {}

  IslandStepper stepper;
  std::vector<Manifold> manifolds;                         ///< none; room for those of a world before
  std::vector<std::pair<std::uint32_t, Manifold>> undone;  ///< likewise, for `Scene::undo`
};

/// Keeps the memory of worlds that have ended for those that come: the first access to a new page of memory is a call
/// of the system, and a short world has many (docs/performance.md). May be used by several threads, none of which ever
/// waits: in the child of a fork the lock may be held by a thread that is not there. Memory is new, or freed, instead.
class WorldMemoryPool {
 public:
  explicit WorldMemoryPool(const NativeOptions& options) : options_(options) {}

  std::unique_ptr<WorldMemory> take();
  void give_back(std::unique_ptr<WorldMemory> memory) noexcept;

 private:
  NativeOptions options_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<WorldMemory>> idle_;
};

}  // namespace holdfast::internal::native
