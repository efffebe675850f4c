#include "io/chunk_codec.hpp"

#include <libdeflate.h>

#include <memory>
#include <new>

#include "io/run_deflate.hpp"

namespace holdfast {

namespace {

/// As HDF5's shuffle filter: first the lowest byte of every number, then the next, ….
std::vector<std::byte> shuffle(std::span<const std::byte> raw, std::size_t number_bytes) {
  const std::size_t count = raw.size() / number_bytes;
  std::vector<std::byte> shuffled(raw.size());
  for (std::size_t byte = 0; byte < number_bytes; ++byte) {
    std::byte* to = shuffled.data() + byte * count;
    const std::byte* from = raw.data() + byte;
    for (std::size_t i = 0; i < count; ++i) to[i] = from[i * number_bytes];
  }
  return shuffled;
}

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

libdeflate_compressor* compressor() {
  // One a thread: making one costs as much as compressing a small chunk.
  thread_local std::unique_ptr<libdeflate_compressor, FreeCompressor> kept(libdeflate_alloc_compressor(1));
  if (!kept) throw std::bad_alloc();
  return kept.get();
}

}  // namespace

std::vector<std::byte> compress_chunk(std::span<const std::byte> raw, std::size_t number_bytes) {
  std::vector<std::byte> shuffled;
  if (number_bytes > 1) {
    shuffled = shuffle(raw, number_bytes);
    raw = shuffled;
  }
  std::vector<std::byte> packed(libdeflate_zlib_compress_bound(compressor(), raw.size()));
  packed.resize(libdeflate_zlib_compress(compressor(), raw.data(), raw.size(), packed.data(), packed.size()));
  return packed;
}

std::vector<std::byte> compress_padded_chunk(std::span<const std::byte> raw, std::size_t number_bytes,
                                             std::size_t chunk_bytes) {
  // A small run has 36 such chunks of up to 256 KiB twice over, nearly all of it zeros: to make these and have them
  // searched for repetitions took a fifth of its time.
  constexpr std::size_t kFewOf = 32;
  if (raw.size() > chunk_bytes / kFewOf) {
    std::vector<std::byte> padded(raw.begin(), raw.end());
    padded.resize(chunk_bytes);
    return compress_chunk(padded, number_bytes);
  }
  const std::vector<std::byte> shuffled = shuffle(raw, number_bytes);
  const std::size_t count = raw.size() / number_bytes;
  RunDeflate packed;
  for (std::size_t byte = 0; byte < number_bytes; ++byte) {
    packed.add(std::span(shuffled).subspan(byte * count, count));
    packed.add(std::byte{0}, chunk_bytes / number_bytes - count);
  }
  return packed.finish();
}

}  // namespace holdfast
