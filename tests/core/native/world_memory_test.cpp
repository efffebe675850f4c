#include "core/native/world_memory.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"
#include "same_bits.hpp"

namespace world_memory_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using holdfast::internal::physics::bundled_layout;
using native_scenes::native_run;

TEST_CASE("world_memory: the pool hands out what has been given back, and new memory otherwise",
          "[core][world_memory]") {
  WorldMemoryPool pool(native_options(Settings{}));
  std::unique_ptr<WorldMemory> first = pool.take();
  std::unique_ptr<WorldMemory> second = pool.take();
  REQUIRE(first.get() != nullptr);
  CHECK(first.get() != second.get());
  const WorldMemory* const used = first.get();
  pool.give_back(std::move(first));
  CHECK(pool.take().get() == used);
}

TEST_CASE("world_memory: any number may be given back", "[core][world_memory]") {
  WorldMemoryPool pool(native_options(Settings{}));
  std::vector<std::unique_ptr<WorldMemory>> taken;
  std::set<const WorldMemory*> different;
  for (int i = 0; i < 200; ++i) different.insert(taken.emplace_back(pool.take()).get());
  CHECK(different.size() == 200);
  for (std::unique_ptr<WorldMemory>& memory : taken) pool.give_back(std::move(memory));
  CHECK(different.count(pool.take().get()) == 1);
}

TEST_CASE("world_memory: a world moves the same in memory that others have used", "[core][world_memory]") {
  Settings settings;
  settings.native.accuracy = Accuracy::screening;
  const Acceleration brake = constant(0.8 * kGravity, 0.5);
  const Layout large = bundled_layout("BR8_009_ep", settings);
  const Layout small = bundled_layout("BR0_012_block", settings);
  const StateColumns alone = native_run(small, brake, settings).state;

  const NativeEngine engine(settings);
  scenes::run(engine, large, brake, settings);
  CHECK(same_bits(scenes::run(engine, small, brake, settings).state, alone));
}

}  // namespace world_memory_test
