#include "io/results/results_schema.hpp"

#include <cassert>

#include "io/results/analysis_tables.hpp"
#include "io/results/results_tables.hpp"

namespace holdfast::internal {

namespace {

constexpr DatasetContent kWorldOfBox = {"/boxes/world", Axis::boxes, "1", "world of the box: row of /worlds"};

constexpr DatasetSpec kInputs[] = {
    {{"/inputs/layouts/name", Axis::layouts, "none",
      "file name of the layout; # and the name of the load where a file has several"},
     ElementType::text,
     1},
    {{"/inputs/layouts/sha256", Axis::layouts, "none",
      "SHA-256, hexadecimal, of the layout file's bytes; of a load in a table or JSON, of its own JSON"},
     ElementType::text,
     1},
    {{"/inputs/layouts/header", Axis::layouts, "none", "first line of the layout file, as it is"},
     ElementType::text,
     1},
    {{"/inputs/layouts/box_begin", Axis::layouts, "1",
      "first box of the layout: row of corner_min, corner_max and material"},
     ElementType::u64,
     1},
    {{"/inputs/layouts/box_count", Axis::layouts, "1", "boxes of the layout; 0 when it could not be used"},
     ElementType::u32,
     1},
    {{"/inputs/layouts/corner_min", Axis::layout_boxes, "m",
      "corner of the box with the smallest x, y, z as loaded, container frame (z up)"},
     ElementType::f64,
     3},
    {{"/inputs/layouts/corner_max", Axis::layout_boxes, "m", "corner of the box with the largest x, y, z as loaded"},
     ElementType::f64,
     3},
    {{"/inputs/layouts/material", Axis::layout_boxes, "1", "material of the box by number; -1 where it has a name"},
     ElementType::i32,
     1},
    {{"/inputs/layouts/material_name", Axis::layout_boxes, "none",
      "material of the box by name; empty where it has a number"},
     ElementType::label,
     1},
    {{"/inputs/layouts/box_name", Axis::layout_boxes, "none", "name of the box; empty where it has none"},
     ElementType::label,
     1},
    {{"/inputs/layouts/mass", Axis::layout_boxes, "kg", "mass that the load says for the box; NaN: by its material"},
     ElementType::f64,
     1},
    {{"/inputs/layouts/centre_of_mass", Axis::layout_boxes, "m",
      "offset of the centre of mass from the middle of the box that the load says; NaN: by its material"},
     ElementType::f64,
     3},
    {{"/inputs/layouts/mat", Axis::layout_boxes, "1",
      "friction coefficient of the anti-slip mat beneath the box; NaN: none"},
     ElementType::f64,
     1},
    {{"/inputs/layouts/fixed", Axis::layout_boxes, "1", "1 where the load says that the box is part of the container"},
     ElementType::u8,
     1},
    {{"/inputs/layouts/order", Axis::layout_boxes, "1", "when the box is loaded; NaN: in the order of the boxes"},
     ElementType::f64,
     1},
    {{"/inputs/layouts/bearing_limit", Axis::layout_boxes, "kg", "most that may rest on the box; NaN: not known"},
     ElementType::f64,
     1},
    {{"/inputs/layouts/container_type", Axis::layouts, "none",
      "type of the load's own container in the catalogue; empty: none, or the container of the run"},
     ElementType::text,
     1},
    {{"/inputs/layouts/container_size", Axis::layouts, "m",
      "inner length, width and height of the load's own container; NaN: that of the run, in /inputs/settings"},
     ElementType::f64,
     3},
    {{"/inputs/layouts/open_sides", Axis::layouts, "none", "open sides of the load's own container, as OpenSides"},
     ElementType::text,
     1},
    {{"/inputs/layouts/drop_sides", Axis::layouts, "none", "low sides of the load's own container, as DropSides"},
     ElementType::text,
     1},
    {{"/inputs/layouts/bed_height", Axis::layouts, "m",
      "height of the floor of the load's own container above the ground; NaN: that of the run"},
     ElementType::f64,
     1},
    {{"/inputs/accelerations/name", Axis::accelerations, "none",
      "file name of the acceleration, or norm, direction and size"},
     ElementType::text,
     1},
    {{"/inputs/accelerations/sha256", Axis::accelerations, "none",
      "SHA-256, hexadecimal, of the acceleration file's bytes; without a file, of its numbers"},
     ElementType::text,
     1},
    {{"/inputs/accelerations/segment_begin", Axis::accelerations, "1",
      "first segment: row of start, duration and value"},
     ElementType::u64,
     1},
    {{"/inputs/accelerations/segment_count", Axis::accelerations, "1",
      "segments of the acceleration; 0 when it could not be used"},
     ElementType::u32,
     1},
    {{"/inputs/accelerations/start", Axis::segments, "s", "start of the segment"}, ElementType::f64, 1},
    {{"/inputs/accelerations/duration", Axis::segments, "s", "duration of the segment"}, ElementType::f64, 1},
    {{"/inputs/accelerations/value", Axis::segments, "m/s2",
      "acceleration of the container x, y, z in the segment; zero outside all segments"},
     ElementType::f64,
     3},
};

/// Collects the datasets of visited members.
class Collector {
 public:
  explicit Collector(std::vector<DatasetSpec>& specs) : specs_(specs) {}

