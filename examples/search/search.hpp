#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "brkga.hpp"
#include "decoder.hpp"
#include "dynamic_check.hpp"

/// The fullest loading, by a genetic algorithm that knows of stability or does not.
class Search {
 public:
  Search(const Decoder& decoder, DynamicCheck& check, const BrkgaOptions& options);

  /// A generation in which the fitness of a loading is its fill. Loadings that become one of the elite are kept for
  /// `check_fullest`.
  void generation_by_fill();

  /// The population stays, and is judged anew by the next generation.
  void forget_fitness();

  /// A generation in which loadings are checked, and those that do not hold pay `kPenalty` per box out of place.
  void generation_by_fill_that_holds();

  /// Checks the fullest loadings that were kept, at most `most`.
  /// @return whether there were any
  bool check_fullest(std::size_t most);

  std::size_t loadings() const { return loadings_; }                         ///< how many were made
  const Loading& fullest() const { return fullest_; }                        ///< held or not
  const Loading& fullest_that_holds() const { return fullest_that_holds_; }  ///< without boxes when none held

  /// Fill that a box out of place costs. Too little, and the search ends with full loadings of which one box still
  /// moves; too much, and it prefers a loading that is half empty to one of which two boxes move.
  static constexpr double kPenalty = 0.02;

 private:
  /// The loadings of all newcomers.
  std::vector<Loading> decode_newcomers();

  /// Those newcomers that are new and full enough to become one of the elite: indices.
  std::vector<std::size_t> promising(std::span<const Loading> loadings);

  std::vector<Stability> check(std::span<const Loading> loadings);

  const Decoder& decoder_;
  DynamicCheck& check_;
  Brkga brkga_;
  std::set<std::vector<PlacedBox>> seen_;  ///< loadings that were promising
  std::multimap<double, Loading> kept_;    ///< by fill
  std::size_t loadings_ = 0;
  Loading fullest_, fullest_that_holds_;
};
