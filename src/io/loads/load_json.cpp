#include "io/loads/load_json.hpp"

#include <charconv>
#include <cstddef>
#include <string_view>
#include <utility>

namespace holdfast::internal {

namespace {

/// An object or a list of JSON as it is written. Texts are UTF-8 without control characters, as `kept_name` makes them.
class JsonText {
 public:
  std::string take() { return std::move(text_); }
  void reserve(std::size_t bytes) { text_.reserve(bytes); }

  void begin(char bracket) {
    separate();
    text_ += bracket;
  }
  void end(char bracket) { text_ += bracket; }
  void key(std::string_view key) {
    separate();
    (text_ += '"') += key;
    text_ += "\":";
  }
  void number(double number) {
    separate();
    char digits[32];
    // JSON has integers, and of these there is no negative zero.
    const double written = number == 0.0 ? 0.0 : number;
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, written).ptr);
  }
  void number(long number) {
    separate();
    text_ += std::to_string(number);
  }
  void truth() {
    separate();
    text_ += "true";
  }
  void text(std::string_view text) {
    separate();
    text_ += '"';
    for (const char sign : text) {
      if (sign == '"' || sign == '\\') text_ += '\\';
      text_ += sign;
    }
    text_ += '"';
  }
  void vector(const Vec3& numbers) {
    begin('[');
    for (const double each : numbers) number(each);
    end(']');
  }

 private:
  /// A comma between one value and the next.
  void separate() {
    const char last = text_.empty() ? '{' : text_.back();
    if (last != '{' && last != '[' && last != ':') text_ += ',';
  }

  std::string text_;
};

void write_box(JsonText& json, const Box& box) {
  json.begin('{');
  json.key("corner_min");
  json.vector(box.corner_min);
  json.key("corner_max");
  json.vector(box.corner_max);
  const auto number = [&](const char* key, const auto& value) {
    if (!value) return;
    json.key(key);
    json.number(*value);
  };
  if (!box.name.empty()) {
    json.key("name");
    json.text(box.name);
  }
  json.key("material");
  if (box.material.is_number())
    json.number(static_cast<long>(box.material.id()));
  else
    json.text(box.material.text());
  number("mass", box.mass);
  if (box.centre_of_mass) {
    json.key("centre_of_mass");
    json.vector(*box.centre_of_mass);
  }
  number("mat", box.mat);
  if (box.fixed) {
    json.key("fixed");
    json.truth();
  }
  number("order", box.order);
  number("bearing_limit", box.bearing_limit);
  json.end('}');
}

void write_container(JsonText& json, const ContainerShape& shape) {
  json.begin('{');
  if (!shape.type.empty()) {
    json.key("type");
    json.text(shape.type);
  }
  json.key("size");
  json.vector(shape.size);
  json.key("open_sides");
  json.begin('[');
  for (const std::string& side : shape.open_sides) json.text(side);
  json.end(']');
  if (!shape.drop_sides.empty()) {
    json.key("drop_sides");
    json.begin('{');
    for (const DropSide& drop : shape.drop_sides) {
      json.key(drop.side);
      json.number(drop.height);
    }
    json.end('}');
  }
  json.key("bed_height");
  json.number(shape.bed_height);
  json.end('}');
}

std::string json_of(const Layout& load, bool with_name) {
  constexpr std::size_t kBytesOfBox = 150;
  JsonText json;
  json.reserve(kBytesOfBox * (load.boxes.size() + 2));
  json.begin('{');
  if (with_name) {
    json.key("name");
    json.text(load.name);
  }
  if (load.container) {
    json.key("container");
    write_container(json, *load.container);
  }
  json.key("boxes");
  json.begin('[');
  for (const Box& box : load.boxes) write_box(json, box);
  json.end(']');
  json.end('}');
  return json.take();
}

}  // namespace

std::string canonical_json(const Layout& load) { return json_of(load, false); }

std::string load_line(const Layout& load) { return json_of(load, true); }

}  // namespace holdfast::internal
