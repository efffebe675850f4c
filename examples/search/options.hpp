#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/// When the dynamic check is made.
enum class CheckWhen {
  in_loop,     ///< while searching: the search is for loadings that hold
  afterwards,  ///< when the search, for fill alone, has ended
};

/// What the command line says.
struct Options {
  std::string instances;                   ///< path of a file of problems
  int problem = 1;                         ///< position in it, from 1
  std::vector<std::string> accelerations;  ///< paths of files
  CheckWhen check = CheckWhen::in_loop;
  double seconds = 120;                               ///< budget: processor time of all threads together, s
  int generations = std::numeric_limits<int>::max();  ///< budget too: whichever is spent first
  std::size_t population = 50;
  std::uint64_t seed = 1;
  int threads = 0;           ///< 0: one per core
  std::string out_folder;    ///< where layout files of the best loadings go; empty: nowhere
  std::string asked_folder;  ///< where those of all loadings go that are checked; empty: nowhere
};

extern const char* const kUsage;

/// Throws std::runtime_error.
Options read_options(const std::vector<std::string>& words);
