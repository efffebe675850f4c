#include "core/model/shard.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace holdfast::internal;

TEST_CASE("shard: a block has about 256 worlds, and at least one layout", "[shard]") {
  CHECK(Shard::block_of(1) == 256);
  CHECK(Shard::block_of(4) == 64);
  CHECK(Shard::block_of(3) == 85);
  CHECK(Shard::block_of(1000) == 1);
}

TEST_CASE("shard: blocks are dealt out in turn, and each layout to one shard", "[shard]") {
  for (const std::uint64_t layouts : {0U, 1U, 9U, 10U, 100U}) {
    for (const std::uint64_t parts : {1U, 2U, 7U, 200U}) {
      std::vector<std::uint64_t> owners(layouts, 0);
      for (std::uint64_t part = 1; part <= parts; ++part) {
        const Shard shard{.part = part, .parts = parts, .block = 10, .layouts = layouts};
        for (std::uint64_t layout = 0; layout < layouts; ++layout) {
          if (!shard.has(layout)) continue;
          CHECK(owners[layout] == 0);
          owners[layout] = part;
        }
      }
      for (std::uint64_t layout = 0; layout < layouts; ++layout) CHECK(owners[layout] == layout / 10 % parts + 1);
    }
  }
  CHECK(Shard{.block = 10, .layouts = 91}.block_count() == 10);
}
