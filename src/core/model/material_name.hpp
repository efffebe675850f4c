#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace holdfast::internal {

/// What a box is made of: a number from 0, or a name. A section `[Material 3]` or `[Material pallet]` describes it.
class MaterialName {
 public:
  MaterialName(int id = 0) : id_(id) {}
  /// A text of digits is a number.
  explicit MaterialName(std::string_view text);

  bool is_number() const { return name_.empty(); }
  int id() const { return id_; }  ///< -1 where it has a name
  std::string text() const { return is_number() ? std::to_string(id_) : name_; }

  // Not <=>: emscripten's C++ library does not have that of texts.
  friend bool operator==(const MaterialName&, const MaterialName&) = default;
  friend bool operator<(const MaterialName& a, const MaterialName& b) {
    return std::tie(a.id_, a.name_) < std::tie(b.id_, b.name_);
  }

 private:
  int id_ = 0;
  std::string name_;
};

}  // namespace holdfast::internal
