#include <algorithm>
#include <string>
#include <vector>

#include "api/guarded.hpp"
#include "core/model/setting_table.hpp"
#include "holdfast/holdfast.hpp"
#include "io/input/config_reader.hpp"

namespace holdfast {

using internal::guarded;
using internal::value_or_throw;

std::vector<Setting> read_settings(const std::string& text) {
  return guarded([&] {
    std::vector<internal::Error> ignored;
    const internal::TextFile file{.path = "config", .name = "config", .text = text};
    const internal::Config config = value_or_throw(internal::parse_config(file, ignored));
    std::vector<Setting> settings;
    for (const internal::PlacedSetting& placed : internal::placed_settings(config.settings))
      if (config.given.contains({placed.section, placed.name}))
        settings.push_back({placed.section, placed.name, placed.key->get(config.settings, placed.of)});
    // Pairs of any materials are no rows of the table: they are the three coefficients of [Contact].
    for (const auto& given : config.given) {
      const bool is_there = std::any_of(settings.begin(), settings.end(), [&](const Setting& setting) {
        return setting.section == given.first && setting.key == given.second;
      });
      if (is_there) continue;
      const internal::PlacedSetting placed = *internal::place_setting(given.first, given.second);
      settings.push_back({placed.section, placed.name, placed.key->get(config.settings, placed.of)});
    }
    return settings;
  });
}

}  // namespace holdfast
