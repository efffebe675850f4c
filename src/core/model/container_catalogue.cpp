#include "core/model/container_catalogue.hpp"

#include <algorithm>
#include <array>

namespace holdfast::internal {

namespace {

constexpr std::string_view kIso = "ISO 668 sizes; inside as shipping lines publish it for steel containers";
constexpr std::string_view kReefer = "ISO 668 sizes; inside as shipping lines publish it for integral reefers";
constexpr std::string_view kTrailer =
    "33 pallets of 1.2 m x 0.8 m (EN 13698-1) on 34 pallet places; hauliers publish 2.48 m x 2.7 m";
constexpr std::string_view kSwap = "EN 284, class C; inside as makers publish it";
constexpr std::string_view kVan = "typical of vans of 3.5 t, between the sides above the wheel arches";
constexpr std::string_view kEuroPallet = "EN 13698-1; its height is that of the load";
constexpr std::string_view kIndustryPallet = "EN 13698-2; its height is that of the load";

constexpr std::string_view kClosed = "";
constexpr std::string_view kCurtains = "left right";  // a curtain is not taken to hold anything
constexpr std::string_view kFlat = "front rear left right roof";

// Name, aliases, words, inner length, width, height (m), payload (kg), open sides, bed (m), source.
constexpr std::array kTypes = {
    ContainerType{"20", "20ft 20gp 20dc 20dv 20std 20st 20foot 22g1 22g0 20box c20 20standard", "20' container", 5.898,
                  2.352, 2.393, 28'200, kClosed, 1.2, kIso},
    ContainerType{"40", "40ft 40gp 40dc 40dv 40std 40st 40foot 42g1 42g0 40standard", "40' container", 12.032, 2.352,
                  2.393, 26'700, kClosed, 1.2, kIso},
    ContainerType{"40hc", "40hq 40ch 40highcube 40fthc 40fthighcube 45g1 45g0 40fthq 40footHC",
                  "40' high cube container", 12.032, 2.352, 2.698, 26'500, kClosed, 1.2, kIso},
    ContainerType{"45hc", "45hq 45 45ft 45highcube 45fthc 45fthighcube l5g1 l5g0 45fthq", "45' high cube container",
                  13.556, 2.352, 2.698, 27'700, kClosed, 1.2, kIso},
    ContainerType{"20rf", "20reefer 20ftreefer 20re 22r1", "20' reefer", 5.44, 2.29, 2.27, 27'400, kClosed, 1.2,
                  kReefer},
    ContainerType{"40hcrf", "40reefer 40rh 40hr 40rehc 40ftreefer 40hcreefer 45r1", "40' high cube reefer", 11.58, 2.29,
                  2.54, 29'500, kClosed, 1.2, kReefer},
    ContainerType{"trailer-curtain", "trailer semitrailer curtainsider tautliner mega136 136curtain",
                  "13.6 m semi-trailer with curtains", 13.6, 2.48, 2.7, 25'000, kCurtains, 1.2, kTrailer},
    ContainerType{"trailer-box", "boxtrailer 136box semitrailerbox", "13.6 m semi-trailer with walls", 13.6, 2.48, 2.7,
                  24'500, kClosed, 1.2, kTrailer},
    ContainerType{"swap-c745", "swapbody c745 wab745", "swap body of 7.45 m with walls", 7.3, 2.44, 2.48, 13'000,
                  kClosed, 1.2, kSwap},
    ContainerType{"swap-c782", "c782 wab782", "swap body of 7.82 m with walls", 7.67, 2.44, 2.48, 13'000, kClosed, 1.2,
                  kSwap},
    ContainerType{"van", "sprinter panelvan", "van of medium length with a high roof", 3.27, 1.78, 2.0, 1'200, kClosed,
                  0.7, kVan},
    ContainerType{"pallet-1200x800", "europallet eur1 epal pallet1200800 pallet", "pallet of 1.2 m x 0.8 m", 1.2, 0.8,
                  2.0, 1'500, kFlat, 0.15, kEuroPallet},
    ContainerType{"pallet-1200x1000", "eur2 eur3 industrypallet pallet12001000", "pallet of 1.2 m x 1 m", 1.2, 1.0, 2.0,
                  1'500, kFlat, 0.15, kIndustryPallet},
};

std::string letters_and_digits(std::string_view text) {
  std::string kept;
  for (const char letter : text) {
    if (letter >= 'A' && letter <= 'Z') kept += static_cast<char>(letter - 'A' + 'a');
    if ((letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9')) kept += letter;
  }
  return kept;
}

/// Calls `visit` for each word between blanks.
template <class Visit>
void for_each_word(std::string_view words, Visit visit) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (end > 0) visit(words.substr(0, end));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
}

}  // namespace

ContainerShape ContainerType::shape() const {
  ContainerShape shape;
  shape.type = name;
  shape.size = {length, width, height};
  for_each_word(open_sides, [&](std::string_view side) { shape.open_sides.emplace_back(side); });
  shape.bed_height = bed_height;
  return shape;
}

std::span<const ContainerType> container_catalogue() { return kTypes; }

const ContainerType* find_container(std::string_view name) {
  const std::string wanted = letters_and_digits(name);
  if (wanted.empty()) return nullptr;
  for (const ContainerType& type : kTypes) {
    bool found = letters_and_digits(type.name) == wanted;
    for_each_word(type.aliases, [&](std::string_view alias) { found = found || letters_and_digits(alias) == wanted; });
    if (found) return &type;
  }
  return nullptr;
}

}  // namespace holdfast::internal
