#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <optional>
#include <vector>

namespace holdfast::internal {

/// Minimises c·x over A x = b, x ≥ 0, for one A and b and many c: the revised simplex method (Dantzig, Linear
/// Programming and Extensions, 1963, chapters 5 and 9). Every search begins where the one before ended. A has full row
/// rank; its entries and those of b are of the order of 1 at most.
class LinearProgram {
 public:
  enum class Answer { yes, no, unknown };

  /// @param matrix A; its factors stay sparse where it is nearly block triangular, with the diagonal first
  LinearProgram(const Eigen::SparseMatrix<double>& matrix, Eigen::VectorXd right_side);

  /// Whether there is an x; to be asked first. Unknown where the search does not end.
  /// @param tolerance up to which the sum of |A x − b| counts as 0
  Answer find_feasible(double tolerance);

  /// After the answer no, why: y with y·A ≤ 0, |y| ≤ 1 in each entry, and y·b > 0, as large as it can be (Farkas 1902).
  const Eigen::VectorXd& certificate() const { return prices_; }

  /// The least c·x, after the answer yes. Nothing where there is none, or the search does not end.
  /// @param cost one per column of A
  std::optional<double> minimise(const Eigen::VectorXd& cost);

 private:
  /// A unit matrix but for one column: multiplying by its inverse divides the entry of `row` by the pivot, and
  /// subtracts multiples of it from others. The inverse of the basis is a product of such.
  struct Elimination {
    Eigen::Index row;
    double pivot;
    std::size_t begin, end;  ///< of its other entries in `entries_`
  };
  struct Entry {
    Eigen::Index row;
    double value;
  };

  bool is_artificial(Eigen::Index column) const { return column >= variables_; }
  bool factorise();
  void eliminate(const Elimination& step, Eigen::VectorXd& side) const;
  void solve(Eigen::VectorXd& side) const;
  void solve_transposed(Eigen::VectorXd& side) const;
  Eigen::Index entering(const Eigen::VectorXd& cost, bool first);
  Eigen::Index leaving(const Eigen::VectorXd& direction, bool first) const;
  void exchange(Eigen::Index row, Eigen::Index enters, const Eigen::VectorXd& direction);
  bool search(const Eigen::VectorXd& cost);

  Eigen::Index variables_;              ///< columns of A
  Eigen::SparseMatrix<double> matrix_;  ///< A, and the artificial columns of phase 1: a unit matrix and its negative
  Eigen::VectorXd right_side_;
  std::vector<Eigen::Index> basis_;  ///< of each row, the column of its variable
  std::vector<bool> in_basis_;       ///< of each column
  Eigen::VectorXd values_;           ///< of the variables in the basis
  Eigen::VectorXd prices_;           ///< y with y·B = the costs of the basis B, at the end of the last search
  bool feasible_ = false;            ///< artificial variables are 0, and stay so
  Eigen::Index next_ = 0;            ///< column at which the search for the next exchange goes on
  std::vector<Elimination> eliminations_;
  std::vector<Entry> entries_;
  std::size_t factors_ = 0;  ///< eliminations that are the factors of a basis; one for each exchange follows
};

}  // namespace holdfast::internal
