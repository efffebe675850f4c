#include "io/results/results_writer.hpp"

#include <filesystem>
#include <mutex>
#include <utility>

#include "io/results/chunk_codec.hpp"
#include "io/results/part_builder.hpp"
#include "io/results/unit_columns.hpp"

namespace holdfast::internal {

namespace {

/// Entries of the incomplete chunks at the end of the last finished part.
LongEntries read_tail(const std::string& path, const RunDescription& run, const Progress& resume) {
  LongEntries tail = no_entries();
  if (resume.part_count == 0) return tail;
  const h5::File file = h5::File::open(part_path(path, resume.part_count));
  for (std::size_t column = 0; column < long_datasets().size(); ++column) {
    const DatasetSpec& spec = schema()[long_datasets()[column]];
    if (!includes(run.analyses, spec)) continue;
    const h5::Dataset dataset = h5::Dataset::open(file, spec);
    const std::uint64_t begin = chunk_begin(dataset.spec().axis, dataset.length());
    tail[column] = dataset.read(begin, dataset.length() - begin);
  }
  return tail;
}

AxisCounts counts_of(const Progress& progress) {
  AxisCounts counts{};
  at(counts, Axis::worlds) = progress.world_count;
  at(counts, Axis::boxes) = progress.box_count;
  at(counts, Axis::samples) = progress.sample_count;
  at(counts, Axis::rows) = progress.row_count;
  at(counts, Axis::layouts) = progress.layout_count;
  at(counts, Axis::layout_boxes) = progress.layout_box_count;
  return counts;
}

void prepare_folder(const std::string& path, const Progress& resume) {
  if (std::filesystem::exists(path)) {
    throw h5::Failure(Error{.file = path,
                            .what = "exists already, and a finished results file is never overwritten",
                            .accepted = "give another name, or --overwrite to replace it"});
  }
  const std::size_t found = list_parts(path).size();
  if (found != resume.part_count) {
    throw h5::Failure(Error{.file = parts_folder(path),
                            .what = "contains the finished parts of an interrupted run",
                            .value = std::to_string(found),
                            .accepted = "--resume continues it, --overwrite starts anew"});
  }
  std::error_code failure;
  std::filesystem::create_directories(parts_folder(path), failure);
  if (failure)
    throw h5::Failure(Error{.file = parts_folder(path), .what = "cannot be created", .value = failure.message()});
}

}  // namespace

struct ResultsWriter::State {
  std::string path;
  RunDescription run;
  PartLimits limits;
  ChunkGrid grid;       ///< used only in `place`, as is the next member
  AxisCounts placed{};  ///< entries of the run up to now

  std::mutex mutex;  ///< guards the following members
  std::unique_ptr<PartBuilder> part;
  std::uint64_t finished_parts = 0;
  AxisCounts end{};                 ///< of the finished parts
  LongEntries tail = no_entries();  ///< their entries in the incomplete chunks
  std::optional<Error> error;

  void close_part() {
    if (!part) return;
    part->close();
    end = part->end();
    tail = part->tail();
    ++finished_parts;
    part.reset();
  }

  /// Runs `work` under the lock; after a failure it does nothing.
  template <class Work>
  std::optional<Error> guarded(Work&& work) {
    const std::lock_guard lock(mutex);
    h5::be_quiet();
    if (!error) error = h5::caught(path, work);
    if (error) part.reset();
    return error;
  }
};

ResultsWriter::ResultsWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

ResultsWriter::~ResultsWriter() {
  // Removes the folder of a run that ended before its first part; a folder with parts remains.
  std::error_code not_empty;
  std::filesystem::remove(parts_folder(state_->path), not_empty);
}

Result<std::unique_ptr<ResultsWriter>> ResultsWriter::open(const std::string& path, RunDescription run,
                                                           const Progress& resume, const PartLimits& limits) {
  return h5::caught_result(path, [&] {
    prepare_folder(path, resume);
    auto state = std::make_unique<State>();
    state->path = path;
    state->run = std::move(run);
    state->limits = limits;
    state->finished_parts = resume.part_count;
    state->end = counts_of(resume);
    state->tail = read_tail(path, state->run, resume);
    state->placed = state->end;
    state->grid = ChunkGrid(state->end, state->tail);
    return std::unique_ptr<ResultsWriter>(new ResultsWriter(std::move(state)));
  });
}

/// A unit on its way into the writer's open part.
class ResultsWriter::Unit final : public SinkUnit {
 public:
  /// @param columns those up to `state.placed`
  Unit(State& state, ColumnSet&& columns) : state_(state) {
    unit_.columns = std::move(columns);
    unit_.end = state.placed;
    unit_.piece = state.grid.add(unit_.columns);
  }

  void pack() override {
    for (GridChunk& chunk : unit_.piece.chunks)
      chunk.bytes = compress_chunk(chunk.bytes, size_of(schema()[long_datasets()[chunk.column]].type));
  }

  /// Adds the unit to the open part; closes the part when it is due.
  std::optional<Error> write() override {
    return state_.guarded([&] {
      std::unique_ptr<PartBuilder>& part = state_.part;
      if (!part) {
        part = std::make_unique<PartBuilder>(part_path(state_.path, state_.finished_parts + 1), state_.run, state_.end,
                                             std::move(state_.tail));
      }
      part->add(std::move(unit_));
      const PartLimits& limits = state_.limits;
      const bool full = part->world_count() >= limits.worlds || part->bytes() >= limits.bytes;
      if (full || std::chrono::steady_clock::now() - part->opened() >= limits.age) state_.close_part();
    });
  }

 private:
  State& state_;
  UnitPiece unit_;
};

std::unique_ptr<SinkUnit> ResultsWriter::place(UnitRecord& unit) {
  return std::make_unique<Unit>(*state_, columns_of(unit, state_->run, state_->placed));
}

std::unique_ptr<SinkUnit> ResultsWriter::place(ColumnSet&& columns) {
  for (const Axis axis : kGrowingAxes) at(state_->placed, axis) += columns[representative(axis).path].count();
  return std::make_unique<Unit>(*state_, std::move(columns));
}

const AxisCounts& ResultsWriter::placed() const { return state_->placed; }

std::optional<Error> ResultsWriter::close_part_if_due(std::chrono::steady_clock::time_point now) {
  return state_->guarded([&] {
    if (state_->part && now - state_->part->opened() >= state_->limits.age) state_->close_part();
  });
}

std::optional<Error> ResultsWriter::finish() {
  return state_->guarded([&] { state_->close_part(); });
}

}  // namespace holdfast::internal
