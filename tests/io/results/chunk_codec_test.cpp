#include "io/results/chunk_codec.hpp"

#include <hdf5.h>

#include <cstring>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_fixture.hpp"

namespace chunk_codec_test {

using namespace results_fixture;

namespace {

/// Writes one compressed chunk of `size` bytes to the dataset and returns what HDF5's own filters read back.
std::vector<std::byte> through_filters(const DatasetSpec& spec, const std::vector<std::byte>& packed, std::size_t size,
                                       std::size_t text) {
  const Folder folder;
  const std::string path = folder / "chunk.h5";
  {
    h5::File file = h5::File::create(path);
    {
      const std::size_t entry = (spec.type == ElementType::text ? text : size_of(spec.type)) * spec.width;
      h5::Dataset dataset = h5::Dataset::create(file, spec, size / entry, text);
      dataset.write_chunk(0, packed);
    }
    file.close();
  }
  const h5::File file = h5::File::open(path);
  const h5::Dataset dataset = h5::Dataset::open(file, spec);
  return dataset.read(0, dataset.length());
}

}  // namespace

TEST_CASE("chunk_codec: HDF5's own filters read chunks of every type", "[io][results]") {
  std::mt19937 random(3);
  for (const DatasetSpec& spec : schema()) {
    constexpr std::size_t kText = 13;
    const std::size_t number = spec.type == ElementType::text ? kText : size_of(spec.type);
    const std::size_t entries = is_long(spec) ? chunk_entries(spec.axis) : 1200;
    std::vector<std::byte> raw(entries * number * spec.width);
    for (std::byte& byte : raw) byte = static_cast<std::byte>('a' + random() % 26);
    CAPTURE(spec.path);
    CHECK((through_filters(spec, compress_chunk(raw, number), raw.size(), kText) == raw));
  }
}

TEST_CASE("chunk_codec: a padded chunk is read back with its zeros, for any length", "[io][results]") {
  std::mt19937 random(5);
  for (const DatasetSpec& spec : schema()) {
    if (!is_long(spec)) continue;
    const std::size_t number = size_of(spec.type);
    for (const std::uint64_t entries : {1U, 2U, 19U, 111U, 128U, 129U, 3000U}) {
      std::vector<std::byte> raw(entries * number * spec.width);
      // Single bytes and runs of all lengths, of all values.
      for (std::size_t i = 0; i < raw.size();) {
        const auto value = static_cast<std::byte>(random());
        for (std::size_t left = 1 + random() % (random() % 2 != 0 ? 3 : 700); left > 0 && i < raw.size(); --left)
          raw[i++] = value;
      }
      const std::size_t chunk_bytes = chunk_entries(spec.axis) * number * spec.width;
      const std::vector<std::byte> packed = compress_padded_chunk(raw, number, chunk_bytes);
      raw.resize(chunk_bytes);
      CAPTURE(spec.path, entries);
      CHECK((through_filters(spec, packed, raw.size(), 1) == raw));
    }
  }
}

TEST_CASE("chunk_codec: a constant column compresses to almost nothing", "[io][results]") {
  CHECK(compress_chunk(std::vector<std::byte>(196'608), 4).size() < 2000);
}

}  // namespace chunk_codec_test
