#include "analyses/replicas/replica_draw.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/byte_hash.hpp"
#include "core/base/mixed_bits.hpp"

namespace holdfast::internal {

namespace {

/// Largest deviation of a factor, in standard deviations: with a spread of 0.3, friction stays positive.
constexpr double kLargestDeviation = 3.0;

/// What is drawn. A material's number, or a hash of its name, is added to the last one.
enum class Quantity : std::uint64_t { container, box_box, box_floor, box_wall, acceleration, material };

std::uint64_t hash_of(std::string_view text) {
  ByteHash hash;
  hash.add(text.data(), text.size());
  return hash.value();
}

std::uint64_t hash_of(const MaterialName& material) {
  return material.is_number() ? static_cast<std::uint32_t>(material.id()) : hash_of(material.text());
}

/// The numbers of one replica of a layout, each drawn by its name alone.
class Generator {
 public:
  Generator(std::uint64_t boxes, std::uint32_t number) : seed_(mixed_bits(mixed_bits(boxes) ^ number)) {}

  /// A normal number with mean 0 and variance 1, cut off. The sum of twelve uniform numbers (Irwin-Hall): additions
  /// have the same bits everywhere, which logarithms of the C library do not have.
  double normal(Quantity quantity) const { return normal(static_cast<std::uint64_t>(quantity)); }
  double normal(const MaterialName& material) const {
    return normal(static_cast<std::uint64_t>(Quantity::material) + hash_of(material));
  }
  /// Of mats, and of a pair of materials: by a word, and the key of the pair.
  double normal(const std::string& name) const { return normal(hash_of(name)); }

 private:
  double normal(std::uint64_t number) const {
    std::uint64_t state = mixed_bits(seed_ ^ number);
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      state = mixed_bits(state);
      sum += unit_number(state);
    }
    return std::clamp(sum, -kLargestDeviation, kLargestDeviation);
  }

  std::uint64_t seed_;
};

}  // namespace

std::uint64_t boxes_hash(const Layout& layout) {
  ByteHash hash;
  for (const Box& box : layout.boxes) {
    for (Vec3 corner : {box.corner_min, box.corner_max}) {
      corner += Vec3::Zero();  // −0 becomes 0: they are one place
      hash.add(corner.data(), 3 * sizeof(double));
    }
    const int material = box.material.id();
    hash.add(&material, sizeof material);
    if (!box.material.is_number()) hash.add(box.material.text().data(), box.material.text().size());
  }
  return hash.value();
}

ReplicaDraw draw_replica(const Layout& layout, std::uint64_t boxes, std::uint32_t number,
                         const ScreeningSettings& spreads, std::span<const FrictionTable::Row> pairs) {
  const Generator generator(boxes, number);
  const double friction = spreads.friction_spread;
  ReplicaDraw draw;
  // The coefficient of two boxes of one material is the square of its factor: mean 1, and the spread asked for.
  for (const Box& box : layout.boxes)
    if (!draw.materials.contains(box.material))
      draw.materials[box.material] = std::sqrt(1.0 + friction * generator.normal(box.material));
  // That of a box and the container has a quarter of its variance from the box, and three quarters from here.
  draw.container = 1.0 + std::sqrt(0.75) * friction * generator.normal(Quantity::container);
  draw.box_box = 1.0 + friction * generator.normal(Quantity::box_box);
  draw.box_floor = 1.0 + friction * generator.normal(Quantity::box_floor);
  draw.box_wall = 1.0 + friction * generator.normal(Quantity::box_wall);
  for (const FrictionTable::Row& row : pairs)
    draw.pairs[row.partners.text()] = 1.0 + friction * generator.normal("pair " + row.partners.text());
  draw.mats = 1.0 + friction * generator.normal(std::string("mats"));
  draw.acceleration = 1.0 + spreads.acceleration_spread * generator.normal(Quantity::acceleration);
  return draw;
}

void lower_friction(ReplicaDraw& draw, const ReplicaDraw& other) {
  for (auto& [material, factor] : draw.materials) factor = std::min(factor, other.materials.at(material));
  for (auto& [pair, factor] : draw.pairs) factor = std::min(factor, other.pairs.at(pair));
  draw.mats = std::min(draw.mats, other.mats);
  draw.container = std::min(draw.container, other.container);
  draw.box_box = std::min(draw.box_box, other.box_box);
  draw.box_floor = std::min(draw.box_floor, other.box_floor);
  draw.box_wall = std::min(draw.box_wall, other.box_wall);
}

Settings with_friction(const Settings& settings, const ReplicaDraw& draw) {
  Settings varied = settings;
  for (const auto& [material, factor] : draw.materials)
    varied.materials[material].friction = factor * friction_of(settings, material);
  varied.container.friction *= draw.container;
  varied.contact.box_box *= draw.box_box;
  varied.contact.box_floor *= draw.box_floor;
  varied.contact.box_wall *= draw.box_wall;
  for (const FrictionTable::Row& row : settings.contact.materials.rows())
    varied.contact.materials.set(row.partners, draw.pairs.at(row.partners.text()) * row.coefficient);
  varied.contact.mat_factor *= draw.mats;
  return varied;
}

}  // namespace holdfast::internal
