#include "analyses/bearing/bearing.hpp"

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "analyses/bearing/linear_program.hpp"
#include "analyses/indicators/indicators.hpp"
#include "core/model/container_panels.hpp"

namespace holdfast::internal {

namespace {

using Eigen::Index;

/// Sum of the forces that are missing or left over, over the weight of the boxes, up to which they are in equilibrium:
/// a centre of mass may be above the very edge of what carries it, up to rounding.
constexpr double kBalanced = 1e-9;
/// Rotation of a box, over the fastest motion, from which it counts as one.
constexpr double kTurns = 1e-6;

/// A rectangle in which a box stands on another or on the container.
struct Contact {
  std::size_t upper;
  std::optional<std::size_t> lower;  ///< absent: the floor, or a low wall
  double low_x, high_x, low_y, high_y;
};

/// Where a box and what is beneath it touch: faces within `kBaseGap` that have `kLeastOverlap` in common along x and y.
std::vector<Contact> contacts_of(const std::vector<Box>& boxes, const std::vector<BoxProperties>& properties,
                                 const std::vector<Panel>& panels) {
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (properties[i].fixed) continue;
    const Vec3& low = boxes[i].corner_min;
    const Vec3& high = boxes[i].corner_max;
    const auto add = [&](std::optional<std::size_t> lower, const Vec3& from, const Vec3& to) {
      if (std::abs(low.z() - to.z()) > kBaseGap) return;
      const Contact contact{i,
                            lower,
                            std::max(low.x(), from.x()),
                            std::min(high.x(), to.x()),
                            std::max(low.y(), from.y()),
                            std::min(high.y(), to.y())};
      if (contact.high_x - contact.low_x >= kLeastOverlap && contact.high_y - contact.low_y >= kLeastOverlap)
        contacts.push_back(contact);
    };
    for (const Panel& panel : panels) add({}, panel.low(), panel.high());
    for (std::size_t j = 0; j < boxes.size(); ++j)
      if (j != i) add(j, boxes[j].corner_min, boxes[j].corner_max);
  }
  return contacts;
}

/// Divides boxes into groups that share no force: boxes that carry each other, directly or through others.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  std::vector<std::size_t> parent_;
};

/// The bearing of a layout, group by group.
class BearingSearch {
 public:
  BearingSearch(const Layout& layout, const Settings& settings)
      : boxes_(layout.boxes),
        ranges_(boxes_.size()),
        first_row_(boxes_.size()),
        carries_anything_(boxes_.size(), true) {
    for (const Box& box : boxes_) properties_.push_back(properties_of(settings, box));
    contacts_ = contacts_of(boxes_, properties_, container_panels(container_of(settings, layout), kWallThickness));
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (!properties_[i].fixed) ranges_[i].footing = Footing::unsupported;
    for (const Contact& contact : contacts_) {
      ranges_[contact.upper].footing = Footing::stands;
      if (contact.lower || !is_whole(contact)) carries_anything_[contact.upper] = false;
    }
  }

