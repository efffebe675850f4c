#include "api/c_settings.hpp"

#include "api/apply_settings.hpp"

using namespace holdfast::internal;

holdfast_settings* holdfast_settings_new() {
  holdfast_settings* settings = nullptr;
  make_object<CSettings>(&settings, [](CSettings&) { return HOLDFAST_OK; });
  return settings;
}

void holdfast_settings_free(holdfast_settings* settings) {
  Handles<holdfast_settings, CSettings>::all().remove(settings);
}

int holdfast_settings_set(holdfast_settings* settings, const char* section, const char* key, const char* value) {
  return call_object<CSettings>(settings, [&](CSettings& object) {
    object.settings.push_back(
        main_spelling({required(section, "section"), required(key, "key"), required(value, "value")}));
    return HOLDFAST_OK;
  });
}

const char* holdfast_settings_message(const holdfast_settings* settings) { return message_of<CSettings>(settings); }
