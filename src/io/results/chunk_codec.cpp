#include "io/results/chunk_codec.hpp"

#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

namespace holdfast::internal {

namespace {

/// Like HDF5's shuffle filter: first the lowest byte of every number, then the next, ….
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

/// A zlib stream of bytes that are nearly all fill; the fill need not be in memory. Only repetitions of one byte are
/// searched for, which is several times faster than a search for any repetition.
class FillStream {
 public:
  FillStream() {
    constexpr int kWindowBits = 15;
    constexpr int kMemoryLevel = 8;
    if (deflateInit2(&stream_, Z_BEST_SPEED, Z_DEFLATED, kWindowBits, kMemoryLevel, Z_RLE) != Z_OK)
      throw std::bad_alloc();
  }
  ~FillStream() { deflateEnd(&stream_); }
  FillStream(const FillStream&) = delete;
  FillStream& operator=(const FillStream&) = delete;

  void add(std::span<const std::byte> bytes) { pump(bytes, Z_NO_FLUSH); }

  void add_zeros(std::size_t count) {
    static constexpr std::array<std::byte, 16'384> kZeros = {};
    for (; count > 0; count -= std::min(count, kZeros.size()))
      add(std::span(kZeros).first(std::min(count, kZeros.size())));
  }

  /// The complete stream; nothing may be added afterwards.
  std::vector<std::byte> finish() {
    pump({}, Z_FINISH);
    packed_.resize(stream_.total_out);
    return std::move(packed_);
  }

 private:
  void pump(std::span<const std::byte> bytes, int flush) {
    // zlib does not write to its input, but the type of its pointer is not const.
    stream_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    stream_.avail_in = static_cast<uInt>(bytes.size());
    do {
      packed_.resize(std::max(packed_.size(), stream_.total_out + kRoom));
      stream_.next_out = reinterpret_cast<Bytef*>(packed_.data()) + stream_.total_out;
      stream_.avail_out = static_cast<uInt>(packed_.size() - stream_.total_out);
      deflate(&stream_, flush);
    } while (stream_.avail_out == 0);
  }

  static constexpr std::size_t kRoom = 1024;
  z_stream stream_ = {};
  std::vector<std::byte> packed_;
};

libdeflate_compressor* compressor() {
  // One per thread: creating one takes as long as compressing a small chunk.
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
  // A small run has 36 such chunks of up to 256 KiB, written twice, and nearly all zeros. Creating them and searching
  // them for repetitions took a fifth of its time.
  constexpr std::size_t kFewOf = 32;
  if (raw.size() > chunk_bytes / kFewOf) {
    std::vector<std::byte> padded(raw.begin(), raw.end());
    padded.resize(chunk_bytes);
    return compress_chunk(padded, number_bytes);
  }
  const std::vector<std::byte> shuffled = shuffle(raw, number_bytes);
  const std::size_t count = raw.size() / number_bytes;
  FillStream packed;
  for (std::size_t byte = 0; byte < number_bytes; ++byte) {
    packed.add(std::span(shuffled).subspan(byte * count, count));
    packed.add_zeros(chunk_bytes / number_bytes - count);
  }
  return packed.finish();
}

}  // namespace holdfast::internal
