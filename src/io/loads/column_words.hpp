#pragma once

#include <array>
#include <string_view>

/// The words that people's tables have for what a load is made of: one table, for spreadsheets, planners' exports and
/// JSON alike. Words are compared without case, blanks, signs and accents: `Pos X` is `posx`, `Länge` is `laenge`.
namespace holdfast::internal {

/// What a column says of a box, or of its load.
enum class ColumnKind {
  ignored,
  low,             ///< coordinate of the corner with the smallest coordinates, along an axis of the file
  high,            ///< the same of the corner with the largest
  middle,          ///< the same of the middle
  extent,          ///< extent along an axis of the file, as placed
  length,          ///< extent along the container's length as placed; the item's own where it has an orientation
  width,           ///< the same across the container
  height,          ///< the same upwards
  orientation,     ///< how the item is turned
  name,            ///< of the box
  material,        ///< by number or name
  mass,            ///< of the box
  mass_unit,       ///< of that mass
  mat,             ///< coefficient of friction on whatever the box stands on
  fixed,           ///< whether the box is part of the container
  order,           ///< when the box is loaded
  order_or_group,  ///< the same where it repeats, else when the box is loaded
  bearing_limit,   ///< most mass that may rest on the box
  nesting,         ///< how far the box sits in the one beneath it
  quantity,        ///< how many boxes a row is; a row with a place is one
  load,            ///< name of the load that the box belongs to, or of the container, whose type it may be
  group,           ///< the load where the boxes of its values overlap each other, else nothing
  container,       ///< type of the container
  type,            ///< kind of the row, type of the container, or material: its values tell
  status,          ///< whether the item is placed, where its place does not tell
  container_length,
  container_width,
  container_height,
};

/// A word for a kind of column. Of two columns of one kind the one of the smaller rank holds.
struct ColumnWord {
  std::string_view word;
  ColumnKind kind;
  int rank = 0;
};

/// Words that come with an axis of the file: before them as x, y or z, or after them as x, y, z, 0, 1 or 2.
inline constexpr std::array kAxisWords = {
    ColumnWord{"1", ColumnKind::low},
    ColumnWord{"min", ColumnKind::low},
    ColumnWord{"low", ColumnKind::low},
    ColumnWord{"start", ColumnKind::low},
    ColumnWord{"cornermin", ColumnKind::low},
    ColumnWord{"from", ColumnKind::low},
    ColumnWord{"2", ColumnKind::high},
    ColumnWord{"max", ColumnKind::high},
    ColumnWord{"high", ColumnKind::high},
    ColumnWord{"end", ColumnKind::high},
    ColumnWord{"cornermax", ColumnKind::high},
    ColumnWord{"to", ColumnKind::high},
    ColumnWord{"", ColumnKind::low, 1},
    ColumnWord{"pos", ColumnKind::low, 1},
    ColumnWord{"position", ColumnKind::low, 1},
    ColumnWord{"posicion", ColumnKind::low, 1},
    ColumnWord{"posizione", ColumnKind::low, 1},
    ColumnWord{"pozycja", ColumnKind::low, 1},
    ColumnWord{"poz", ColumnKind::low, 1},
    ColumnWord{"coord", ColumnKind::low, 1},
    ColumnWord{"coordinate", ColumnKind::low, 1},
    ColumnWord{"coordinates", ColumnKind::low, 1},
    ColumnWord{"flb", ColumnKind::low, 1},
    ColumnWord{"flbcoordinates", ColumnKind::low, 1},
    ColumnWord{"origin", ColumnKind::low, 1},
    ColumnWord{"corner", ColumnKind::low, 1},
    ColumnWord{"location", ColumnKind::low, 1},
    ColumnWord{"place", ColumnKind::low, 1},
    ColumnWord{"offset", ColumnKind::low, 1},
    ColumnWord{"center", ColumnKind::middle},
    ColumnWord{"centre", ColumnKind::middle},
    ColumnWord{"c", ColumnKind::middle},
    ColumnWord{"middle", ColumnKind::middle},
    ColumnWord{"centroid", ColumnKind::middle},
    ColumnWord{"d", ColumnKind::extent},
    ColumnWord{"l", ColumnKind::extent},
    ColumnWord{"s", ColumnKind::extent},
    ColumnWord{"size", ColumnKind::extent},
    ColumnWord{"dim", ColumnKind::extent, 1},
    ColumnWord{"dims", ColumnKind::extent, 1},
    ColumnWord{"dimension", ColumnKind::extent},
    ColumnWord{"dimensions", ColumnKind::extent},
    ColumnWord{"placeddimensions", ColumnKind::extent},
    ColumnWord{"packdim", ColumnKind::extent},
    ColumnWord{"packeddim", ColumnKind::extent},
    ColumnWord{"extent", ColumnKind::extent},
    ColumnWord{"length", ColumnKind::extent},
};

inline constexpr std::array kPlainWords = {
    ColumnWord{"length", ColumnKind::length},
    ColumnWord{"len", ColumnKind::length},
    ColumnWord{"l", ColumnKind::length},
    ColumnWord{"boxlength", ColumnKind::length},
    ColumnWord{"itemlength", ColumnKind::length},
    ColumnWord{"laenge", ColumnKind::length},
    ColumnWord{"longueur", ColumnKind::length},
    ColumnWord{"largo", ColumnKind::length},
    ColumnWord{"longitud", ColumnKind::length},
    ColumnWord{"lunghezza", ColumnKind::length},
    ColumnWord{"comprimento", ColumnKind::length},
    ColumnWord{"dlugosc", ColumnKind::length},
    ColumnWord{"delka", ColumnKind::length},
    ColumnWord{"lengte", ColumnKind::length},
    ColumnWord{"длина", ColumnKind::length},
    ColumnWord{"长", ColumnKind::length},
    ColumnWord{"長", ColumnKind::length},
    ColumnWord{"长度", ColumnKind::length},
    ColumnWord{"depth", ColumnKind::length, 1},
    ColumnWord{"d", ColumnKind::length, 1},
    ColumnWord{"width", ColumnKind::width},
    ColumnWord{"w", ColumnKind::width},
    ColumnWord{"boxwidth", ColumnKind::width},
    ColumnWord{"itemwidth", ColumnKind::width},
    ColumnWord{"breite", ColumnKind::width},
    ColumnWord{"breadth", ColumnKind::width},
    ColumnWord{"largeur", ColumnKind::width},
    ColumnWord{"ancho", ColumnKind::width},
    ColumnWord{"anchura", ColumnKind::width},
    ColumnWord{"larghezza", ColumnKind::width},
    ColumnWord{"largura", ColumnKind::width},
    ColumnWord{"szerokosc", ColumnKind::width},
    ColumnWord{"sirka", ColumnKind::width},
    ColumnWord{"breedte", ColumnKind::width},
    ColumnWord{"ширина", ColumnKind::width},
    ColumnWord{"宽", ColumnKind::width},
    ColumnWord{"寬", ColumnKind::width},
    ColumnWord{"宽度", ColumnKind::width},
    ColumnWord{"b", ColumnKind::width, 1},
    ColumnWord{"height", ColumnKind::height},
    ColumnWord{"h", ColumnKind::height},
    ColumnWord{"boxheight", ColumnKind::height},
    ColumnWord{"itemheight", ColumnKind::height},
    ColumnWord{"hoehe", ColumnKind::height},
    ColumnWord{"hauteur", ColumnKind::height},
    ColumnWord{"alto", ColumnKind::height},
    ColumnWord{"altura", ColumnKind::height},
    ColumnWord{"altezza", ColumnKind::height},
    ColumnWord{"wysokosc", ColumnKind::height},
    ColumnWord{"vyska", ColumnKind::height},
    ColumnWord{"hoogte", ColumnKind::height},
    ColumnWord{"высота", ColumnKind::height},
    ColumnWord{"高", ColumnKind::height},
    ColumnWord{"高度", ColumnKind::height},

    ColumnWord{"orientation", ColumnKind::orientation},
    ColumnWord{"orientationcode", ColumnKind::orientation},
    ColumnWord{"rotation", ColumnKind::orientation},
    ColumnWord{"rotationtype", ColumnKind::orientation},

    ColumnWord{"name", ColumnKind::name},
    ColumnWord{"itemname", ColumnKind::name},
    ColumnWord{"boxname", ColumnKind::name},
    ColumnWord{"item", ColumnKind::name, 1},
    ColumnWord{"label", ColumnKind::name, 1},
    ColumnWord{"description", ColumnKind::name, 2},
    ColumnWord{"itemdescription", ColumnKind::name, 2},
    ColumnWord{"productname", ColumnKind::name, 2},
    ColumnWord{"cargoname", ColumnKind::name, 2},
    ColumnWord{"cargoid", ColumnKind::name, 5},
    ColumnWord{"货物名称", ColumnKind::name, 2},
    ColumnWord{"nazwa", ColumnKind::name, 2},
    ColumnWord{"nombre", ColumnKind::name, 2},
    ColumnWord{"nome", ColumnKind::name, 2},
    ColumnWord{"nom", ColumnKind::name, 2},
    ColumnWord{"designation", ColumnKind::name, 2},
    ColumnWord{"наименование", ColumnKind::name, 2},
    ColumnWord{"название", ColumnKind::name, 2},
    ColumnWord{"名称", ColumnKind::name, 2},
    ColumnWord{"品名", ColumnKind::name, 2},
    ColumnWord{"货名", ColumnKind::name, 2},
    ColumnWord{"article", ColumnKind::name, 2},
    ColumnWord{"product", ColumnKind::name, 2},
    ColumnWord{"cargo", ColumnKind::name, 2},
    ColumnWord{"box", ColumnKind::name, 2},
    ColumnWord{"goods", ColumnKind::name, 2},
    ColumnWord{"artikel", ColumnKind::name, 2},
    ColumnWord{"bezeichnung", ColumnKind::name, 2},
    ColumnWord{"sku", ColumnKind::name, 3},
    ColumnWord{"code", ColumnKind::name, 4},
    ColumnWord{"itemcode", ColumnKind::name, 4},
    ColumnWord{"id", ColumnKind::name, 5},
    ColumnWord{"itemid", ColumnKind::name, 5},
    ColumnWord{"boxid", ColumnKind::name, 5},
    ColumnWord{"partno", ColumnKind::name, 5},
    ColumnWord{"number", ColumnKind::name, 6},
    ColumnWord{"no", ColumnKind::name, 6},

    ColumnWord{"material", ColumnKind::material},
    ColumnWord{"packaging", ColumnKind::material, 1},
    ColumnWord{"package", ColumnKind::material, 1},
    ColumnWord{"surface", ColumnKind::material, 2},

    ColumnWord{"mass", ColumnKind::mass},
    ColumnWord{"weight", ColumnKind::mass},
    ColumnWord{"grossweight", ColumnKind::mass, -1},
    ColumnWord{"bruttogewicht", ColumnKind::mass, -1},
    ColumnWord{"itemweight", ColumnKind::mass},
    ColumnWord{"gewicht", ColumnKind::mass},
    ColumnWord{"masse", ColumnKind::mass},
    ColumnWord{"poids", ColumnKind::mass},
    ColumnWord{"wt", ColumnKind::mass},
    ColumnWord{"gw", ColumnKind::mass, -1},
    ColumnWord{"nw", ColumnKind::mass, 1},
    ColumnWord{"weightunit", ColumnKind::mass_unit},
    ColumnWord{"massunit", ColumnKind::mass_unit},
    ColumnWord{"вес", ColumnKind::mass},
    ColumnWord{"масса", ColumnKind::mass},
    ColumnWord{"重量", ColumnKind::mass},
    ColumnWord{"毛重", ColumnKind::mass, -1},
    ColumnWord{"净重", ColumnKind::mass, 1},
    ColumnWord{"kg", ColumnKind::mass, 2},
    ColumnWord{"kgs", ColumnKind::mass, 2},

    ColumnWord{"mat", ColumnKind::mat},
    ColumnWord{"antislipmat", ColumnKind::mat},
    ColumnWord{"frictionbelow", ColumnKind::mat},
    ColumnWord{"friction", ColumnKind::mat, 1},
    ColumnWord{"frictioncoefficient", ColumnKind::mat, 1},
    ColumnWord{"coefficientoffriction", ColumnKind::mat, 1},
    ColumnWord{"mu", ColumnKind::mat, 1},
    ColumnWord{"reibbeiwert", ColumnKind::mat, 1},
    ColumnWord{"reibungskoeffizient", ColumnKind::mat, 1},
    ColumnWord{"fixed", ColumnKind::fixed},
    ColumnWord{"blocked", ColumnKind::fixed},

    ColumnWord{"order", ColumnKind::order_or_group},
    ColumnWord{"sequence", ColumnKind::order},
    ColumnWord{"seq", ColumnKind::order},
    ColumnWord{"step", ColumnKind::order},
    ColumnWord{"loadingorder", ColumnKind::order},
    ColumnWord{"loadorder", ColumnKind::order},

    ColumnWord{"bearinglimit", ColumnKind::bearing_limit},
    ColumnWord{"loadbearing", ColumnKind::bearing_limit},
    ColumnWord{"maxload", ColumnKind::bearing_limit},
    ColumnWord{"maxloadontop", ColumnKind::bearing_limit},
    ColumnWord{"maxweightontop", ColumnKind::bearing_limit},
    ColumnWord{"nesting", ColumnKind::nesting},
    ColumnWord{"nestingheight", ColumnKind::nesting},

    ColumnWord{"load", ColumnKind::load},
    ColumnWord{"loadname", ColumnKind::load},
    ColumnWord{"bin", ColumnKind::load, 1},
    ColumnWord{"binid", ColumnKind::load, 1},
    ColumnWord{"container", ColumnKind::load, 2},
    ColumnWord{"containerid", ColumnKind::load, 2},
    ColumnWord{"truck", ColumnKind::load, 3},
    ColumnWord{"vehicle", ColumnKind::load, 3},
    ColumnWord{"trailer", ColumnKind::load, 3},
    ColumnWord{"lorry", ColumnKind::load, 3},
    ColumnWord{"lkw", ColumnKind::load, 3},
    ColumnWord{"fahrzeug", ColumnKind::load, 3},
    ColumnWord{"tour", ColumnKind::load, 3},
    ColumnWord{"trip", ColumnKind::load, 3},
    ColumnWord{"truckno", ColumnKind::load, 4},
    ColumnWord{"truckid", ColumnKind::load, 4},
    ColumnWord{"containerno", ColumnKind::load, 4},
    ColumnWord{"containernumber", ColumnKind::load, 4},
    ColumnWord{"vehicleid", ColumnKind::load, 4},
    ColumnWord{"vehicleno", ColumnKind::load, 4},
    ColumnWord{"trailerno", ColumnKind::load, 4},
    ColumnWord{"loadno", ColumnKind::load, 4},
    ColumnWord{"loadid", ColumnKind::load, 4},
    ColumnWord{"unit", ColumnKind::group},
    ColumnWord{"pallet", ColumnKind::group, 1},
    ColumnWord{"palletid", ColumnKind::group, 1},
    ColumnWord{"orderid", ColumnKind::group, 2},
    ColumnWord{"ordernumber", ColumnKind::group, 2},

    ColumnWord{"quantity", ColumnKind::quantity},
    ColumnWord{"qty", ColumnKind::quantity},
    ColumnWord{"copies", ColumnKind::quantity},
    ColumnWord{"count", ColumnKind::quantity},
    ColumnWord{"pcs", ColumnKind::quantity},
    ColumnWord{"pieces", ColumnKind::quantity},
    ColumnWord{"menge", ColumnKind::quantity},
    ColumnWord{"anzahl", ColumnKind::quantity},
    ColumnWord{"stueck", ColumnKind::quantity},
    ColumnWord{"cantidad", ColumnKind::quantity},
    ColumnWord{"quantite", ColumnKind::quantity},
    ColumnWord{"ilosc", ColumnKind::quantity},
    ColumnWord{"количество", ColumnKind::quantity},
    ColumnWord{"数量", ColumnKind::quantity},

    ColumnWord{"containertype", ColumnKind::container},
    ColumnWord{"bintype", ColumnKind::container},
    ColumnWord{"type", ColumnKind::type},
    ColumnWord{"kind", ColumnKind::type},
    ColumnWord{"status", ColumnKind::status},
    ColumnWord{"placed", ColumnKind::status, 1},
    ColumnWord{"packed", ColumnKind::status, 1},
    ColumnWord{"ispacked", ColumnKind::status, 1},
    ColumnWord{"isplaced", ColumnKind::status, 1},
    ColumnWord{"containerlength", ColumnKind::container_length},
    ColumnWord{"containerwidth", ColumnKind::container_width},
    ColumnWord{"containerheight", ColumnKind::container_height},
};

/// Ends of words that tell a mass where no header of them is known: `Total weight`, `Bruttogewicht`.
inline constexpr std::array kMassStems = {std::string_view{"weight"}, std::string_view{"gewicht"},
                                          std::string_view{"poids"},  std::string_view{"peso"},
                                          std::string_view{"waga"},   std::string_view{"вес"}};
/// Parts of a header that is none of a box's own mass.
inline constexpr std::array kNoMassStems = {
    std::string_view{"max"},   std::string_view{"limit"},  std::string_view{"top"},     std::string_view{"above"},
    std::string_view{"volum"}, std::string_view{"empty"},  std::string_view{"tar"},     std::string_view{"share"},
    std::string_view{"bear"},  std::string_view{"capac"},  std::string_view{"leer"},    std::string_view{"trag"},
    std::string_view{"stack"}, std::string_view{"stapel"}, std::string_view{"auflast"}, std::string_view{"perm"},
    std::string_view{"admis"}, std::string_view{"zul"},    std::string_view{"nutz"},    std::string_view{"co2"},
    std::string_view{"price"}, std::string_view{"preis"},  std::string_view{"prec"},    std::string_view{"value"},
    std::string_view{"cost"},  std::string_view{"class"},  std::string_view{"layer"},   std::string_view{"order"},
    std::string_view{"rate"},  std::string_view{"percent"}};
/// Parts of a header of the mass that counts, whatever else is said; and of one that does only where there is none.
inline constexpr std::array kGrossStems = {std::string_view{"gross"}, std::string_view{"brutto"},
                                           std::string_view{"brut"}};
inline constexpr std::array kNetStems = {std::string_view{"net"}, std::string_view{"total"},
                                         std::string_view{"gesamt"}};

/// Words for the container itself: a row of that kind gives its size, and so do keys that stand above the boxes.
inline constexpr std::array kContainerWords = {
    std::string_view{"container"}, std::string_view{"bin"},      std::string_view{"truck"},
    std::string_view{"trailer"},   std::string_view{"vehicle"},  std::string_view{"pallet"},
    std::string_view{"uld"},       std::string_view{"van"},      std::string_view{"cargospace"},
    std::string_view{"wagon"},     std::string_view{"equipment"}};

/// Names of rows that sum up the others.
inline constexpr std::array kSumWords = {
    std::string_view{"total"},  std::string_view{"totals"}, std::string_view{"sum"},  std::string_view{"summe"},
    std::string_view{"gesamt"}, std::string_view{"итого"},  std::string_view{"合计"}, std::string_view{"razem"}};

/// What a status says of an item that is not placed.
inline constexpr std::array kUnplacedWords = {
    std::string_view{"unplaced"},  std::string_view{"notplaced"}, std::string_view{"unpacked"},
    std::string_view{"notpacked"}, std::string_view{"unloaded"},  std::string_view{"notloaded"},
    std::string_view{"false"},     std::string_view{"no"},        std::string_view{"unfitted"},
    std::string_view{"leftover"},  std::string_view{"rejected"},  std::string_view{"cancelled"},
    std::string_view{"nein"},      std::string_view{"non"},       std::string_view{"n"},
    std::string_view{"0"}};

/// Words for a row that is a box, in a column that tells kinds of rows.
inline constexpr std::array kBoxWords = {std::string_view{"item"},    std::string_view{"box"},
                                         std::string_view{"package"}, std::string_view{"case"},
                                         std::string_view{"unit"},    std::string_view{"cargo"}};

}  // namespace holdfast::internal
