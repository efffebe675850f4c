#include "api/c_settings.hpp"

using namespace holdfast::internal;

int holdfast_settings_read(holdfast_settings* settings, const char* text) {
  return call_object<CSettings>(settings, [&](CSettings& object) {
    const std::vector<holdfast::Setting> read = holdfast::read_settings(required(text, "text"));
    object.settings.insert(object.settings.end(), read.begin(), read.end());
    return HOLDFAST_OK;
  });
}
