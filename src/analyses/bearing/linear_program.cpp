#include "analyses/bearing/linear_program.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace holdfast::internal {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// A variable enters the basis when its reduced cost is below the negative of this.
constexpr double kOptimal = 1e-9;
/// Values of variables count as 0 up to this.
constexpr double kZero = 1e-11;
/// Entries of a direction up to this are rounding: no pivots.
constexpr double kPivot = 1e-8;
/// Entries of eliminations up to this are what remains where numbers cancel.
constexpr double kRounding = 1e-15;
/// Exchanges after which the basis is factorised anew.
constexpr std::size_t kExchanges = 60;
/// Into how many blocks columns are divided, of which one at a time is looked through for the next exchange.
constexpr Index kBlocks = 8;
/// Exchanges without progress after which Bland's rule, which cannot cycle, takes over until there is some.
constexpr int kPatience = 100;
/// Exchanges per column after which a search is given up: hundreds of times what it takes.
constexpr Index kExchangesPerColumn = 100;

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

}  // namespace

LinearProgram::LinearProgram(const Matrix& matrix, VectorXd right_side)
    : variables_(matrix.cols()),
      matrix_(matrix.rows(), matrix.cols() + 2 * matrix.rows()),
      right_side_(std::move(right_side)) {
  const Index rows = matrix.rows();
  matrix_.reserve(matrix.nonZeros() + 2 * rows);
  for (Index column = 0; column < matrix_.cols(); ++column) {
    matrix_.startVec(column);
    const Index artificial = column - variables_;
    if (artificial >= 0)
      matrix_.insertBack(artificial % rows, column) = artificial < rows ? 1.0 : -1.0;
    else
      for (Matrix::InnerIterator entry(matrix, column); entry; ++entry)
        matrix_.insertBack(entry.row(), column) = entry.value();
  }
  matrix_.finalize();
  in_basis_.resize(at(matrix_.cols()), false);
  for (Index row = 0; row < rows; ++row) {
    basis_.push_back(variables_ + (right_side_[row] < 0 ? rows : 0) + row);
    in_basis_[at(basis_.back())] = true;
  }
}

LinearProgram::Answer LinearProgram::find_feasible(double tolerance) {
  // Phase 1: the least sum of the artificial variables, which take up what A x leaves of b.
  VectorXd cost = VectorXd::Zero(matrix_.cols());
  cost.tail(matrix_.cols() - variables_).setOnes();
  if (!factorise() || !search(cost) || !factorise()) return Answer::unknown;
  double left = 0.0;
  for (Index row = 0; row < values_.size(); ++row)
    if (is_artificial(basis_[at(row)])) left += std::abs(values_[row]);
  if (left > tolerance) return Answer::no;
  feasible_ = true;
  return Answer::yes;
}

std::optional<double> LinearProgram::minimise(const VectorXd& cost) {
  if (!feasible_ || !search(cost)) return std::nullopt;
  double value = 0.0;
  for (Index row = 0; row < values_.size(); ++row)
    if (!is_artificial(basis_[at(row)])) value += cost[basis_[at(row)]] * values_[row];
  return value;
}

/// The simplex method from the basis as it is. False where it does not end.
/// @param cost of columns of A; of all columns in phase 1
bool LinearProgram::search(const VectorXd& cost) {
  int idle = 0;
  VectorXd direction(matrix_.rows());
  for (Index turn = 0; turn < kExchangesPerColumn * matrix_.cols(); ++turn) {
    prices_.resize(matrix_.rows());
    for (Index row = 0; row < matrix_.rows(); ++row)
      prices_[row] = basis_[at(row)] < cost.size() ? cost[basis_[at(row)]] : 0.0;
    solve_transposed(prices_);
    const bool first = idle > kPatience;
    const Index enters = entering(cost, first);
    if (enters < 0) return true;
    direction = matrix_.col(enters);
    solve(direction);
    const Index row = leaving(direction, first);
    if (row < 0) return false;
    const double step =
        feasible_ && is_artificial(basis_[at(row)]) ? 0.0 : std::max(0.0, values_[row] / direction[row]);
    idle = step > kZero ? 0 : idle + 1;
    values_ -= step * direction;
    values_[row] = step;
    exchange(row, enters, direction);
    if (eliminations_.size() >= factors_ + kExchanges && !factorise()) return false;
  }
  return false;
}

/// The column that enters the basis, -1 at the optimum: that of the least reduced cost c − y·A in the next block of
/// columns that has one below 0, or the first of all that is.
Index LinearProgram::entering(const VectorXd& cost, bool first) {
  const Index block = first ? 1 : cost.size() / kBlocks + 1;
  if (first || next_ >= cost.size()) next_ = 0;
  Index best = -1;
  double least = -kOptimal;
  for (Index seen = 0; seen < cost.size() && (best < 0 || seen % block != 0); ++seen) {
    const Index column = next_;
    next_ = next_ + 1 < cost.size() ? next_ + 1 : 0;
    if (in_basis_[at(column)]) continue;
    double reduced = cost[column];
    for (Matrix::InnerIterator entry(matrix_, column); entry; ++entry) reduced -= prices_[entry.row()] * entry.value();
    if (reduced >= least) continue;
    best = column;
    least = reduced;
  }
  return best;
}

