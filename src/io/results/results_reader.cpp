#include "io/results/results_reader.hpp"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <type_traits>
#include <utility>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_inputs.hpp"
#include "io/results/results_part.hpp"
#include "io/results/results_tables.hpp"

namespace holdfast::internal {

namespace {

/// The format version of the file. Fails unless it is a results file of a version that this program can read.
std::uint64_t check_format(const h5::File& file) {
  std::string format;
  try {
    format = h5::read_text_attribute(file, "/", "format");
  } catch (const h5::Failure&) {
    format.clear();
  }
  if (format != kFormatName) {
    throw h5::Failure(Error{.file = file.path(),
                            .what = "is not a results file",
                            .value = format,
                            .accepted = fmt::format("an HDF5 file with the attribute format = {}", kFormatName)});
  }
  const std::uint64_t version = h5::read_count_attribute(file, "/", "format_version");
  if (version > kFormatVersion) {
    throw h5::Failure(Error{.file = file.path(),
                            .what = "has a later format version than this program supports",
                            .value = std::to_string(version),
                            .accepted = fmt::format("up to {}", kFormatVersion)});
  }
  return version;
}

/// What an earlier version of the file does not say: NaN, and for counts and codes that of a new one.
template <class Entry>
Entry unknown() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  if constexpr (std::is_same_v<Entry, Float3>)
    return {kNan, kNan, kNan};
  else if constexpr (std::is_floating_point_v<Entry>)
    return std::numeric_limits<Entry>::quiet_NaN();
  else
    return Entry();
}

}  // namespace

struct ResultsReader::State {
  std::unique_ptr<h5::File> owned;  ///< absent if the file belongs to a writer
  const h5::File* file = nullptr;
  ResultsInfo info;
  AxisCounts before{};                               ///< entries of the run before those of the file
  std::map<std::string_view, h5::Dataset> datasets;  ///< kept open: their chunk caches are used for the next world

  const h5::Dataset& dataset(std::string_view path) {
    auto found = datasets.find(path);
    if (found != datasets.end()) return found->second;
    const DatasetSpec& spec = dataset_spec(path);  // whose path lasts
    return datasets.emplace(spec.path, h5::Dataset::open(*file, spec)).first->second;
  }

  std::vector<std::string> texts(std::string_view path, std::uint64_t begin, std::uint64_t count) {
    const h5::Dataset& column = dataset(path);
    return texts_of(column.read(begin, count), column.number_bytes());
  }

  template <class T>
  void read(std::string_view path, std::uint64_t begin, std::uint64_t count, std::vector<T>& values) {
    values = values_of<T>(dataset(path).read(begin, count));
  }

  /// Reads one dataset into that member of the rows, which stand for its entries from `begin` on.
  template <class Row, class Entry>
  void read_member(std::string_view path, std::uint64_t begin, Entry Row::*member, std::vector<Row>& rows) {
    std::vector<Entry> column;
    read(path, begin, rows.size(), column);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = column[i];
  }

