#include "app/pages/accuracies_json.hpp"

#include <nlohmann/json.hpp>
#include <string_view>
#include <type_traits>

#include "core/model/setting_kinds.hpp"
#include "core/native/native_options.hpp"

namespace holdfast::internal {

namespace {

template <class Fields>
nlohmann::ordered_json fields_json(const Fields& fields) {
  nlohmann::ordered_json json;
  native::visit_fields(fields, [&]<class Value>(std::string_view name, const Value& value) {
    if constexpr (std::is_same_v<Value, native::Effort>)
      json[std::string(name)] = fields_json(value);
    else
      json[std::string(name)] = value;
  });
  return json;
}

}  // namespace

std::string accuracies_json() {
  nlohmann::ordered_json json;
  for (const auto& [word, accuracy] : setting_kinds::Accuracies::kWords) {
    Settings settings;
    settings.native.accuracy = accuracy;
    json[std::string(word)] = fields_json(native::native_options(settings));
  }
  return json.dump(2) + '\n';
}

}  // namespace holdfast::internal
