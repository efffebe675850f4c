#include "core/model/shard.hpp"

#include <catch2/catch.hpp>

namespace shard_test {

using namespace holdfast::internal;

TEST_CASE("shard: a block has about 256 worlds, and at least one layout", "[shard]") {
  CHECK(Shard::block_of(1) == 256);
  CHECK(Shard::block_of(4) == 64);
  CHECK(Shard::block_of(3) == 85);
  CHECK(Shard::block_of(1000) == 1);
}

TEST_CASE("shard: the last block may have fewer layouts", "[shard]") {
  CHECK(Shard{.block = 10, .layouts = 0}.block_count() == 0);
  CHECK(Shard{.block = 10, .layouts = 90}.block_count() == 9);
  CHECK(Shard{.block = 10, .layouts = 91}.block_count() == 10);
}

}  // namespace shard_test
