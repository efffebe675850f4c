#pragma once

#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

constexpr double kWorstFitness = -std::numeric_limits<double>::infinity();

/// A vector of keys in [0, 1), and how good what it stands for is.
struct Individual {
  std::vector<double> keys;
  double fitness = kWorstFitness;  ///< larger is better
};

/// Values as Goncalves and Resende recommend them (Journal of Heuristics 17, 2011).
struct BrkgaOptions {
  std::size_t population = 50;
  double elite = 0.2;        ///< share of the population that is kept, and breeds
  double mutants = 0.15;     ///< share that is made anew at random
  double inheritance = 0.7;  ///< probability that a key comes from the elite parent
  std::uint64_t seed = 1;
};

/// Biased random-key genetic algorithm: children of one elite parent and one that is not. It knows nothing of what the
/// keys stand for.
///
///     for (Individual& individual : brkga.newcomers()) individual.fitness = ...;
///     brkga.next_generation();
class Brkga {
 public:
  Brkga(std::size_t key_count, const BrkgaOptions& options);

  /// Those whose fitness the caller has to set: all of the first generation, later all but the elite.
  std::span<Individual> newcomers() { return std::span(population_).subspan(known_); }

  /// The fitness that a newcomer must exceed to become one of the elite: that of the last of the present elite.
  double fitness_to_exceed() const;

  /// Ranks the population and replaces all but the elite by children and mutants. Of several with equal fitness, which
  /// nearly always are copies, one can be of the elite.
  void next_generation();

  /// Makes all of the population newcomers: for a caller that goes on with another fitness.
  void forget_fitness() { known_ = 0; }

  /// The elite, best first; empty in the first generation.
  std::span<const Individual> elite() const { return std::span(population_).first(known_); }

 private:
  void rank();
  double random_key();
  const Individual& random_one(std::size_t first, std::size_t last);
  void randomize(Individual& individual);

  std::size_t elite_count_, mutant_count_, known_ = 0;
  double inheritance_;
  std::mt19937_64 random_;
  std::vector<Individual> population_, next_;
};
