#include "app/bearing_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>

#include "analyses/bearing/bearing.hpp"
#include "app/screening.hpp"

namespace holdfast::internal {

namespace {

/// How many boxes are named in a warning.
constexpr std::size_t kNamed = 5;

std::string name_of(const Layout& layout, std::size_t i) {
  const std::string& name = layout.boxes[i].name;
  return name.empty() ? fmt::format("box {}", i + 1) : fmt::format("box {} ({})", i + 1, printable(name));
}

std::string names_of(const Layout& layout, const std::vector<std::size_t>& boxes) {
  std::string names;
  for (std::size_t k = 0; k < std::min(boxes.size(), kNamed); ++k)
    names += (k > 0 ? ", " : "") + name_of(layout, boxes[k]);
  if (boxes.size() > kNamed) names += fmt::format(" and {} more", boxes.size() - kNamed);
  return names;
}

/// A load in kg, as people read it: one decimal below 100.
std::string load_text(double load) {
  if (std::isnan(load)) return "?";
  return load < 99.95 ? fmt::format("{:.1f}", load) : fmt::format("{:.0f}", load);
}

std::string carries(const BearingRange& range, double limit) {
  const std::string least = load_text(range.least);
  const std::string largest = load_text(range.largest);
  return fmt::format("carries {} kg, limit {} kg", least == largest ? least : least + " to " + largest,
                     load_text(limit));
}

/// Boxes that carry more than their limit in a case, and the one that does so by the largest factor.
struct Overloads {
  std::size_t count = 0;
  std::size_t worst = 0;
  double factor = 0.0;

  void add(std::size_t i, double load, double limit) {
    const double of_limit = limit > 0 ? load / limit : std::numeric_limits<double>::infinity();
    if (count == 0 || of_limit > factor) {
      worst = i;
      factor = of_limit;
    }
    ++count;
  }
};

void compare_with_limits(BearingFindings& findings, const std::string& path, const Layout& layout,
                         const std::vector<BearingRange>& ranges) {
  std::size_t limits = 0;
  std::size_t unknown = 0;
  Overloads certain;
  Overloads possible;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const std::optional<double> limit = layout.boxes[i].bearing_limit;
    if (!limit) continue;
    ++limits;
    if (std::isnan(ranges[i].least) || std::isnan(ranges[i].largest))
      ++unknown;
    else if (ranges[i].least > *limit + kBearingTolerance)
      certain.add(i, ranges[i].least, *limit);
    else if (ranges[i].largest > *limit + kBearingTolerance)
      possible.add(i, ranges[i].largest, *limit);
  }
  if (limits == 0) return;
  const std::string of = fmt::format("of {}", counted(limits, "bearing limit"));
  const auto worst = [&](const Overloads& overloads) {
    const std::size_t i = overloads.worst;
    return fmt::format("the worst: {} {}", name_of(layout, i), carries(ranges[i], *layout.boxes[i].bearing_limit));
  };
  if (unknown > 0)
    findings.warnings.push_back(
        {.file = path, .what = fmt::format("{} {} not compared: the search for equilibria did not end", unknown, of)});
  if (certain.count > 0)
    findings.warnings.push_back(
        {.file = path,
         .what = fmt::format("{} {} exceeded, however the weight is shared; {}", certain.count, of, worst(certain))});
  if (possible.count > 0)
    findings.text += fmt::format("  {} {} possibly exceeded, depending on how the weight is shared; {}\n",
                                 possible.count, of, worst(possible));
  if (unknown + certain.count + possible.count == 0) findings.text += fmt::format("  none {} exceeded\n", of);
}

void name_those_that_cannot_stand(BearingFindings& findings, const std::string& path, const Layout& layout,
                                  const std::vector<BearingRange>& ranges) {
  std::vector<std::size_t> tipping;
  std::vector<std::size_t> unsupported;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i].footing == Footing::tips) tipping.push_back(i);
    if (ranges[i].footing == Footing::unsupported) unsupported.push_back(i);
  }
  const auto name = [&](const std::vector<std::size_t>& boxes, const char* what) {
    if (!boxes.empty())
      findings.warnings.push_back({.file = path, .what = fmt::format("{}: {}", what, names_of(layout, boxes))});
  };
  name(tipping, "vertical forces alone cannot balance these boxes, which count as held upright from the side");
  name(unsupported, "nothing is beneath these boxes, whose weight rests on none");
}

std::string table_of(const Layout& layout, const Settings& settings, const std::vector<BearingRange>& ranges) {
  std::size_t width = std::string_view("name").size();
  for (const Box& box : layout.boxes) width = std::max(width, printable(box.name).size());
  std::string table = fmt::format("  {:>6}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}\n", "box", "name", width, "mass",
                                  "least", "largest", "limit");
  const auto kilograms = [](double value) { return std::isnan(value) ? "?" : fmt::format("{:.2f}", value); };
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const Box& box = layout.boxes[i];
    const BoxProperties properties = properties_of(settings, box);
    fmt::format_to(std::back_inserter(table), "  {:>6}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}{}\n", i + 1,
                   printable(box.name), width, properties.fixed ? "fixed" : kilograms(properties.mass),
                   kilograms(ranges[i].least), kilograms(ranges[i].largest),
                   box.bearing_limit ? kilograms(*box.bearing_limit) : "-",
                   ranges[i].footing == Footing::tips          ? "  tips"
                   : ranges[i].footing == Footing::unsupported ? "  unsupported"
                                                               : "");
  }
  return table;
}

}  // namespace

BearingFindings find_bearing_of(const std::string& path, const Layout& layout, const Settings& settings, bool table) {
  BearingFindings findings;
  const bool limited = std::any_of(layout.boxes.begin(), layout.boxes.end(),
                                   [](const Box& box) { return box.bearing_limit.has_value(); });
  if (!limited && !table) return findings;
  const std::vector<BearingRange> ranges = find_bearing(layout, settings);
  compare_with_limits(findings, path, layout, ranges);
  name_those_that_cannot_stand(findings, path, layout, ranges);
  if (table)
    findings.text +=
        fmt::format("  {}: what rests on each box, kg\n{}", layout.name, table_of(layout, settings, ranges));
  return findings;
}

}  // namespace holdfast::internal
