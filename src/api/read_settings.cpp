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
    const auto add = [&](const std::string& section, const internal::SettingKey& key, int material) {
      if (!config.given.contains({section, std::string(key.name)})) return;
      settings.push_back({section, std::string(key.name), key.get(config.settings, material)});
    };
    for (const internal::SettingKey& key : internal::setting_table())
      if (key.section != internal::kMaterialSection) add(std::string(key.section), key, 0);
    for (const auto& [id, material] : config.settings.materials)
      for (const internal::SettingKey& key : internal::setting_table())
        if (key.section == internal::kMaterialSection) add("Material " + std::to_string(id), key, id);
    return settings;
  });
}

}  // namespace holdfast
