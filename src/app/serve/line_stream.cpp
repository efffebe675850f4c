#include "app/serve/line_stream.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace holdfast::internal {

namespace {

constexpr std::size_t kPiece = 65536;  // bytes that are read at once

}  // namespace

std::optional<InputLine> LineStream::next() {
  while (true) {
    const std::size_t end = buffer_.find('\n', searched_);
    if (end == std::string::npos) break;
    const std::string_view text = std::string_view(buffer_).substr(begin_, end - begin_);
    begin_ = searched_ = end + 1;
    if (skipping_)
      skipping_ = false;
    else
      return text.size() > longest_ ? line({}, true) : line(text, false);
  }
  searched_ = buffer_.size();
  const std::string_view rest = std::string_view(buffer_).substr(begin_);
  if (!skipping_ && rest.size() > longest_) {
    skipping_ = true;
    return line({}, true);
  }
  if (skipping_ || rest.empty() || !ended_) return std::nullopt;
  begin_ = buffer_.size();
  return line(rest, false);
}

void LineStream::read_some() {
  buffer_.erase(0, skipping_ ? buffer_.size() : begin_);
  begin_ = 0;
  const std::size_t kept = buffer_.size();
  buffer_.resize(kept + kPiece);
  const ssize_t count = ::read(descriptor_, buffer_.data() + kept, kPiece);
  const int reason = errno;
  buffer_.resize(kept + (count > 0 ? static_cast<std::size_t>(count) : 0));
  searched_ = kept;
  if (count > 0 || (count < 0 && (reason == EINTR || reason == EAGAIN))) return;
  ended_ = true;
  if (count < 0) failure_ = std::strerror(reason);
}

}  // namespace holdfast::internal
