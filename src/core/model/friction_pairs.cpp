#include "core/model/friction_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace holdfast::internal {

namespace {

constexpr std::array kPairs = {
    FrictionPair{"timber-plywood", "sawn timber or wooden pallet, on plywood or fabric base laminate", 0.45, 0.45},
    FrictionPair{"timber-aluminium", "sawn timber or wooden pallet, on grooved aluminium", 0.4, 0.4},
    FrictionPair{"timber-steel", "sawn timber or wooden pallet, on stainless steel", 0.3, 0.3},
    FrictionPair{"timber-film", "sawn timber or wooden pallet, on shrink film", 0.3, 0.3},
    FrictionPair{"planed-wood-plywood", "planed wood on plywood or fabric base laminate", 0.3, 0.3},
    FrictionPair{"planed-wood-aluminium", "planed wood on grooved aluminium", 0.25, 0.25},
    FrictionPair{"planed-wood-steel", "planed wood on stainless steel", 0.2, 0.2},
    FrictionPair{"plastic-pallet-plywood", "plastic pallet on plywood or fabric base laminate", 0.2, 0.2},
    FrictionPair{"plastic-pallet-aluminium", "plastic pallet on grooved aluminium", 0.15, 0.15},
    FrictionPair{"plastic-pallet-steel", "plastic pallet on stainless steel", 0.15, 0.15},
    FrictionPair{"cardboard-cardboard", "untreated cardboard on the same", 0.5, std::nullopt, true},
    FrictionPair{"cardboard-pallet", "cardboard on a wooden pallet", 0.5, std::nullopt},
    FrictionPair{"big-bag-pallet", "big bag on a wooden pallet", 0.4, std::nullopt},
    FrictionPair{"rough-metal-rough-metal", "unpainted rough metal on the same", 0.4, std::nullopt, true},
    FrictionPair{"painted-rough-metal-painted-rough-metal", "painted rough metal on the same", 0.3, std::nullopt, true},
    FrictionPair{"smooth-metal-smooth-metal", "smooth metal, painted or not, on the same", 0.2, std::nullopt, true},
    FrictionPair{"steel-crate-plywood", "steel crate on plywood or fabric base laminate", 0.45, 0.45},
    FrictionPair{"steel-crate-aluminium", "steel crate on grooved aluminium", 0.3, 0.3},
    FrictionPair{"steel-crate-steel", "steel crate on stainless steel", 0.2, 0.2},
    FrictionPair{"concrete-timber", "rough concrete on sawn timber", 0.7, 0.7},
    FrictionPair{"anti-slip", "anti-slip mat of rubber, and any other material", 0.6, 0.6},
};

constexpr std::string_view kWetSuffix = "-wet";

struct NamedFriction {
  const FrictionPair* pair;
  double coefficient;
};

std::optional<NamedFriction> find(std::string_view name) {
  const bool wet = name.ends_with(kWetSuffix);
  if (wet) name.remove_suffix(kWetSuffix.size());
  const auto pair = std::find_if(kPairs.begin(), kPairs.end(), [&](const FrictionPair& p) { return p.name == name; });
  if (pair == kPairs.end() || (wet && !pair->wet)) return std::nullopt;
  return NamedFriction{&*pair, wet ? *pair->wet : pair->dry};
}

}  // namespace

std::span<const FrictionPair> friction_pairs() { return kPairs; }

std::optional<double> friction_of_pair_name(std::string_view name) {
  const auto found = find(name);
  return found ? std::optional(found->coefficient) : std::nullopt;
}

std::optional<double> friction_factor_of_name(std::string_view name) {
  const auto found = find(name);
  return found && found->pair->same ? std::optional(std::sqrt(found->coefficient)) : std::nullopt;
}

}  // namespace holdfast::internal
