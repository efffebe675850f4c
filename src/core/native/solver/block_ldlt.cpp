#include "core/native/solver/block_ldlt.hpp"

#include <algorithm>
#include <cstring>

namespace holdfast::internal::native {

namespace {

/// Makes room for so many entries, whatever they hold. Large islands and small ones take turns: a vector that shrank
/// would set its entries to zero each time that it grows again.
template <class T>
void grow_to(std::vector<T>& entries, std::size_t count) {
  if (entries.size() < count) entries.resize(count);
}

}  // namespace

bool BlockLdlt::analyse(std::size_t count, std::span<const BodyPair> pairs) {
  if (count == count_ && std::equal(pairs.begin(), pairs.end(), pairs_.begin(), pairs_.end())) return false;
  // Unknown again, should memory run out on the way.
  count_ = kUnknown;
  pairs_.assign(pairs.begin(), pairs.end());
  eliminate(count);

  // Rows of a column are sorted by elimination index, so the block of a pair is found by bisection.
  pair_block_.clear();
  for (const auto& [a, b] : pairs_) {
    const auto [column, row] = std::minmax(elimination_index_[a], elimination_index_[b]);
    const auto begin = shape_.block_row.begin() + shape_.column_begin[column];
    const auto end = shape_.block_row.begin() + shape_.column_begin[column + 1];
    pair_block_.push_back(static_cast<std::uint32_t>(std::lower_bound(begin, end, row) - shape_.block_row.begin()));
  }
  grow_to(diagonal_, count);
  grow_to(factor_, count);
  grow_to(below_, shape_.block_row.size());
  block_at_row_.resize(count);
  std::size_t longest = 0;
  for (std::size_t j = 0; j < count; ++j)
    longest = std::max<std::size_t>(longest, shape_.column_begin[j + 1] - shape_.column_begin[j]);
  grow_to(scratch_, longest);
  count_ = count;
  return true;
}

void BlockLdlt::eliminate(std::size_t count) {
  graph_.assign(count, count);
  of_degree_.assign(count, count);
  degree_.assign(count, 0);
  for (const auto& [a, b] : pairs_) {
    graph_.set(a, b);
    graph_.set(b, a);
    ++degree_[a];
    ++degree_[b];
  }
  for (std::size_t body = 0; body < count; ++body) of_degree_.set(degree_[body], body);
  elimination_index_.assign(count, 0);
  shape_.column_begin.assign(1, 0);
  shape_.block_row.clear();
  std::size_t least = 0;
  for (std::size_t step = 0; step < count; ++step) {
    while (of_degree_.first_in(least) == BitRows::kNone) ++least;
    const std::size_t body = of_degree_.first_in(least);
    of_degree_.clear(least, body);
    elimination_index_[body] = static_cast<std::uint32_t>(step);
    neighbours_.clear();
    graph_.for_each_in(body, [&](std::size_t other) { neighbours_.push_back(static_cast<std::uint32_t>(other)); });
    // Eliminating a body joins its neighbours to each other.
    for (const std::uint32_t other : neighbours_) {
      const std::uint32_t before = degree_[other];
      // The body goes, and among those that are new is the neighbour itself.
      degree_[other] += graph_.add_row(other, body) - 2;
      graph_.clear(other, other);
      graph_.clear(other, body);
      of_degree_.clear(before, other);
      of_degree_.set(degree_[other], other);
      least = std::min<std::size_t>(least, degree_[other]);
    }
    shape_.block_row.insert(shape_.block_row.end(), neighbours_.begin(), neighbours_.end());
    shape_.column_begin.push_back(static_cast<std::uint32_t>(shape_.block_row.size()));
  }
  for (std::uint32_t& body : shape_.block_row) body = elimination_index_[body];
  for (std::size_t j = 0; j < count; ++j)
    std::sort(shape_.block_row.begin() + shape_.column_begin[j], shape_.block_row.begin() + shape_.column_begin[j + 1]);
}

void BlockLdlt::clear() {
  // Half of the time of a fill with blocks.
  for (const std::span<BodyBlock> blocks : {diagonal_blocks(), blocks_below()})
    if (!blocks.empty()) std::memset(static_cast<void*>(blocks.data()), 0, blocks.size_bytes());
}

void BlockLdlt::add(std::span<const ProblemBody> bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyBlock& block = diagonal_[i];
    for (int k = 0; k < 3; ++k) {
      block.column[k][k] += bodies[i].mass;
      for (int row = 0; row < 3; ++row) block.column[3 + k][kAngularRow + row] += bodies[i].inertia(row, k);
    }
  }
}

void BlockLdlt::factorise() { native::factorise(shape_, below_, diagonal_, factor_, scratch_, block_at_row_); }

void BlockLdlt::solve(std::span<BodyVector> x) const { native::solve(shape_, below_, factor_, x); }

}  // namespace holdfast::internal::native
