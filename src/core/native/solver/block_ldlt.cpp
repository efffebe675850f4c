#include "core/native/solver/block_ldlt.hpp"

#include <algorithm>
#include <bit>

namespace holdfast::internal::native {

namespace {

constexpr std::size_t kBits = 64;

}  // namespace

bool BlockLdlt::analyse(std::size_t count, std::span<const BodyPair> pairs) {
  if (count == count_ && std::equal(pairs.begin(), pairs.end(), pairs_.begin(), pairs_.end())) return false;
  count_ = count;
  pairs_.assign(pairs.begin(), pairs.end());
  eliminate();
  list_updates();

  // Rows of a column are sorted by elimination index, so the block of a pair is found by bisection.
  pair_block_.clear();
  for (const auto& [a, b] : pairs_) {
    const auto [column, row] = std::minmax(elimination_index_[a], elimination_index_[b]);
    const auto begin = shape_.block_row.begin() + shape_.column_begin[column];
    const auto end = shape_.block_row.begin() + shape_.column_begin[column + 1];
    pair_block_.push_back(static_cast<std::uint32_t>(std::lower_bound(begin, end, row) - shape_.block_row.begin()));
  }
  diagonal_.resize(count_);
  factor_.resize(count_);
  below_.resize(shape_.block_row.size());
  return true;
}

void BlockLdlt::eliminate() {
  const std::size_t words = (count_ + kBits - 1) / kBits;
  const auto row = [&](std::size_t body) { return graph_.data() + body * words; };
  const auto set = [&](std::size_t body, std::size_t other) { row(body)[other / kBits] |= 1ULL << (other % kBits); };
  const auto clear = [&](std::size_t body, std::size_t other) {
    row(body)[other / kBits] &= ~(1ULL << (other % kBits));
  };
  graph_.assign(count_ * words, 0);
  degree_.assign(count_, 0);
  for (const auto& [a, b] : pairs_) {
    set(a, b);
    set(b, a);
    ++degree_[a];
    ++degree_[b];
  }
  elimination_index_.assign(count_, 0);
  shape_.column_begin.assign(1, 0);
  shape_.block_row.clear();
  constexpr std::uint32_t kEliminated = ~0U;
  for (std::size_t step = 0; step < count_; ++step) {
    const auto body = static_cast<std::size_t>(std::min_element(degree_.begin(), degree_.end()) - degree_.begin());
    elimination_index_[body] = static_cast<std::uint32_t>(step);
    neighbours_.clear();
    for (std::size_t word = 0; word < words; ++word)
      for (std::uint64_t bits = row(body)[word]; bits != 0; bits &= bits - 1)
        neighbours_.push_back(
            static_cast<std::uint32_t>(word * kBits + static_cast<std::size_t>(std::countr_zero(bits))));
    // Eliminating a body joins its neighbours to each other.
    for (const std::uint32_t other : neighbours_) {
      for (std::size_t word = 0; word < words; ++word) row(other)[word] |= row(body)[word];
      clear(other, other);
      clear(other, body);
      std::uint32_t degree = 0;
      for (std::size_t word = 0; word < words; ++word)
        degree += static_cast<std::uint32_t>(std::popcount(row(other)[word]));
      degree_[other] = degree;
    }
    degree_[body] = kEliminated;
    shape_.block_row.insert(shape_.block_row.end(), neighbours_.begin(), neighbours_.end());
    shape_.column_begin.push_back(static_cast<std::uint32_t>(shape_.block_row.size()));
  }
  for (std::uint32_t& body : shape_.block_row) body = elimination_index_[body];
  for (std::size_t j = 0; j < count_; ++j)
    std::sort(shape_.block_row.begin() + shape_.column_begin[j], shape_.block_row.begin() + shape_.column_begin[j + 1]);
}

void BlockLdlt::list_updates() {
  const auto below_count = static_cast<std::uint32_t>(shape_.block_row.size());
  shape_.updates.clear();
  shape_.update_begin.assign(1, 0);
  block_at_row_.assign(count_, 0);
  std::size_t longest = 0;
  for (std::size_t j = 0; j < count_; ++j) {
    const std::uint32_t begin = shape_.column_begin[j];
    const std::uint32_t end = shape_.column_begin[j + 1];
    longest = std::max<std::size_t>(longest, end - begin);
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t column = shape_.block_row[k];
      shape_.updates.push_back({below_count + column, k, k});
      for (std::uint32_t i = shape_.column_begin[column]; i < shape_.column_begin[column + 1]; ++i)
        block_at_row_[shape_.block_row[i]] = i;
      for (std::uint32_t i = k + 1; i < end; ++i) shape_.updates.push_back({block_at_row_[shape_.block_row[i]], i, k});
    }
    shape_.update_begin.push_back(static_cast<std::uint32_t>(shape_.updates.size()));
  }
  scratch_.resize(longest);
}

void BlockLdlt::clear() {
  std::fill(diagonal_.begin(), diagonal_.end(), BodyBlock{});
  std::fill(below_.begin(), below_.end(), BodyBlock{});
}

void BlockLdlt::add(std::span<const ProblemBody> bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyBlock& block = diagonal_[i];
    for (int k = 0; k < 3; ++k) {
      block.column[k][k] += bodies[i].mass;
      for (int row = 0; row < 3; ++row) block.column[3 + k][3 + row] += bodies[i].inertia(row, k);
    }
  }
}

void BlockLdlt::factorise() { native::factorise(shape_, below_, diagonal_, factor_, scratch_); }

void BlockLdlt::solve(std::span<BodyVector> x) const { native::solve(shape_, below_, factor_, x); }

}  // namespace holdfast::internal::native
