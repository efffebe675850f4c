#pragma once

#include <cassert>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/side_impulse.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

/// Entries of one dataset, collected in memory: bytes in their stored form, or texts before their common length is
/// known.
class Column {
 public:
  explicit Column(const DatasetSpec& spec) : spec_(&spec) {}

  template <class T>
  void append(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3> ||
                  std::is_same_v<T, std::array<Vec3, kPushedCount>>);
    assert(spec_->type == element_type_of<T>() && spec_->width * size_of(spec_->type) == sizeof(T));
    const auto raw = std::as_bytes(values);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    count_ += values.size();
  }
  template <class T>
  void append(const std::vector<T>& values) {
    append(std::span<const T>(values));
  }
  template <class T>
  void append(const T& value) {
    append(std::span<const T>(&value, 1));
  }
  void append(bool flag) { append(static_cast<std::uint8_t>(flag ? 1 : 0)); }
  void append(const std::string& text) {
    assert(spec_->type == ElementType::text || spec_->type == ElementType::label);
    if (spec_->type == ElementType::label) return append_label(text);
    texts_.push_back(valid_utf8(text));  // the type of the column is UTF-8
    ++count_;
  }

  /// Appends that member of every row.
  template <class Row, class Member>
  void append(const std::vector<Row>& rows, Member Row::*member) {
    for (const Row& row : rows) append(row.*member);
  }

  /// Adds the entries of another column of the dataset.
  void append(const Column& other);
  /// Adds entries in their stored form; texts padded to `text_size`.
  void append_stored(std::vector<std::byte>&& stored, std::size_t text_size);
  /// Moves all entries out, in their stored form; not for texts.
  std::vector<std::byte> take();

  const DatasetSpec& spec() const { return *spec_; }
  std::uint64_t count() const { return count_; }
  /// Bytes of the longest text; at least 1.
  std::size_t text_size() const;
  /// The entries in their stored form; texts padded with zero bytes to `text_size`.
  std::vector<std::byte> stored(std::size_t text_size) const;

 private:
  void append_label(const std::string& text);

  const DatasetSpec* spec_;
  std::uint64_t count_ = 0;
  std::vector<std::byte> bytes_;
  std::vector<std::string> texts_;
};

/// A column for every dataset of the schema.
class ColumnSet {
 public:
  ColumnSet();
  Column& operator[](std::string_view path) { return columns_[dataset_index(path)]; }
  const Column& operator[](std::string_view path) const { return columns_[dataset_index(path)]; }
  const std::vector<Column>& columns() const { return columns_; }
  /// Adds the entries of another set.
  void append(const ColumnSet& other);

 private:
  std::vector<Column> columns_;
};

/// Texts of a column from their stored form, without padding.
std::vector<std::string> texts_of(std::span<const std::byte> stored, std::size_t text_size);

/// Numbers of a column from their stored form.
template <class T>
std::vector<T> values_of(const std::vector<std::byte>& stored) {
  std::vector<T> values(stored.size() / sizeof(T));
  if (!stored.empty()) std::memcpy(static_cast<void*>(values.data()), stored.data(), stored.size());
  return values;
}

}  // namespace holdfast::internal
