#pragma once

#include <memory>
#include <vector>

#include "api/c_call.hpp"
#include "holdfast/holdfast.h"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// Settings of the C interface.
struct CSettings : CObject {
  std::vector<holdfast::Setting> settings;  ///< in the order in which they were set
};

/// Calls the work with the settings of the caller, which may be null for none.
template <class Work>
int with_settings(const holdfast_settings* handle, Work&& work) noexcept {
  if (handle == nullptr) return work(std::vector<holdfast::Setting>());
  const std::shared_ptr<CSettings> settings = Handles<holdfast_settings, CSettings>::all().find(handle);
  if (settings == nullptr) return HOLDFAST_BAD_HANDLE;
  const std::unique_lock lock(settings->in_use, std::try_to_lock);
  return lock ? work(settings->settings) : HOLDFAST_IN_USE;
}

}  // namespace holdfast::internal
