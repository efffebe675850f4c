#include "analyses/indicators/indicators.hpp"

#include <utility>
#include <vector>

#include "api/guarded.hpp"
#include "api/screen_state.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast {

namespace {

LayoutIndicators public_indicators(internal::LayoutIndicators&& found) {
  const auto array = [](const internal::Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  return {.centre_of_gravity = array(found.centre_of_gravity),
          .centre_offset = array(found.centre_offset),
          .fill = found.fill,
          .badly_based = found.badly_based,
          .badly_braced = found.badly_braced,
          .base_support = std::move(found.base_support),
          .supported_sides = std::move(found.supported_sides)};
}

std::vector<LayoutIndicators> indicators_of(const std::vector<internal::ReadLayout>& layouts,
                                            const internal::Settings& settings) {
  std::vector<LayoutIndicators> indicators;
  for (const internal::ReadLayout& layout : layouts)
    indicators.push_back(public_indicators(internal::find_indicators(layout.layout, settings)));
  return indicators;
}

}  // namespace

std::vector<LayoutIndicators> Screen::indicators(std::span<const Layout> layouts) {
  return internal::guarded([&] { return indicators_of(state_->read(layouts), state_->settings); });
}

std::vector<LayoutIndicators> Screen::indicators(std::span<const LayoutView> layouts) {
  return internal::guarded([&] { return indicators_of(state_->read(layouts), state_->settings); });
}

}  // namespace holdfast
