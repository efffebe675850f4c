#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace holdfast::internal {

/// Compresses a chunk to the bytes that HDF5's filters shuffle and deflate read: bytes of the same significance
/// together, then a zlib stream (RFC 1950) of level 1. Has no side effects; any thread may call it.
/// @param number_bytes size of one number; for 1 the dataset has no shuffle filter
std::vector<std::byte> compress_chunk(std::span<const std::byte> raw, std::size_t number_bytes);

/// The same for a chunk of `chunk_bytes` that begins with `raw` and continues with zeros.
std::vector<std::byte> compress_padded_chunk(std::span<const std::byte> raw, std::size_t number_bytes,
                                             std::size_t chunk_bytes);

}  // namespace holdfast::internal
