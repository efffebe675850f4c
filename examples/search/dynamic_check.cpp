#include "dynamic_check.hpp"

#include <algorithm>

namespace {

std::vector<holdfast::Acceleration> read(const std::vector<std::string>& paths) {
  std::vector<holdfast::Acceleration> accelerations;
  for (const std::string& path : paths) accelerations.push_back(holdfast::read_acceleration(path));
  return accelerations;
}

holdfast::ScreenOptions options_of(const Extents& container, int threads) {
  holdfast::ScreenOptions options;
  options.settings = {{"Container", "Length", std::to_string(container[0])},
                      {"Container", "Width", std::to_string(container[1])},
                      {"Container", "Height", std::to_string(container[2])}};
  options.accuracy = "screening";
  options.threads = threads;
  options.first_failure = true;  // one acceleration that is not held decides; which one is tried first, experience
  options.unit = holdfast::LengthUnit::centimetre;
  options.keep_boxes = true;
  return options;
}

}  // namespace

DynamicCheck::DynamicCheck(const Instance& instance, const std::vector<std::string>& accelerations, int threads)
    : types_(instance.types), screen_(read(accelerations), options_of(instance.container, threads)) {}

holdfast::Layout DynamicCheck::layout_of(const Loading& loading) const {
  holdfast::Layout layout;
  for (const auto& [place, type] : loading.boxes) {
    holdfast::Box& box = layout.boxes.emplace_back();
    std::copy(place.low.begin(), place.low.end(), box.corner_min.begin());
    std::copy(place.high.begin(), place.high.end(), box.corner_max.begin());
    box.material = type + 1;
    if (const double mass = types_[static_cast<std::size_t>(type)].mass; mass > 0) box.mass = mass;
  }
  return layout;
}

std::vector<Stability> DynamicCheck::check(std::span<const Loading> loadings) {
  std::vector<holdfast::Layout> layouts;
  for (const Loading& loading : loadings) {
    layouts.push_back(layout_of(loading));
    if (on_loading) on_loading(loading, checked_ + layouts.size());
  }

  std::vector<Stability> answers(loadings.size(), Stability{.holds = true});
  for (const holdfast::WorldOutcome& world : screen_.evaluate(layouts)) {
    Stability& answer = answers[world.layout];
    // The worlds after the one that is not held are not needed, and hold no outcomes.
    answer.holds = answer.holds && world.verdict == holdfast::Verdict::stayed;
    for (const holdfast::BoxOutcome& box : world.box_outcomes)
      if (box.fallen || box.moved || box.tilted || box.unstable) ++answer.boxes_out_of_place;
    cpu_seconds_ += world.cpu_seconds;
  }
  for (Stability& answer : answers) {
    // A world that could not be simulated says nothing of its boxes.
    if (!answer.holds) answer.boxes_out_of_place = std::max(answer.boxes_out_of_place, 1);
    held_ += answer.holds ? 1 : 0;
  }
  checked_ += loadings.size();
  return answers;
}
