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
    return settings;
  });
}

}  // namespace holdfast
