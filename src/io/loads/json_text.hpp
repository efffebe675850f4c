#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// A part of a JSON pointer (RFC 6901), with its stroke.
std::string pointer_part(std::string_view key);

/// What nlohmann's parser says that it expected; empty where it does not.
/// @param reason the message of its exception
std::string expected_in(std::string_view reason);

/// Whether the message of an exception of nlohmann's parser is about a number that no double has.
bool is_too_large(std::string_view reason);

/// Why a text is no JSON, with its place.
/// @param position of the byte at which nlohmann's parser gives up, from 1
/// @param reason   the message of its exception
/// @param line     of the text's beginning in the file, from 1
Error json_fault(std::string_view text, std::size_t position, std::string_view reason, long line,
                 const std::string& path);

}  // namespace holdfast::internal