/// The row whose variable reaches 0 first, -1 if none does. Of those that do so within rounding the one with the
/// largest pivot (Harris, Mathematical Programming 5, 1973), or that of the first column.
Index LinearProgram::leaving(const VectorXd& direction, bool first) const {
  const auto sealed = [&](Index row) { return feasible_ && is_artificial(basis_[at(row)]); };
  double longest = std::numeric_limits<double>::infinity();
  for (Index row = 0; row < direction.size(); ++row) {
    if (std::abs(direction[row]) <= kPivot) continue;
    if (sealed(row))
      longest = 0.0;
    else if (direction[row] > 0)
      longest = std::min(longest, (std::max(0.0, values_[row]) + kZero) / direction[row]);
  }
  Index best = -1;
  for (Index row = 0; row < direction.size(); ++row) {
    if (std::abs(direction[row]) <= kPivot) continue;
    if (!sealed(row) && (direction[row] < 0 || values_[row] > longest * direction[row])) continue;
    if (best < 0 || (first ? basis_[at(row)] < basis_[at(best)] : std::abs(direction[row]) > std::abs(direction[best])))
      best = row;
  }
  return best;
}

/// Lets a column, seen from the basis as `direction`, take the place of the one of a row.
void LinearProgram::exchange(Index row, Index enters, const VectorXd& direction) {
  in_basis_[at(basis_[at(row)])] = false;
  in_basis_[at(enters)] = true;
  basis_[at(row)] = enters;
  const std::size_t begin = entries_.size();
  for (Index i = 0; i < direction.size(); ++i)
    if (i != row && std::abs(direction[i]) > kRounding) entries_.push_back({i, direction[i]});
  eliminations_.push_back({row, direction[row], begin, entries_.size()});
}

/// Factorises the basis, and finds the values of its variables. False where it has lost its rank.
bool LinearProgram::factorise() {
  eliminations_.clear();
  entries_.clear();
  // Columns of one entry first, and then by the first row of each.
  const auto order_of = [&](Index column) {
    return is_artificial(column) ? -1 : matrix_.innerIndexPtr()[matrix_.outerIndexPtr()[column]];
  };
  std::vector<Index> columns = basis_;
  std::stable_sort(columns.begin(), columns.end(), [&](Index a, Index b) { return order_of(a) < order_of(b); });

  // Column by column (Gilbert and Peierls, SIAM J. Sci. Stat. Comput. 9, 1988): what the lower factor so far makes of
  // it is a column of the upper factor in rows that have a pivot, and of the lower one in the others.
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> step_of(basis_.size(), kNone);
  std::vector<Elimination> upper;
  std::vector<Entry> upper_entries;
  VectorXd side = VectorXd::Zero(matrix_.rows());
  std::vector<bool> touched(basis_.size(), false);
  std::vector<Index> rows;                                                           // that are touched
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> steps;  // that are to be taken
  const auto touch = [&](Index row) {
    if (touched[at(row)]) return;
    touched[at(row)] = true;
    rows.push_back(row);
    if (step_of[at(row)] != kNone) steps.push(step_of[at(row)]);
  };
  for (const Index column : columns) {
    for (Matrix::InnerIterator entry(matrix_, column); entry; ++entry) {
      side[entry.row()] = entry.value();
      touch(entry.row());
    }
    for (; !steps.empty(); steps.pop()) {
      const Elimination& step = eliminations_[steps.top()];
      for (std::size_t k = step.begin; k < step.end; ++k) touch(entries_[k].row);
      eliminate(step, side);
    }
    Index pivot = -1;
    for (const Index row : rows)
      if (step_of[at(row)] == kNone && (pivot < 0 || std::abs(side[row]) > std::abs(side[pivot]))) pivot = row;
    if (pivot < 0 || std::abs(side[pivot]) < kPivot) return false;
    Elimination below{pivot, side[pivot], entries_.size(), 0};
    Elimination above{pivot, 1.0, upper_entries.size(), 0};
    for (const Index row : rows) {
      if (row != pivot && std::abs(side[row]) > kRounding)
        (step_of[at(row)] == kNone ? entries_ : upper_entries).push_back({row, side[row]});
      side[row] = 0.0;
      touched[at(row)] = false;
    }
    rows.clear();
    below.end = entries_.size();
    above.end = upper_entries.size();
    step_of[at(pivot)] = eliminations_.size();
    basis_[at(pivot)] = column;
    eliminations_.push_back(below);
    if (above.end > above.begin) upper.push_back(above);
  }
  // The upper factor is undone from its end.
  for (auto step = upper.rbegin(); step != upper.rend(); ++step)
    eliminations_.push_back({step->row, 1.0, step->begin + entries_.size(), step->end + entries_.size()});
  entries_.insert(entries_.end(), upper_entries.begin(), upper_entries.end());
  factors_ = eliminations_.size();
  values_ = right_side_;
  solve(values_);
  return true;
}

void LinearProgram::eliminate(const Elimination& step, VectorXd& side) const {
  if (side[step.row] == 0.0) return;
  const double value = side[step.row] /= step.pivot;
  for (std::size_t k = step.begin; k < step.end; ++k) side[entries_[k].row] -= entries_[k].value * value;
}

/// Makes x with B x = side for the basis B out of the side.
void LinearProgram::solve(VectorXd& side) const {
  for (const Elimination& step : eliminations_) eliminate(step, side);
}

/// Makes y with y·B = side out of the side.
void LinearProgram::solve_transposed(VectorXd& side) const {
  for (auto step = eliminations_.rbegin(); step != eliminations_.rend(); ++step) {
    double value = side[step->row];
    for (std::size_t k = step->begin; k < step->end; ++k) value -= entries_[k].value * side[entries_[k].row];
    side[step->row] = value / step->pivot;
  }
}

}  // namespace holdfast::internal