  template <class Row, class Member>
  void operator()(const DatasetContent& content, Member Row::* /*member*/) {
    using Entry = EntryOf<Member>;
    specs_.push_back({content, element_type_of<Entry>(), width_of<Entry>()});
  }

  template <class Row, class Member>
  void operator()(const OutcomeField& field, Member Row::* /*member*/) {
    using Entry = EntryOf<Member>;
    const bool judged = field.scope == FieldScope::derived;
    const bool of_worlds = field.dataset.starts_with("/worlds/") || field.dataset.starts_with("/summary/worlds/");
    specs_.push_back({{field.dataset, of_worlds ? Axis::worlds : Axis::boxes, field.unit, field.sentence, field.since},
                      element_type_of<Entry>(),
                      width_of<Entry>(),
                      judged ? Origin::derived : Origin::recorded});
  }

 private:
  std::vector<DatasetSpec>& specs_;
};

void append_analyses(std::vector<DatasetSpec>& specs, bool precede_worlds) {
  RunTables tables = all_tables();
  std::sort(tables.begin(), tables.end(),
            [](const AnalysisTables* a, const AnalysisTables* b) { return a->file_order < b->file_order; });
  for (const AnalysisTables* analysis : tables) {
    if ((analysis->file_order < 0) != precede_worlds) continue;
    for (DatasetSpec& spec : analysis->datasets()) {
      spec.analysis = analysis;
      specs.push_back(spec);
    }
  }
}

std::vector<DatasetSpec> make_schema() {
  std::vector<DatasetSpec> specs(std::begin(kInputs), std::end(kInputs));
  Collector collect(specs);
  append_analyses(specs, true);
  visit_world_row<WorldRow>(collect);
  specs.push_back({kWorldOfBox, ElementType::u64, 1});
  visit_boxes(collect);
  visit_ends<EndTable>(collect);
  visit_series(collect);
  append_analyses(specs, false);
  visit_world_verdict<WorldVerdict>(collect);
  visit_box_verdict<BoxVerdict>(collect);
  return specs;
}

}  // namespace

const std::vector<DatasetSpec>& schema() {
  static const std::vector<DatasetSpec> kSchema = make_schema();
  return kSchema;
}

std::string_view to_string(Axis axis) {
  constexpr std::array<std::string_view, kAxisCount> kNames = {"worlds",  "boxes",        "samples",       "rows",
                                                               "layouts", "layout_boxes", "accelerations", "segments"};
  return kNames.at(static_cast<std::size_t>(axis));
}

std::size_t size_of(ElementType type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 4, 8, 4, 4, 8, kLabelBytes, 0};
  return kSizes.at(static_cast<std::size_t>(type));
}

std::string_view to_string(ElementType type) {
  constexpr std::array<std::string_view, 8> kNames = {"uint8",   "uint32",  "uint64", "int32",
                                                      "float32", "float64", "text",   "text"};
  return kNames.at(static_cast<std::size_t>(type));
}

std::size_t dataset_index(std::string_view path) {
  for (std::size_t i = 0; i < schema().size(); ++i)
    if (schema()[i].path == path) return i;
  assert(false && "the path is in the schema");
  return 0;
}

bool includes(const RunTables& tables, const DatasetSpec& spec) {
  return spec.analysis == nullptr || std::find(tables.begin(), tables.end(), spec.analysis) != tables.end();
}

const DatasetSpec& representative(Axis axis) {
  return *std::find_if(schema().begin(), schema().end(),
                       [&](const DatasetSpec& spec) { return spec.axis == axis && spec.analysis == nullptr; });
}

const std::vector<std::size_t>& long_datasets() {
  static const std::vector<std::size_t> kPlaces = [] {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < schema().size(); ++i)
      if (is_long(schema()[i])) places.push_back(i);
    return places;
  }();
  return kPlaces;
}

}  // namespace holdfast::internal
