#include "app/validate/validation_files.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/export/csv_field.hpp"
#include "io/export/text_output.hpp"
#include "io/input/text_file.hpp"
#include "validate/laboratory/case.hpp"
#include "validate/laboratory/engine_settings.hpp"

namespace holdfast::internal {

namespace {

constexpr double kBoundFactor = 2.0;
constexpr double kBoundSlack = 1e-9;

auto key_of(const ValidationRow& row) {
  return std::tuple(row.engine, row.setting, row.case_name, row.measurement.metric);
}

double bound_of(const Measurement& measurement) {
  if (measurement.tolerance == ToleranceClass::verdict) return measurement.error;
  return kBoundFactor * measurement.error + kBoundSlack;
}

}  // namespace

Result<Bounds> read_bounds(const std::string& path) {
  const Result<TextFile> file = read_text_file(path);
  if (!file) return file.errors();
  Bounds bounds;
  long line_number = 0;
  for (std::size_t begin = 0; begin < file->text.size();) {
    const std::size_t end = std::min(file->text.find('\n', begin), file->text.size());
    const std::string line = file->text.substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> fields;
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t tab = std::min(line.find('\t', at), line.size());
      fields.push_back(line.substr(at, tab - at));
      at = tab + 1;
    }
    double bound = 0.0;
    const auto parsed = fields.size() == 5
                            ? std::from_chars(fields[4].data(), fields[4].data() + fields[4].size(), bound)
                            : std::from_chars_result{nullptr, std::errc::invalid_argument};
    if (parsed.ec != std::errc()) {
      return Error{.file = path,
                   .line = line_number,
                   .what = "not a bound",
                   .value = line,
                   .accepted = "engine, setting, case, metric and a number, separated by tabs"};
    }
    bounds[{fields[0], fields[1], fields[2], fields[3]}] = bound;
  }
  return bounds;
}

std::optional<Error> write_bounds(const std::string& path, std::span<const ValidationRow> rows) {
  std::string text = "# engine\tsetting\tcase\tmetric\tbound on the error\n";
  for (const ValidationRow& row : rows) {
    if (!has_bounds(row.engine, row.setting)) continue;
    text += fmt::format("{}\t{}\t{}\t{}\t{:.3g}\n", row.engine, row.setting, row.case_name, row.measurement.metric,
                        bound_of(row.measurement));
  }
  return write_text_file(path, text);
}

std::optional<Error> check_bounds_file(const std::string& path) {
  return check_output_file(path, [](const std::string& old) { return bool(read_bounds(old)); });
}

std::vector<ValidationRow> missed(std::span<const ValidationRow> rows, const Bounds& bounds) {
  std::vector<ValidationRow> above;
  for (const ValidationRow& row : rows) {
    if (!has_bounds(row.engine, row.setting)) continue;
    const auto bound = bounds.find(key_of(row));
    // A written bound has three digits.
    if (bound == bounds.end() || !(row.measurement.error <= bound->second * 1.005)) above.push_back(row);
  }
  return above;
}

std::string validation_json(std::span<const ValidationRow> rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ValidationRow& row : rows) {
    const Measurement& m = row.measurement;
    list.push_back({{"case", row.case_name},
                    {"suite", row.suite},
                    {"engine", row.engine},
                    {"setting", row.setting},
                    {"metric", m.metric},
                    {"value", m.value},
                    {"expected", m.expected},
                    {"error", m.error},
                    {"tolerance", tolerance_of(m.tolerance)},
                    {"pass", m.passes()},
                    {"cpu_seconds", row.cpu_seconds}});
  }
  return list.dump(1);
}

std::optional<Error> write_validation(const std::string& folder, std::span<const ValidationRow> rows,
                                      std::span<const SuiteCost> costs) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) return Error{.file = folder, .what = "cannot be created", .value = failure.message()};

  std::string measurements = "suite,case,engine,setting,metric,value,expected,error,tolerance,pass,cpu_seconds\n";
  for (const ValidationRow& row : rows) {
    const Measurement& m = row.measurement;
    measurements += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", row.suite, row.case_name, row.engine,
                                csv_field(row.setting), csv_field(m.metric), m.value, m.expected, m.error,
                                tolerance_of(m.tolerance), m.passes() ? 1 : 0, row.cpu_seconds);
  }
  std::string cost_table = "suite,engine,setting,cpu_seconds,box_seconds\n";
  for (const SuiteCost& cost : costs) {
    cost_table += fmt::format("{},{},{},{},{}\n", cost.suite, cost.engine, csv_field(cost.setting),
                              cost.cost.cpu_seconds, cost.cost.box_seconds);
  }
  std::string cases = "suite,case,question,trap\n";
  for (const Case& entry : all_cases())
    cases +=
        fmt::format("{},{},{},{}\n", entry.suite, entry.name, csv_field(entry.question), csv_field(entry.failure_mode));

  const std::filesystem::path base = folder;
  if (auto error = write_text_file(base / "measurements.csv", measurements)) return error;
  if (auto error = write_text_file(base / "costs.csv", cost_table)) return error;
  if (auto error = write_text_file(base / "cases.csv", cases)) return error;
  return write_text_file(base / "measurements.json", validation_json(rows) + "\n");
}

}  // namespace holdfast::internal
