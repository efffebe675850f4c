#include "core/model/friction_table.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace holdfast::internal {

namespace {

constexpr std::string_view kAny = "any";
constexpr std::string_view kFloorName = "floor";
constexpr std::string_view kWallName = "wall";

bool is_material(std::string_view name) { return name != kAny && name != kFloorName && name != kWallName; }

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

std::optional<FrictionPartners> parse_partners(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find(',', comma + 1) != std::string_view::npos) return std::nullopt;
  std::string_view first = without_blanks(text.substr(0, comma));
  std::string_view second = without_blanks(text.substr(comma + 1));
  // Materials come first, in byte order; `any` comes before floor and wall.
  const auto rank = [](std::string_view name) { return is_material(name) ? 0 : name == kAny ? 1 : 2; };
  if (rank(second) < rank(first) || (rank(first) == 0 && rank(second) == 0 && second < first)) std::swap(first, second);
  if (first.empty() || second.empty() || rank(first) == 2) return std::nullopt;
  return FrictionPartners{std::string(first), std::string(second)};
}

void FrictionTable::set(const FrictionPartners& partners, double coefficient) {
  const auto same = std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.partners == partners; });
  if (same != rows_.end())
    same->coefficient = coefficient;
  else
    rows_.push_back({partners, coefficient});

  std::set<std::string> names;
  for (const Row& row : rows_)
    for (const std::string& name : {row.partners.first, row.partners.second})
      if (is_material(name)) names.insert(name);
  materials_.assign(names.begin(), names.end());

  const std::size_t size = materials_.size() + 1;
  const auto name_of = [&](std::size_t index) { return index == 0 ? std::string(kAny) : materials_[index - 1]; };
  compiled_.assign(3 * size * size, std::nullopt);
  for (std::size_t a = 0; a < size; ++a) {
    const std::optional<double> with_any = a == 0 ? std::nullopt : find({name_of(a), std::string(kAny)});
    for (const auto& [partner, name] : {std::pair{floor, kFloorName}, std::pair{wall, kWallName}}) {
      std::optional<double> own = a == 0 ? std::nullopt : find({name_of(a), std::string(name)});
      compiled_[(partner * size + a) * size] = own ? own : with_any;
    }
    for (std::size_t b = 0; b < size; ++b) {
      const FrictionPartners two{name_of(std::min(a, b)), name_of(std::max(a, b))};
      std::optional<double> both = a == 0 || b == 0 ? std::nullopt : find(two);
      if (!both) both = with_any;
      if (!both && b != 0) both = find({name_of(b), std::string(kAny)});
      compiled_[(boxes * size + a) * size + b] = both;
    }
  }
}

int FrictionTable::index_of(std::string_view material) const {
  const auto found = std::lower_bound(materials_.begin(), materials_.end(), material);
  return found == materials_.end() || *found != material ? kOther : static_cast<int>(found - materials_.begin());
}

std::optional<double> FrictionTable::at(Partner partner, int a, int b) const {
  if (rows_.empty()) return std::nullopt;
  const std::size_t size = materials_.size() + 1;
  return compiled_[(partner * size + static_cast<std::size_t>(a + 1)) * size + static_cast<std::size_t>(b + 1)];
}

std::optional<double> FrictionTable::find(const FrictionPartners& partners) const {
  for (const Row& row : rows_)
    if (row.partners == partners) return row.coefficient;
  return std::nullopt;
}

std::optional<FrictionTable::Ambiguity> FrictionTable::ambiguity() const {
  for (const Row& a : rows_) {
    for (const Row& b : rows_) {
      const bool both_with_any = a.partners.second == kAny && b.partners.second == kAny;
      if (!both_with_any || a.partners.first >= b.partners.first || a.coefficient == b.coefficient) continue;
      if (!find({a.partners.first, b.partners.first})) return Ambiguity{a, b};
    }
  }
  return std::nullopt;
}

}  // namespace holdfast::internal
