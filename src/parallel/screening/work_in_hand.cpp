#include "parallel/screening/work_in_hand.hpp"

namespace holdfast::internal {

namespace {

thread_local const char* layout_in_hand = nullptr;
thread_local const char* acceleration_in_hand = nullptr;

}  // namespace

WorkInHand::WorkInHand(const std::string& layout, const std::string& acceleration) {
  layout_in_hand = layout.c_str();
  acceleration_in_hand = acceleration.c_str();
}

WorkInHand::~WorkInHand() { layout_in_hand = acceleration_in_hand = nullptr; }

const char* WorkInHand::layout() { return layout_in_hand; }
const char* WorkInHand::acceleration() { return acceleration_in_hand; }

}  // namespace holdfast::internal
