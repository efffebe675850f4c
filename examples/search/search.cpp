#include "search.hpp"

#include <iterator>

Search::Search(const Decoder& decoder, DynamicCheck& check, const BrkgaOptions& options)
    : decoder_(decoder), check_(check), brkga_(decoder.key_count(), options) {}

void Search::generation_by_fill() {
  const std::vector<Loading> loadings = decode_newcomers();
  for (const std::size_t i : promising(loadings)) kept_.emplace(loadings[i].fill, loadings[i]);
  for (std::size_t i = 0; i < loadings.size(); ++i) brkga_.newcomers()[i].fitness = loadings[i].fill;
  brkga_.next_generation();
}

void Search::forget_fitness() {
  brkga_.forget_fitness();
  seen_.clear();
}

void Search::generation_by_fill_that_holds() {
  const std::vector<Loading> loadings = decode_newcomers();
  const std::vector<std::size_t> chosen = promising(loadings);
  std::vector<Loading> candidates;
  for (const std::size_t i : chosen) candidates.push_back(loadings[i]);

  for (Individual& individual : brkga_.newcomers()) individual.fitness = kWorstFitness;
  const std::vector<Stability> answers = check(candidates);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    brkga_.newcomers()[chosen[i]].fitness = candidates[i].fill - kPenalty * answers[i].boxes_out_of_place;
  brkga_.next_generation();
}

bool Search::check_fullest(std::size_t most) {
  std::vector<Loading> candidates;
  while (candidates.size() < most && !kept_.empty()) {
    const auto fullest = std::prev(kept_.end());
    candidates.push_back(std::move(fullest->second));
    kept_.erase(fullest);
  }
  check(candidates);
  return !candidates.empty();
}

std::vector<Loading> Search::decode_newcomers() {
  std::vector<Loading> loadings;
  for (const Individual& individual : brkga_.newcomers()) {
    loadings.push_back(decoder_.decode(individual.keys));
    if (loadings.back().fill > fullest_.fill) fullest_ = loadings.back();
  }
  loadings_ += loadings.size();
  return loadings;
}

std::vector<std::size_t> Search::promising(std::span<const Loading> loadings) {
  // No fitness exceeds the fill. So a loading that is not fuller than the last of the elite is fit is not worth a
  // simulation; nor is one that was seen before: it is of the elite, or was not fit enough when less was asked for.
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < loadings.size(); ++i)
    if (loadings[i].fill > brkga_.fitness_to_exceed() && seen_.insert(loadings[i].boxes).second) chosen.push_back(i);
  return chosen;
}

std::vector<Stability> Search::check(std::span<const Loading> loadings) {
  std::vector<Stability> answers = check_.check(loadings);
  for (std::size_t i = 0; i < loadings.size(); ++i)
    if (answers[i].holds && loadings[i].fill > fullest_that_holds_.fill) fullest_that_holds_ = loadings[i];
  return answers;
}
