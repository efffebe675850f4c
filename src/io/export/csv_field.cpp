#include "io/export/csv_field.hpp"

namespace holdfast::internal {

std::string csv_field(const std::string& text) {
  // A spreadsheet takes a text that begins so for a formula, and may run it: an apostrophe makes it a text.
  const bool is_formula = text.find_first_of("=+-@\t\r") == 0;
  if (!is_formula && text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = is_formula ? "\"'" : "\"";
  for (const char letter : text) field += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return field + '"';
}

std::string csv_heading(const OutcomeField& field) {
  const std::string label(field.label);
  if (field.type != "vec3") return label;
  const std::size_t unit = label.rfind('_');
  std::string headings;
  for (const char axis : {'x', 'y', 'z'})
    headings += (headings.empty() ? "" : ",") + label.substr(0, unit) + '_' + axis + label.substr(unit);
  return headings;
}

}  // namespace holdfast::internal
