#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/native/island/island_stepper.hpp"
#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// The large buffers of a world. Nothing in them says anything to the world that gets them.
struct WorldMemory {
  explicit WorldMemory(const NativeOptions& options, std::unique_ptr<ContactSolver> solver = make_contact_solver())
      : stepper(options, std::move(solver)) {}

  IslandStepper stepper;
  std::vector<Manifold> manifolds;                         ///< none; room for those of a world before
  std::vector<Manifold> marked;                            ///< likewise, of a mark
  std::vector<std::pair<std::uint32_t, Manifold>> undone;  ///< likewise, for `Scene::undo`
};

/// Keeps the memory of worlds that have ended for those that come: the first access to a new page of memory is a call
/// of the system, and a short world has many (docs/develop/notebook/2026-11-25_kept_memory.md). May be used by several
/// threads, none of which ever waits, nor would it in the child of a fork.
class WorldMemoryPool {
 public:
  explicit WorldMemoryPool(const NativeOptions& options) : options_(options) {}
  WorldMemoryPool(const WorldMemoryPool&) = delete;
  WorldMemoryPool& operator=(const WorldMemoryPool&) = delete;
  ~WorldMemoryPool();

  /// Memory that has been given back, or new memory.
  std::unique_ptr<WorldMemory> take();
  /// What finds no room is freed.
  void give_back(std::unique_ptr<WorldMemory> memory) noexcept;

 private:
  /// More than worlds are simulated at a time on most machines.
  static constexpr std::size_t kSlots = 64;

  NativeOptions options_;
  std::array<std::atomic<WorldMemory*>, kSlots> slots_ = {};
};

}  // namespace holdfast::internal::native
