#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::internal {

/// What a material meets: another one, the floor, walls and roof, or any of the other materials.
struct FrictionPartners {
  std::string first;   ///< a material, or `any`
  std::string second;  ///< a material, `floor`, `wall` or `any`
  friend bool operator==(const FrictionPartners&, const FrictionPartners&) = default;

  std::string text() const { return first + ", " + second; }  ///< as a key of [Friction]
};

/// Reads two names with a comma between them, in any order. What is more general comes second in the result; of two
/// materials the one that is first in byte order. Nothing where there are not two names, or none of them is a box.
std::optional<FrictionPartners> parse_partners(std::string_view text);

/// Coefficients of static friction of pairs of materials, `[Friction]`, where they differ from those of any pair. The
/// most specific row holds: two materials before a material with floor or walls, and these before a material with any.
class FrictionTable {
 public:
  struct Row {
    FrictionPartners partners;
    double coefficient = 0.0;
    friend bool operator==(const Row&, const Row&) = default;
  };

  /// No material of the table.
  static constexpr int kOther = -1;

  bool empty() const { return rows_.empty(); }
  std::span<const Row> rows() const { return rows_; }

  /// Adds a row, or changes the one of the same partners.
  void set(const FrictionPartners& partners, double coefficient);

  /// Index of a material for the functions below; `kOther` where no row names it.
  int index_of(std::string_view material) const;

  /// Coefficients by material; nothing where no row says, so that those of any pair hold.
  std::optional<double> of_boxes(int a, int b) const { return at(boxes, a, b); }
  std::optional<double> on_floor(int material) const { return at(floor, material, kOther); }
  std::optional<double> on_wall(int material) const { return at(wall, material, kOther); }

  /// Two rows of one rank that differ for a pair which no row of a higher rank decides: both name one material with
  /// any.
  struct Ambiguity {
    Row first, second;
  };
  std::optional<Ambiguity> ambiguity() const;

  friend bool operator==(const FrictionTable& a, const FrictionTable& b) { return a.rows_ == b.rows_; }

 private:
  enum Partner : std::size_t { boxes, floor, wall };

  std::optional<double> at(Partner partner, int a, int b) const;
  std::optional<double> find(const FrictionPartners& partners) const;

  std::vector<Row> rows_;
  std::vector<std::string> materials_;  ///< that rows name, in byte order
  /// By partner, first and second material, each index one more than that of the material: 0 stands for others.
  std::vector<std::optional<double>> compiled_;
};

}  // namespace holdfast::internal
