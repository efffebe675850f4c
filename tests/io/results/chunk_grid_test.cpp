#include "io/results/chunk_grid.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <map>
#include <numeric>

namespace chunk_grid_test {

using namespace holdfast::internal;

namespace {

constexpr std::uint64_t kBoxChunk = chunk_entries(Axis::boxes);
constexpr std::uint64_t kSeriesChunk = chunk_entries(Axis::rows);

/// All chunks of a grid, by column and index, and the entries after them.
struct Laid {
  std::map<std::pair<std::size_t, std::uint64_t>, std::vector<std::byte>> chunks;
  LongEntries tail = no_entries();
  bool operator==(const Laid&) const = default;
};

/// Adds entries [begin, end) of /boxes/id and /series/time, with values from 0, in pieces of the given size.
void lay(ChunkGrid& grid, std::uint64_t begin, std::uint64_t end, std::uint64_t step, Laid& laid) {
  for (std::uint64_t i = begin; i < end; i += step) {
    ColumnSet columns;
    std::vector<std::uint32_t> ids(std::min(step, end - i));
    std::iota(ids.begin(), ids.end(), static_cast<std::uint32_t>(i));
    columns["/boxes/id"].append(ids);
    columns["/series/time"].append(std::vector<double>(ids.begin(), ids.end()));
    columns["/worlds/layout"].append(i);
    const GridPiece piece = grid.add(columns);
    CHECK(columns["/boxes/id"].count() == 0);
    CHECK(columns["/worlds/layout"].count() == 1);
    for (const GridChunk& chunk : piece.chunks)
      CHECK(laid.chunks.emplace(std::pair(chunk.column, chunk.index), chunk.bytes).second);
    append_rest(piece, laid.tail);
  }
}

}  // namespace

TEST_CASE("chunk_grid: chunks and tail do not depend on the size of the pieces", "[io][results]") {
  constexpr std::uint64_t kCount = 5 * kSeriesChunk / 2;
  Laid whole;
  ChunkGrid at_once;
  lay(at_once, 0, kCount, kCount, whole);
  CHECK(whole.chunks.size() == 10 + 2);
  const std::uint64_t step =
      GENERATE(as<std::uint64_t>{}, 1000, kBoxChunk - 1, kBoxChunk, kSeriesChunk, kSeriesChunk + 1);
  Laid in_steps;
  ChunkGrid grid;
  lay(grid, 0, kCount, step, in_steps);
  CHECK((in_steps == whole));

  // The values are the indices: the second chunk of ids begins with the index of its first entry.
  for (const auto& [place, bytes] : whole.chunks) {
    const DatasetSpec& spec = schema()[long_datasets()[place.first]];
    REQUIRE(bytes.size() == chunk_entries(spec.axis) * size_of(spec.type));
    if (spec.path != "/boxes/id") continue;
    std::uint32_t first = 0;
    std::memcpy(&first, bytes.data(), sizeof first);
    CHECK(first == place.second * kBoxChunk);
  }
}

TEST_CASE("chunk_grid: continues an interrupted run", "[io][results]") {
  constexpr std::uint64_t kCount = 5 * kSeriesChunk / 2;
  Laid whole;
  ChunkGrid at_once;
  lay(at_once, 0, kCount, 700, whole);
  const std::uint64_t cut = GENERATE(as<std::uint64_t>{}, 0, 700, kBoxChunk, kSeriesChunk + 700, 2 * kSeriesChunk + 1);
  Laid resumed;
  ChunkGrid before;
  lay(before, 0, cut, 700, resumed);
  AxisCounts counts{};
  at(counts, Axis::boxes) = cut;
  at(counts, Axis::samples) = cut;
  ChunkGrid after(counts, resumed.tail);
  lay(after, cut, kCount, 700, resumed);
  CHECK((resumed == whole));
}

}  // namespace chunk_grid_test
