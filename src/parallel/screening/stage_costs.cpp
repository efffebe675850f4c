#include "parallel/screening/stage_costs.hpp"

namespace holdfast::internal {

StageSeconds StageCosts::seconds() const {
  StageSeconds seconds{};
  for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i] = seconds_[i];
  seconds[static_cast<std::size_t>(Stage::simulate)] -= seconds[static_cast<std::size_t>(Stage::build)];
  return seconds;
}

}  // namespace holdfast::internal
