#include "analyses/replicas/replica_inputs.hpp"

namespace holdfast::internal {

ReplicaInputs::ReplicaInputs(const Layout& layout, const Settings& settings)
    : layout_(layout), boxes_(boxes_hash(layout)) {
  const ScreeningSettings& screening = settings.screening;
  if (screening.play_shift > 0.0) play_ = play_of(layout, settings, screening.play_shift);
  const auto count = static_cast<std::uint32_t>(screening.replicas);
  for (std::uint32_t number = 1; number <= count; ++number)
    draws_.push_back(draw_replica(layout, boxes_, number, screening, settings.contact.materials.rows()));
}

Layout ReplicaInputs::layout(std::uint32_t number) const {
  return shifts_boxes() ? shifted_layout(layout_, play_, boxes_, number) : layout_;
}

}  // namespace holdfast::internal
