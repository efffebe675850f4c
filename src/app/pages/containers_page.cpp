#include "app/pages/containers_page.hpp"

#include <string_view>

#include "core/base/number_text.hpp"
#include "core/model/container_catalogue.hpp"

namespace holdfast::internal {

namespace {

std::string size_text(const ContainerType& type) {
  const std::string height =
      type.open_sides.find("roof") == std::string_view::npos ? " x " + rounded_text(type.height) : "";
  return rounded_text(type.length) + " x " + rounded_text(type.width) + height;
}

std::string sides_text(const ContainerType& type) {
  if (type.open_sides.empty()) return "walls";
  return type.open_sides.find("front") == std::string_view::npos ? "curtains left and right, which hold nothing"
                                                                 : "all open";
}

}  // namespace

std::string containers_page() {
  std::string page = R"(# Containers

<!-- Written by `holdfast --containers-page`; the catalogue is src/core/model/container_catalogue.cpp. -->

`--container 40hc`, `[Container] Type = 40hc` and the container column of a table take these names, whatever their case
and signs: `40' HC` is `40hc`. Inner sizes of the same type differ by a centimetre or two from maker to maker; Length,
Width and Height say others. Without a type the container is 587 cm x 233 cm x 220 cm, as StableCargo's.

A curtain is not taken to hold anything: its side is open. A load on a pallet has no walls, and its floor is 15 cm above
the ground.

| Name | What | Inner size, m | Payload, kg | Sides | Source |
| --- | --- | --- | --- | --- | --- |
)";
  for (const ContainerType& type : container_catalogue())
    page += "| `" + std::string(type.name) + "` | " + std::string(type.what) + " | " + size_text(type) + " | " +
            rounded_text(type.payload) + " | " + sides_text(type) + " | " + std::string(type.source) + " |\n";
  return page;
}

std::string containers_text() {
  std::string text;
  for (const ContainerType& type : container_catalogue()) {
    std::string line = std::string(type.name);
    line.resize(18, ' ');
    line += size_text(type) + " m";
    line.resize(44, ' ');
    line += rounded_text(type.payload) + " kg";
    line.resize(56, ' ');
    text += line + std::string(type.what) + '\n';
  }
  return text;
}

}  // namespace holdfast::internal