  std::vector<BearingRange> find() {
    Groups groups(boxes_.size());
    for (const Contact& contact : contacts_)
      if (contact.lower && !carries_anything_[*contact.lower]) groups.join(contact.upper, *contact.lower);
    std::vector<Group> members(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (!carries_anything_[i]) members[groups.of(i)].boxes.push_back(i);
    // From bottom to top, which keeps the factors of a basis sparse.
    for (Group& group : members)
      std::stable_sort(group.boxes.begin(), group.boxes.end(), [&](std::size_t a, std::size_t b) {
        return boxes_[a].corner_min.z() < boxes_[b].corner_min.z();
      });
    for (const Contact& contact : contacts_)
      if (!carries_anything_[contact.upper]) members[groups.of(contact.upper)].contacts.push_back(contact);
    for (const Group& group : members) find_in(group);
    return std::move(ranges_);
  }

 private:
  struct Group {
    std::vector<std::size_t> boxes;
    std::vector<Contact> contacts;
  };

  struct Equations {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd right_side;
  };

  /// Centre of mass, container frame.
  Vec3 centre_of(std::size_t i) const {
    return 0.5 * (boxes_[i].corner_min + boxes_[i].corner_max) + properties_[i].centre_of_mass;
  }

  /// Whether the whole bottom face of the upper box is in contact, up to `kBaseGap`.
  bool is_whole(const Contact& contact) const {
    const Box& box = boxes_[contact.upper];
    return std::max(contact.low_x - box.corner_min.x(), box.corner_max.x() - contact.high_x) <= kBaseGap &&
           std::max(contact.low_y - box.corner_min.y(), box.corner_max.y() - contact.high_y) <= kBaseGap;
  }

  /// Adds what a group puts on each box beneath one of it.
  void find_in(const Group& group) {
    double mass = 0.0;
    for (const std::size_t i : group.boxes) mass += properties_[i].mass;
    if (mass <= 0.0) return;
    std::optional<LinearProgram> program;
    auto answer = LinearProgram::Answer::no;
    // A box that tips is held upright by something: its equations of moments go. Each turn finds at least one more.
    for (bool more = true; more && answer == LinearProgram::Answer::no;) {
      const Equations equations = equations_of(group, mass);
      program.emplace(equations.matrix, equations.right_side);
      answer = program->find_feasible(kBalanced);
      more = answer == LinearProgram::Answer::no && mark_tipping(group, program->certificate());
    }
    std::vector<std::size_t> lower;
    for (const Contact& contact : group.contacts)
      if (contact.lower) lower.push_back(*contact.lower);
    std::sort(lower.begin(), lower.end());
    lower.erase(std::unique(lower.begin(), lower.end()), lower.end());
    for (const std::size_t i : lower) {
      Eigen::VectorXd on_top = Eigen::VectorXd::Zero(4 * static_cast<Index>(group.contacts.size()));
      for (std::size_t k = 0; k < group.contacts.size(); ++k)
        if (group.contacts[k].lower == i) on_top.segment<4>(4 * static_cast<Index>(k)).setOnes();
      const std::optional<double> least = program->minimise(on_top);
      const std::optional<double> largest = program->minimise(-on_top);
      constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
      ranges_[i].least += least ? std::max(0.0, *least) * mass : kUnknown;
      ranges_[i].largest += largest ? std::max(0.0, -*largest) * mass : kUnknown;
    }
  }

  /// The equilibrium of a group. Unknown are the forces F ≥ 0 at the corners (x, y) of all contacts, to which any
  /// pressure on these rectangles is equivalent, in units of the group's weight. For each box of mass m, with its
  /// centre of mass at (c_x, c_y) and half its size (h_x, h_y), forces from below minus those from above:
  ///   Σ F = m / Σ m,   Σ F (x − c_x) / h_x = 0,   Σ F (y − c_y) / h_y = 0
  Equations equations_of(const Group& group, double mass) {
    Index rows = 0;
    for (const std::size_t i : group.boxes) {
      first_row_[i] = rows;
      rows += ranges_[i].footing == Footing::tips ? 1 : 3;
    }
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(rows);
    for (const std::size_t i : group.boxes) weights[first_row_[i]] = properties_[i].mass / mass;
    Eigen::SparseMatrix<double> matrix(rows, 4 * static_cast<Index>(group.contacts.size()));
    matrix.reserve(Eigen::VectorXi::Constant(matrix.cols(), 6));
    Index column = 0;
    for (const Contact& contact : group.contacts)
      for (const double x : {contact.low_x, contact.high_x})
        for (const double y : {contact.low_y, contact.high_y}) {
          add_force(matrix, column, contact.upper, 1.0, x, y);
          if (contact.lower && !carries_anything_[*contact.lower])
            add_force(matrix, column, *contact.lower, -1.0, x, y);
          ++column;
        }
    matrix.makeCompressed();
    return {matrix, std::move(weights)};
  }

  void add_force(Eigen::SparseMatrix<double>& matrix, Index column, std::size_t i, double sign, double x,
                 double y) const {
    const Index row = first_row_[i];
    matrix.insert(row, column) = sign;
    if (ranges_[i].footing == Footing::tips) return;
    const Vec3 half = 0.5 * (boxes_[i].corner_max - boxes_[i].corner_min);
    const Vec3 centre = centre_of(i);
    matrix.insert(row + 1, column) = sign * (x - centre.x()) / half.x();
    matrix.insert(row + 2, column) = sign * (y - centre.y()) / half.y();
  }

  /// Where there is no equilibrium, the certificate is a motion, downwards and about two axes for each box, that closes
  /// no contact and lowers the weights: the boxes that rotate in it tip. False where no further box does.
  bool mark_tipping(const Group& group, const Eigen::VectorXd& motion) {
    bool more = false;
    for (const std::size_t i : group.boxes) {
      if (ranges_[i].footing == Footing::tips || motion.segment<2>(first_row_[i] + 1).cwiseAbs().maxCoeff() < kTurns)
        continue;
      ranges_[i].footing = Footing::tips;
      more = true;
    }
    return more;
  }

  const std::vector<Box>& boxes_;
  std::vector<BoxProperties> properties_;
  std::vector<Contact> contacts_;
  std::vector<BearingRange> ranges_;
  std::vector<Index> first_row_;  ///< of a box in the equations of its group
  /// Boxes that no equation needs: whatever stands on them, they carry it. Fixed ones, those without support, and those
  /// that stand wholly on the floor, which takes every force from above where it acts, and their weight.
  std::vector<bool> carries_anything_;
};

}  // namespace

std::vector<BearingRange> find_bearing(const Layout& layout, const Settings& settings) {
  return BearingSearch(layout, settings).find();
}

}  // namespace holdfast::internal
