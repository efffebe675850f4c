#include "io/results/results_columns.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace holdfast::internal {

void Column::append(const Column& other) {
  assert(spec_ == other.spec_);
  bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end());
  texts_.insert(texts_.end(), other.texts_.begin(), other.texts_.end());
  count_ += other.count_;
}

void Column::append_stored(std::vector<std::byte>&& stored, std::size_t text_size) {
  if (spec_->type == ElementType::text) {
    for (std::string& text : texts_of(stored, text_size)) texts_.push_back(std::move(text));
    count_ += stored.size() / text_size;
    return;
  }
  count_ += stored.size() / (spec_->width * size_of(spec_->type));
  if (bytes_.empty())
    bytes_ = std::move(stored);
  else
    bytes_.insert(bytes_.end(), stored.begin(), stored.end());
}

void Column::append_label(const std::string& text) {
  std::array<std::byte, kLabelBytes> padded{};
  std::memcpy(padded.data(), text.data(), std::min(text.size(), kLabelBytes));
  bytes_.insert(bytes_.end(), padded.begin(), padded.end());
  ++count_;
}

std::vector<std::byte> Column::take() {
  assert(spec_->type != ElementType::text);
  count_ = 0;
  return std::exchange(bytes_, {});
}

std::size_t Column::text_size() const {
  std::size_t size = 1;
  for (const std::string& text : texts_) size = std::max(size, text.size());
  return size;
}

std::vector<std::byte> Column::stored(std::size_t text_size) const {
  if (spec_->type != ElementType::text) return bytes_;
  std::vector<std::byte> padded(texts_.size() * text_size);
  std::byte* to = padded.data();
  for (const std::string& text : texts_) {
    std::memcpy(to, text.data(), std::min(text.size(), text_size));
    to += text_size;
  }
  return padded;
}

ColumnSet::ColumnSet() {
  for (const DatasetSpec& spec : schema()) columns_.emplace_back(spec);
}

void ColumnSet::append(const ColumnSet& other) {
  for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].append(other.columns_[i]);
}

std::vector<std::string> texts_of(std::span<const std::byte> stored, std::size_t text_size) {
  std::vector<std::string> texts;
  for (; stored.size() >= text_size; stored = stored.subspan(text_size)) {
    const auto end = std::find(stored.begin(), stored.begin() + static_cast<std::ptrdiff_t>(text_size), std::byte{0});
    texts.emplace_back(reinterpret_cast<const char*>(stored.data()), static_cast<std::size_t>(end - stored.begin()));
  }
  return texts;
}

}  // namespace holdfast::internal
