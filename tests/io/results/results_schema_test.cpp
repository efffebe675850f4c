#include "io/results/results_schema.hpp"

#include <hdf5.h>

#include <set>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_fixture.hpp"

namespace results_schema_test {

using namespace results_fixture;

TEST_CASE("results_schema: every dataset of the table is in the file with its type and shape", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, make_run(mixed_shapes(), GENERATE(true, false), all_tables()), never());
  const h5::File file = h5::File::open(path);
  std::array<std::set<std::uint64_t>, kAxisCount> lengths;
  for (const DatasetSpec& spec : schema()) {
    const std::string name(spec.path);
    CAPTURE(name);
    lengths[static_cast<std::size_t>(spec.axis)].insert(h5::Dataset::open(file, spec).length());
    CHECK(h5::read_text_attribute(file, name, "units") == spec.units);
    CHECK(h5::read_text_attribute(file, name, "description") == spec.description);
    CHECK_FALSE(spec.description.empty());
    CHECK_FALSE(spec.units.empty());
  }
  for (const auto& of_axis : lengths) CHECK(of_axis.size() == 1);
}

TEST_CASE("results_schema: the file has the datasets of what was asked for, and no others", "[io][results]") {
  const RunTables analyses = GENERATE(RunTables(), all_tables());
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, make_run({{2, 3}}, true, analyses), never());
  const h5::File file = h5::File::open(path);
  std::set<std::string> found;
  const auto collect = [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::set<std::string>*>(to)->insert("/" + std::string(name));
    return 0;
  };
  REQUIRE(H5Ovisit2(file.id(), H5_INDEX_NAME, H5_ITER_INC, collect, &found, H5O_INFO_BASIC) >= 0);
  std::set<std::string> expected = {"/inputs/config"};
  for (const DatasetSpec& spec : schema())
    if (includes(analyses, spec)) expected.insert(std::string(spec.path));
  CHECK(found == expected);
}

TEST_CASE("results_schema: long datasets are those of boxes and samples, and hold numbers", "[io][results]") {
  const auto& places = long_datasets();
  CHECK(std::is_sorted(places.begin(), places.end()));
  for (std::size_t i = 0; i < schema().size(); ++i) {
    const std::string_view path = schema()[i].path;
    CAPTURE(path);
    const std::string_view last = path.substr(path.rfind('/') + 1);
    constexpr std::array<std::string_view, 11> kOfBoxes = {
        "corner_min", "corner_max", "material", "material_name", "box_name",      "mass",
        "mat",        "fixed",      "order",    "bearing_limit", "centre_of_mass"};
    const bool of_layout_boxes =
        (path.starts_with("/inputs/layouts/") && std::find(kOfBoxes.begin(), kOfBoxes.end(), last) != kOfBoxes.end()) ||
        path == "/indicators/base_support" || path == "/indicators/supported_sides";
    const bool expected = path.starts_with("/series/") || path.starts_with("/boxes/") ||
                          path == "/replicas/box_share" || path.starts_with("/summary/boxes/") ||
                          (path.starts_with("/damage/") && path != "/damage/boxes_beyond") || path == "/walls/force" ||
                          of_layout_boxes;
    CHECK(is_long(schema()[i]) == expected);
    CHECK(std::binary_search(places.begin(), places.end(), i) == expected);
    CHECK_FALSE((expected && schema()[i].type == ElementType::text));
    if (expected)
      CHECK(chunk_entries(schema()[i].axis) * size_of(schema()[i].type) * schema()[i].width <= kMostChunkBytes);
  }
}

}  // namespace results_schema_test
