#pragma once

#include <cassert>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/world_record.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/results_reader.hpp"
#include "io/results/results_schema.hpp"
#include "io/results/summary.hpp"

/// Which member is stored in which dataset: defined once, for writing and for reading.
namespace holdfast::internal {

template <class Visit, class SeriesLike>
void visit_series(Visit&& visit, SeriesLike& s) {
  visit("/series/time", s.time);
  visit("/series/container_acceleration", s.container_acceleration);
  visit("/series/total_kinetic_energy", s.total_kinetic_energy);
  visit("/series/fallen_count", s.fallen_count);
  visit("/walls/force", s.side_force);
  visit("/series/displacement", s.displacement);
  visit("/series/orientation", s.orientation);
  visit("/series/angular_velocity", s.angular_velocity);
  visit("/series/linear_acceleration", s.linear_acceleration);
  visit("/series/force", s.force);
  visit("/series/kinetic_energy", s.kinetic_energy);
}

template <class Visit, class BoxTableLike>
void visit_boxes(Visit&& visit, BoxTableLike& b) {
  visit("/boxes/id", b.id);
  visit("/boxes/material", b.material);
  visit("/boxes/mass", b.mass);
  visit("/boxes/size", b.size);
  visit("/boxes/initial_position", b.initial_position);
}

template <class Visit, class EndTableLike>
void visit_ends(Visit&& visit, EndTableLike& e) {
  visit("/boxes/end_displacement", e.displacement);
  visit("/boxes/end_tilt", e.tilt);
  visit("/boxes/end_kinetic_energy", e.kinetic_energy);
  visit("/boxes/peak_displacement", e.peak_displacement);
  visit("/boxes/peak_kinetic_energy", e.peak_kinetic_energy);
  visit("/boxes/settling_displacement", e.settling_displacement);
}

template <class Visit, class WorldRowLike>
void visit_world(Visit&& visit, WorldRowLike& w) {
  visit("/worlds/layout", w.layout);
  visit("/worlds/acceleration", w.acceleration);
  visit("/worlds/status", w.status);
  visit("/worlds/status_text", w.status_text);
  visit("/worlds/stop_reason", w.stop_reason);
  visit("/worlds/box_begin", w.box_begin);
  visit("/worlds/box_count", w.box_count);
  visit("/worlds/sample_begin", w.sample_begin);
  visit("/worlds/sample_count", w.sample_count);
  visit("/worlds/row_begin", w.row_begin);
  visit("/worlds/end_time", w.end_time);
  visit("/worlds/steps", w.steps);
  visit("/worlds/steps_skipped", w.steps_skipped);
  visit("/worlds/solve_iterations", w.solve_iterations);
  visit("/worlds/max_residual", w.max_residual);
  visit("/worlds/residual_scale", w.residual_scale);
  visit("/worlds/max_penetration", w.max_penetration);
  visit("/worlds/peak_total_kinetic_energy", w.peak_total_kinetic_energy);
  visit("/worlds/cpu_seconds", w.cpu_seconds);
  visit("/worlds/state_hash", w.state_hash);
  visit("/worlds/engine", w.engine);
}

template <class Visit, class WorldSummaryLike>
void visit_world_summary(Visit&& visit, WorldSummaryLike& w) {
  visit("/summary/worlds/verdict", w.verdict);
  visit("/summary/worlds/fallen_boxes", w.fallen_boxes);
  visit("/summary/worlds/unstable_boxes", w.unstable_boxes);
  visit("/summary/worlds/moved_boxes", w.moved_boxes);
  visit("/summary/worlds/tilted_boxes", w.tilted_boxes);
  visit("/summary/worlds/total_kinetic_energy", w.total_kinetic_energy);
  visit("/summary/worlds/peak_kinetic_energy", w.peak_kinetic_energy);
  visit("/summary/worlds/max_displacement", w.max_displacement);
  visit("/summary/worlds/peak_displacement", w.peak_displacement);
}

template <class Visit, class BoxSummaryLike>
void visit_box_summary(Visit&& visit, BoxSummaryLike& b) {
  visit("/summary/boxes/displacement", b.displacement);
  visit("/summary/boxes/max_displacement", b.max_displacement);
  visit("/summary/boxes/drop", b.drop);
  visit("/summary/boxes/tilt", b.tilt);
  visit("/summary/boxes/kinetic_energy", b.kinetic_energy);
  visit("/summary/boxes/peak_kinetic_energy", b.peak_kinetic_energy);
  visit("/summary/boxes/fallen", b.fallen);
  visit("/summary/boxes/moved", b.moved);
  visit("/summary/boxes/tilted", b.tilted);
  visit("/summary/boxes/unstable", b.unstable);
  visit("/summary/boxes/first_move_time", b.first_move_time);
}

template <class Visit>
void visit_margins(Visit&& visit) {
  visit("/margins/margin", &LayoutMargins::margin);
  visit("/margins/critical_box", &LayoutMargins::critical_box);
  visit("/margins/trials", &LayoutMargins::trials);
  visit("/margins/cpu_seconds", &LayoutMargins::cpu_seconds);
}

template <class Visit>
void visit_margin_spread(Visit&& visit) {
  visit("/margin_spread/low", &MarginSpread::low);
  visit("/margin_spread/median", &MarginSpread::median);
  visit("/margin_spread/high", &MarginSpread::high);
  visit("/margin_spread/cpu_seconds", &MarginSpread::cpu_seconds);
}

template <class Visit>
void visit_walls(Visit&& visit) {
  visit("/walls/peak_force", &WallForces::peak_force);
  visit("/walls/peak_time", &WallForces::peak_time);
  visit("/walls/peak_point", &WallForces::peak_point);
  visit("/walls/lasting_force", &WallForces::lasting_force);
  visit("/walls/limit", &WallForces::limit);
  visit("/walls/impulse", &WallForces::impulse);
}

/// Of layouts; those of boxes are `visit_box_indicators`.
template <class Visit>
void visit_indicators(Visit&& visit) {
  visit("/indicators/centre_of_gravity", &LayoutIndicators::centre_of_gravity);
  visit("/indicators/centre_offset", &LayoutIndicators::centre_offset);
  visit("/indicators/fill", &LayoutIndicators::fill);
  visit("/indicators/badly_based", &LayoutIndicators::badly_based);
  visit("/indicators/badly_braced", &LayoutIndicators::badly_braced);
}

template <class Visit, class IndicatorsLike>
void visit_box_indicators(Visit&& visit, IndicatorsLike& i) {
  visit("/indicators/base_support", i.base_support);
  visit("/indicators/supported_sides", i.supported_sides);
}

template <class Visit, class BoxDamageLike>
void visit_box_damage(Visit&& visit, BoxDamageLike& d) {
  visit("/damage/peak_acceleration", d.peak_acceleration);
  visit("/damage/velocity_change", d.velocity_change);
  visit("/damage/beyond", d.beyond);
}

template <class Visit>
void visit_replicas(Visit&& visit) {
  visit("/replicas/count", &ReplicaOutcome::count);
  visit("/replicas/failed", &ReplicaOutcome::failed);
  visit("/replicas/share", &ReplicaOutcome::share);
  visit("/replicas/wilson_low", &ReplicaOutcome::wilson_low);
  visit("/replicas/wilson_high", &ReplicaOutcome::wilson_high);
  visit("/replicas/verdict", &ReplicaOutcome::verdict);
  visit("/replicas/simulated", &ReplicaOutcome::simulated);
  visit("/replicas/cpu_seconds", &ReplicaOutcome::cpu_seconds);
}

/// Entries of one dataset, collected in memory: bytes in their stored form, or texts before their common length is
/// known.
class Column {
 public:
  explicit Column(const DatasetSpec& spec) : spec_(&spec) {}

