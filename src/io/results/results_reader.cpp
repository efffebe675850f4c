#include "io/results/results_reader.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_inputs.hpp"
#include "io/results/results_part.hpp"

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

/// Whether a file of that version has the dataset.
bool has_dataset(std::uint64_t version, std::string_view path) {
  return version > 1 || path != "/worlds/residual_scale";
}

}  // namespace

struct ResultsReader::State {
  std::unique_ptr<h5::File> owned;  ///< absent if the file belongs to a writer
  const h5::File* file = nullptr;
  std::uint64_t version = kFormatVersion;
  ResultsInfo info;
  AxisCounts before{};                               ///< entries of the run before those of the file
  std::map<std::string_view, h5::Dataset> datasets;  ///< kept open: their chunk caches are used for the next world

  const h5::Dataset& dataset(std::string_view path) {
    auto found = datasets.find(path);
    if (found == datasets.end()) found = datasets.emplace(path, h5::Dataset::open(*file, dataset_spec(path))).first;
    return found->second;
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

  void read_info() {
    version = check_format(*file);
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
    info.has_margins = h5::exists(*file, "/margins");
    info.has_margin_spread = h5::exists(*file, "/margin_spread");
    info.has_walls = h5::exists(*file, "/walls");
    info.has_replicas = h5::exists(*file, "/replicas");
    info.has_damage = h5::exists(*file, "/damage");
    info.has_indicators = h5::exists(*file, "/indicators");
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
    std::map<std::string_view, std::vector<std::byte>> columns;
    WorldRow none;
    visit_world(
        [&](std::string_view path, auto&) {
          if (has_dataset(state_->version, path)) columns[path] = state_->dataset(path).read(begin, count);
        },
        none);
    std::vector<WorldRow> rows(count);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto take = [&]<class T>(std::string_view path, T& member) {
        if (!has_dataset(state_->version, path)) return;
        const std::size_t size = state_->dataset(path).entry_bytes();
        const auto entry = std::span<const std::byte>(columns.at(path)).subspan(i * size, size);
        if constexpr (std::is_same_v<T, std::string>) {
          member = texts_of(entry, size).front();
        } else {
          assert(size == sizeof member);
          std::memcpy(&member, entry.data(), sizeof member);
        }
      };
      visit_world(take, rows[i]);
      rows[i].box_begin -= at(state_->before, Axis::boxes);
      rows[i].sample_begin -= at(state_->before, Axis::samples);
      rows[i].row_begin -= at(state_->before, Axis::rows);
    }
    return rows;
  });
}

Result<std::vector<LayoutMargins>> ResultsReader::margins(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<LayoutMargins> rows(count);
    visit_margins([&](std::string_view path, auto member) { state_->read_member(path, begin, member, rows); });
    if (!state_->info.has_margin_spread) return rows;
    std::vector<MarginSpread> spreads(count);
    visit_margin_spread([&](std::string_view path, auto member) { state_->read_member(path, begin, member, spreads); });
    for (std::size_t i = 0; i < count; ++i) rows[i].spread = spreads[i];
    return rows;
  });
}

Result<std::vector<LayoutIndicators>> ResultsReader::indicators(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<LayoutIndicators> rows(count);
    visit_indicators([&](std::string_view path, auto member) { state_->read_member(path, begin, member, rows); });
    return rows;
  });
}

Result<LayoutIndicators> ResultsReader::box_indicators(std::uint64_t layout) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<std::uint64_t> begin;
    std::vector<std::uint32_t> count;
    state_->read("/inputs/layouts/box_begin", layout, 1, begin);
    state_->read("/inputs/layouts/box_count", layout, 1, count);
    LayoutIndicators found;
    visit_box_indicators(
        [&](std::string_view path, auto& values) {
          state_->read(path, begin.front() - at(state_->before, Axis::layout_boxes), count.front(), values);
        },
        found);
    return found;
  });
}

Result<std::vector<WallForces>> ResultsReader::walls(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<WallForces> rows(count);
    visit_walls([&](std::string_view path, auto member) { state_->read_member(path, begin, member, rows); });
    return rows;
  });
}

Result<std::vector<ReplicaOutcome>> ResultsReader::replicas(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<ReplicaOutcome> rows(count);
    visit_replicas([&](std::string_view path, auto member) { state_->read_member(path, begin, member, rows); });
    return rows;
  });
}

Result<std::vector<std::uint32_t>> ResultsReader::boxes_beyond(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    std::vector<std::uint32_t> boxes;
    state_->read("/damage/boxes_beyond", begin, count, boxes);
    return boxes;
  });
}

Result<BoxDamage> ResultsReader::box_damage(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    BoxDamage damage;
    visit_box_damage([&](std::string_view path, auto& column) { state_->read(path, begin, count, column); }, damage);
    return damage;
  });
}

Result<BoxTable> ResultsReader::boxes(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    BoxTable table;
    visit_boxes([&](std::string_view path, auto& column) { state_->read(path, begin, count, column); }, table);
    return table;
  });
}

Result<EndTable> ResultsReader::ends(std::uint64_t begin, std::uint64_t count) {
  return h5::caught_result(state_->file->path(), [&] {
    EndTable table;
    visit_ends([&](std::string_view path, auto& column) { state_->read(path, begin, count, column); }, table);
    return table;
  });
}

Result<Series> ResultsReader::series(const WorldRow& world) {
  return h5::caught_result(state_->file->path(), [&] {
    const std::uint64_t rows = std::uint64_t{world.sample_count} * world.box_count;
    Series series;
    visit_series(
        [&](std::string_view path, auto& column) {
          if (!state_->info.has_walls && dataset_spec(path).analysis == Analysis::wall_forces) return;
          const bool of_samples = dataset_spec(path).axis == Axis::samples;
          state_->read(path, of_samples ? world.sample_begin : world.row_begin, of_samples ? world.sample_count : rows,
                       column);
        },
        series);
    return series;
  });
}

Result<Series> ResultsReader::path_of(const WorldRow& world) {
  return h5::caught_result(state_->file->path(), [&] {
    Series series;
    state_->read("/series/time", world.sample_begin, world.sample_count, series.time);
    state_->read("/series/displacement", world.row_begin, std::uint64_t{world.sample_count} * world.box_count,
                 series.displacement);
    return series;
  });
}

}  // namespace holdfast::internal
