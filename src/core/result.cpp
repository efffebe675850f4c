#include "core/result.hpp"

namespace holdfast {

std::string Error::message() const {
  std::string text = file;
  if (line > 0) text += ':' + std::to_string(line);
  if (line > 0 && column > 0) text += ':' + std::to_string(column);
  if (!text.empty()) text += ": ";
  text += what;
  if (!value.empty()) text += ": " + value;
  if (!accepted.empty()) text += "; " + accepted;
  return text;
}

}  // namespace holdfast