  template <class T>
  void append(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3> ||
                  std::is_same_v<T, std::array<Vec3, kSideCount>>);
    assert(spec_->type == element_type_of<T>() && spec_->width * size_of(spec_->type) == sizeof(T));
    const auto raw = std::as_bytes(values);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    count_ += values.size();
  }
  template <class T>
  void append(const std::vector<T>& values) {
    append(std::span<const T>(values));
  }
  template <class T>
  void append(const T& value) {
    append(std::span<const T>(&value, 1));
  }
  void append(const std::string& text) {
    assert(spec_->type == ElementType::text);
    texts_.push_back(valid_utf8(text));  // the type of the column is UTF-8
    ++count_;
  }

  /// Adds the entries of another column of the dataset.
  void append(const Column& other);
  /// Adds entries in their stored form; texts padded to `text_size`.
  void append_stored(std::vector<std::byte>&& stored, std::size_t text_size);
  /// Moves all entries out, in their stored form; not for texts.
  std::vector<std::byte> take();

  const DatasetSpec& spec() const { return *spec_; }
  std::uint64_t count() const { return count_; }
  /// Bytes of the longest text; at least 1.
  std::size_t text_size() const;
  /// The entries in their stored form; texts padded with zero bytes to `text_size`.
  std::vector<std::byte> stored(std::size_t text_size) const;

 private:
  const DatasetSpec* spec_;
  std::uint64_t count_ = 0;
  std::vector<std::byte> bytes_;
  std::vector<std::string> texts_;
};

/// A column for every dataset of the schema.
class ColumnSet {
 public:
  ColumnSet();
  Column& operator[](std::string_view path) { return columns_[dataset_index(path)]; }
  const Column& operator[](std::string_view path) const { return columns_[dataset_index(path)]; }
  const std::vector<Column>& columns() const { return columns_; }
  /// Adds the entries of another set.
  void append(const ColumnSet& other);

 private:
  std::vector<Column> columns_;
};

/// Texts of a column from their stored form, without padding.
std::vector<std::string> texts_of(std::span<const std::byte> stored, std::size_t text_size);

/// Numbers of a column from their stored form.
template <class T>
std::vector<T> values_of(const std::vector<std::byte>& stored) {
  std::vector<T> values(stored.size() / sizeof(T));
  if (!stored.empty()) std::memcpy(static_cast<void*>(values.data()), stored.data(), stored.size());
  return values;
}

}  // namespace holdfast::internal
