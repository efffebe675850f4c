#include "io/chunk_codec.hpp"

#include <hdf5.h>

#include <cstring>

#include "io/hdf5_file.hpp"
#include "io/results_fixture.hpp"

using namespace results_fixture;

namespace {

/// Writes one chunk of random numbers to the dataset and returns what HDF5's own filters read back.
std::vector<std::byte> through_filters(const DatasetSpec& spec, const std::vector<std::byte>& raw, std::size_t text) {
  const Folder folder;
  const std::string path = folder / "chunk.h5";
  {
    h5::File file = h5::File::create(path);
    {
      const std::size_t entry = (spec.type == ElementType::text ? text : size_of(spec.type)) * spec.width;
      h5::Dataset dataset = h5::Dataset::create(file, spec, raw.size() / entry, text);
      dataset.write_chunk(0, compress_chunk(raw, dataset.number_bytes()));
    }
    file.close();
  }
  const h5::File file = h5::File::open(path);
  const h5::Dataset dataset = h5::Dataset::open(file, spec);
  return dataset.read(0, dataset.length());
}

}  // namespace

TEST_CASE("chunk_codec: HDF5's own filters read it, whatever the type", "[io][results]") {
  std::mt19937 random(3);
  for (const DatasetSpec& spec : kSchema) {
    constexpr std::size_t kText = 13;
    const std::size_t number = spec.type == ElementType::text ? kText : size_of(spec.type);
    const std::size_t entries = is_long(spec) ? chunk_entries(spec.axis) : 1000;
    std::vector<std::byte> raw(entries * number * spec.width);
    for (std::byte& byte : raw) byte = static_cast<std::byte>('a' + random() % 26);
    CAPTURE(spec.path);
    CHECK((through_filters(spec, raw, kText) == raw));
  }
}

TEST_CASE("chunk_codec: rest costs next to nothing", "[io][results]") {
  CHECK(compress_chunk(std::vector<std::byte>(196'608), 4).size() < 2000);
}
