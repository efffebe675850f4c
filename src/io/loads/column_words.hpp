#pragma once

#include <array>
#include <string_view>

/// The words that people's tables have for what a load is made of: one table, for spreadsheets, planners' exports and
/// JSON alike. Words are compared without case, blanks and signs: `Pos X` is `posx`.
namespace holdfast::internal {

/// What a column says of a box, or of its load.
enum class ColumnKind {
  ignored,
  low,            ///< coordinate of the corner with the smallest coordinates, along an axis of the file
  high,           ///< the same of the corner with the largest
  middle,         ///< the same of the middle
  extent,         ///< extent along an axis of the file, as placed
  length,         ///< extent along the container's length as placed; the item's own where it has an orientation
  width,          ///< the same across the container
  height,         ///< the same upwards
  orientation,    ///< how the item is turned
  name,           ///< of the box
  material,       ///< by number or name
  mass,           ///< of the box
  mat,            ///< coefficient of friction on whatever the box stands on
  fixed,          ///< whether the box is part of the container
  order,          ///< when the box is loaded
  order_or_load,  ///< the load where it repeats, else when the box is loaded
  bearing_limit,  ///< most mass that may rest on the box
  nesting,        ///< how far the box sits in the one beneath it
  load,           ///< name of the load that the box belongs to
  container,      ///< type of the container
  type,           ///< kind of the row, type of the container, or material: its values tell
  status,         ///< whether the item is placed; without effect, since its place tells
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
    ColumnWord{"dim", ColumnKind::extent},
    ColumnWord{"dims", ColumnKind::extent},
    ColumnWord{"dimension", ColumnKind::extent},
    ColumnWord{"dimensions", ColumnKind::extent},
    ColumnWord{"placeddimensions", ColumnKind::extent},
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
    ColumnWord{"depth", ColumnKind::length, 1},
    ColumnWord{"d", ColumnKind::length, 1},
    ColumnWord{"width", ColumnKind::width},
    ColumnWord{"w", ColumnKind::width},
    ColumnWord{"boxwidth", ColumnKind::width},
    ColumnWord{"itemwidth", ColumnKind::width},
    ColumnWord{"breite", ColumnKind::width},
    ColumnWord{"breadth", ColumnKind::width},
    ColumnWord{"largeur", ColumnKind::width},
    ColumnWord{"height", ColumnKind::height},
    ColumnWord{"h", ColumnKind::height},
    ColumnWord{"boxheight", ColumnKind::height},
    ColumnWord{"itemheight", ColumnKind::height},
    ColumnWord{"hoehe", ColumnKind::height},
    ColumnWord{"hauteur", ColumnKind::height},

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
    ColumnWord{"article", ColumnKind::name, 2},
    ColumnWord{"product", ColumnKind::name, 2},
    ColumnWord{"cargo", ColumnKind::name, 2},
    ColumnWord{"box", ColumnKind::name, 2},
    ColumnWord{"goods", ColumnKind::name, 2},
    ColumnWord{"artikel", ColumnKind::name, 2},
    ColumnWord{"bezeichnung", ColumnKind::name, 2},
    ColumnWord{"sku", ColumnKind::name, 3},
    ColumnWord{"code", ColumnKind::name, 4},
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
    ColumnWord{"grossweight", ColumnKind::mass},
    ColumnWord{"itemweight", ColumnKind::mass},
    ColumnWord{"gewicht", ColumnKind::mass},
    ColumnWord{"masse", ColumnKind::mass},
    ColumnWord{"poids", ColumnKind::mass},
    ColumnWord{"wt", ColumnKind::mass},

    ColumnWord{"mat", ColumnKind::mat},
    ColumnWord{"antislipmat", ColumnKind::mat},
    ColumnWord{"frictionbelow", ColumnKind::mat},
    ColumnWord{"fixed", ColumnKind::fixed},
    ColumnWord{"blocked", ColumnKind::fixed},

    ColumnWord{"order", ColumnKind::order_or_load},
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
    ColumnWord{"unit", ColumnKind::load, 3},
    ColumnWord{"truck", ColumnKind::load, 3},
    ColumnWord{"vehicle", ColumnKind::load, 3},
    ColumnWord{"trailer", ColumnKind::load, 3},
    ColumnWord{"pallet", ColumnKind::load, 3},
    ColumnWord{"palletid", ColumnKind::load, 3},
    ColumnWord{"orderid", ColumnKind::load, 4},
    ColumnWord{"ordernumber", ColumnKind::load, 4},

    ColumnWord{"containertype", ColumnKind::container},
    ColumnWord{"bintype", ColumnKind::container},
    ColumnWord{"type", ColumnKind::type},
    ColumnWord{"kind", ColumnKind::type},
    ColumnWord{"status", ColumnKind::status},
    ColumnWord{"containerlength", ColumnKind::container_length},
    ColumnWord{"containerwidth", ColumnKind::container_width},
    ColumnWord{"containerheight", ColumnKind::container_height},
};

/// Words for the container itself: a row of that kind gives its size, and so do keys that stand above the boxes.
inline constexpr std::array kContainerWords = {
    std::string_view{"container"},  std::string_view{"bin"},    std::string_view{"truck"}, std::string_view{"trailer"},
    std::string_view{"vehicle"},    std::string_view{"pallet"}, std::string_view{"uld"},   std::string_view{"van"},
    std::string_view{"cargospace"}, std::string_view{"wagon"}};

/// Words for a row that is a box, in a column that tells kinds of rows.
inline constexpr std::array kBoxWords = {std::string_view{"item"},    std::string_view{"box"},
                                         std::string_view{"package"}, std::string_view{"case"},
                                         std::string_view{"unit"},    std::string_view{"cargo"}};

}  // namespace holdfast::internal
