#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal::test {

/// An input file in memory only.
inline TextFile memory_file(std::string text, const std::string& path = "a.txt") {
  std::string sha256 = sha256_of(text);
  return {path, path.substr(path.rfind('/') + 1), std::move(text), std::move(sha256)};
}

using Messages = std::vector<std::string>;

inline Messages messages_of(const std::vector<Error>& errors) {
  Messages messages;
  for (const Error& error : errors) messages.push_back(error.message());
  return messages;
}

/// The messages of a result that should be an error; a single note if it is not one.
template <class T>
Messages messages_of(const Result<T>& result) {
  return result ? Messages{"no error"} : messages_of(result.errors());
}

}  // namespace holdfast::internal::test