  /// The same of a field; a file of an earlier version does not have all.
  template <class Row, class Entry>
  void read_field(const OutcomeField& field, std::uint64_t begin, Entry Row::*member, std::vector<Row>& rows) {
    if (field.since > info.version) {
      for (Row& row : rows) row.*member = unknown<Entry>();
      return;
    }
    if constexpr (std::is_same_v<Entry, std::string>) {
      const std::vector<std::string> column = texts(field.dataset, begin, rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = column[i];
    } else {
      read_member(field.dataset, begin, member, rows);
    }
  }

  void read_info() {
    info.version = check_format(*file);
    info.path = file->path();
    const auto text = [&](const char* name) { return h5::read_text_attribute(*file, "/", name); };
    info.software = text("software");
    info.git_commit = text("git_commit");
    info.engine = text("engine");
    info.command_line = text("command_line");
    info.created_utc = text("created_utc");
    info.host = text("host");
    info.fingerprint = text("fingerprint");
    // A file that is being assembled has all attributes except this one.
    if (H5Aexists(file->id(), "complete") > 0) info.complete = h5::read_count_attribute(*file, "/", "complete") != 0;
    info.thresholds = read_thresholds(*file);
    // Files of earlier versions have no such setting.
    if (h5::has_attribute(*file, "/inputs/settings", "Screening/Norm"))
      info.norm = h5::read_text_attribute(*file, "/inputs/settings", "Screening/Norm");
    info.analyses = tables_in(*file);
    before = read_range_begin(*file);
    info.world_begin = at(before, Axis::worlds);
    info.layout_begin = at(before, Axis::layouts);
    info.world_count = dataset("/worlds/layout").length();
    info.box_count = dataset("/boxes/world").length();
    info.layouts = texts("/inputs/layouts/name", 0, dataset("/inputs/layouts/name").length());
    info.accelerations = texts("/inputs/accelerations/name", 0, dataset("/inputs/accelerations/name").length());
  }
};

ResultsReader::ResultsReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
ResultsReader::ResultsReader(ResultsReader&&) noexcept = default;
ResultsReader& ResultsReader::operator=(ResultsReader&&) noexcept = default;
ResultsReader::~ResultsReader() = default;

std::string ResultsInfo::layout_name(std::uint64_t layout) const {
  const std::uint64_t i = layout - layout_begin;
  return layout >= layout_begin && i < layouts.size() ? layouts[i] : fmt::format("layout {}", layout);
}

std::string ResultsInfo::acceleration_name(std::uint64_t acceleration) const {
  return acceleration < accelerations.size() ? accelerations[acceleration]
                                             : fmt::format("acceleration {}", acceleration);
}

std::uint64_t results_calls_returned() { return h5::calls_returned(); }

const ResultsInfo& ResultsReader::info() const { return state_->info; }

Result<ResultsReader> ResultsReader::open(const std::string& path) {
  return h5::caught_result(path, [&] {
    auto state = std::make_unique<State>();
    state->owned = std::make_unique<h5::File>(h5::File::open(path));
    state->file = state->owned.get();
    state->read_info();
    return ResultsReader(std::move(state));
  });
}

Result<ResultsReader> ResultsReader::attach(const h5::File& file) {
  return h5::caught_result(file.path(), [&] {
    auto state = std::make_unique<State>();
    state->file = &file;
    state->read_info();
    return ResultsReader(std::move(state));
  });
}

Result<std::vector<WorldRow>> ResultsReader::worlds(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<WorldRow> rows(count);
    visit_world_row<WorldRow>(
        [&](const OutcomeField& field, auto member) { state_->read_field(field, begin, member, rows); });
    for (WorldRow& row : rows) {
      if (state_->info.version == 1) row.residual_scale = 1.0;
      row.box_begin -= at(state_->before, Axis::boxes);
      row.sample_begin -= at(state_->before, Axis::samples);
      row.row_begin -= at(state_->before, Axis::rows);
    }
    return rows;
  });
}

Result<std::vector<std::pair<std::string, std::string>>> ResultsReader::settings() const {
  return h5::caught_result(state_->file->path(), [&] { return read_settings(*state_->file); });
}

bool ResultsReader::has(std::string_view path) const { return h5::exists(*state_->file, std::string(path)); }

Result<std::vector<std::byte>> ResultsReader::stored(std::string_view path, std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] { return state_->dataset(path).read(begin, count); });
}

Result<EntryRange> ResultsReader::layout_boxes(std::uint64_t begin, std::size_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<std::uint64_t> begins;
    std::vector<std::uint32_t> counts;
    state_->read("/inputs/layouts/box_begin", begin, count, begins);
    state_->read("/inputs/layouts/box_count", begin, count, counts);
    return EntryRange{begins.empty() ? 0 : begins.front() - at(state_->before, Axis::layout_boxes),
                      {counts.begin(), counts.end()}};
  });
}

Result<BoxTable> ResultsReader::boxes(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    BoxTable table;
    visit_boxes([&](const DatasetContent& q, auto member) { state_->read(q.path, begin, count, table.*member); });
    return table;
  });
}

Result<EndTable> ResultsReader::ends(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    EndTable table;
    visit_ends<EndTable>([&](const OutcomeField& field, auto member) {
      if (field.since <= state_->info.version)
        state_->read(field.dataset, begin, count, table.*member);
      else
        (table.*member).assign(count, unknown<EntryOf<std::decay_t<decltype(table.*member)>>>());
    });
    return table;
  });
}

Result<Series> ResultsReader::series(const WorldRow& world) {
  return h5::caught_result(state_->file->path(), [&] {
    const std::uint64_t rows = std::uint64_t{world.sample_count} * world.boxes;
    Series series;
    const auto read = [&](const DatasetContent& q, auto member) {
      const bool of_samples = q.axis == Axis::samples;
      state_->read(q.path, of_samples ? world.sample_begin : world.row_begin, of_samples ? world.sample_count : rows,
                   series.*member);
    };
    visit_series(read);
    return series;
  });
}

}  // namespace holdfast::internal
