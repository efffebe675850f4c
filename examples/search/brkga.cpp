#include "brkga.hpp"

#include <algorithm>

Brkga::Brkga(std::size_t key_count, const BrkgaOptions& options)
    : elite_count_(static_cast<std::size_t>(options.elite * static_cast<double>(options.population))),
      mutant_count_(static_cast<std::size_t>(options.mutants * static_cast<double>(options.population))),
      inheritance_(options.inheritance),
      random_(options.seed),
      population_(options.population, Individual{std::vector<double>(key_count)}),
      next_(population_) {
  for (Individual& individual : population_) randomize(individual);
}

double Brkga::fitness_to_exceed() const { return known_ == 0 ? kWorstFitness : population_[known_ - 1].fitness; }

void Brkga::next_generation() {
  rank();
  double fitness_before = std::numeric_limits<double>::quiet_NaN();
  for (Individual& individual : population_)
    if (individual.fitness == fitness_before)
      individual.fitness = kWorstFitness;
    else
      fitness_before = individual.fitness;
  rank();

  const std::size_t count = population_.size();
  std::copy_n(population_.begin(), elite_count_, next_.begin());
  for (std::size_t i = elite_count_; i < count - mutant_count_; ++i) {
    const Individual& better = random_one(0, elite_count_);
    const Individual& other = random_one(elite_count_, count);
    for (std::size_t k = 0; k < next_[i].keys.size(); ++k)
      next_[i].keys[k] = (random_key() < inheritance_ ? better : other).keys[k];
  }
  for (std::size_t i = count - mutant_count_; i < count; ++i) randomize(next_[i]);
  population_.swap(next_);
  known_ = elite_count_;
}

void Brkga::rank() {
  // Of equals those that were there first are ahead, so that a search is the same on every machine.
  std::stable_sort(population_.begin(), population_.end(),
                   [](const Individual& a, const Individual& b) { return a.fitness > b.fitness; });
}

// The 53 leading bits; std::uniform_real_distribution differs between standard libraries.
double Brkga::random_key() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

const Individual& Brkga::random_one(std::size_t first, std::size_t last) {
  return population_[first + static_cast<std::size_t>(random_key() * static_cast<double>(last - first))];
}

void Brkga::randomize(Individual& individual) {
  for (double& key : individual.keys) key = random_key();
}
