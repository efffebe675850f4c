#include <utility>

#include "holdfast/holdfast.hpp"

namespace holdfast {

Error::Error(std::vector<Problem> problems) : problems_(std::move(problems)) {
  if (problems_.empty()) problems_.push_back({.what = "unknown problem", .message = "unknown problem"});
  text_ = problems_.front().message;
  if (problems_.size() > 1) text_ += " (and " + std::to_string(problems_.size() - 1) + " more)";
}

Error::~Error() = default;
Error::Error(const Error&) = default;
Error& Error::operator=(const Error&) = default;

const char* Error::what() const noexcept { return text_.c_str(); }

}  // namespace holdfast
