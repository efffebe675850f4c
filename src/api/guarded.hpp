#pragma once

#include <exception>
#include <new>

#include "api/convert.hpp"
#include "core/base/result.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// Runs a call of the library: whatever goes wrong in it becomes a `holdfast::Error`.
template <class Work>
auto guarded(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const holdfast::Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw exception_of({out_of_memory("")});
  } catch (const std::exception& error) {
    throw exception_of({{.what = "the system refused", .value = error.what()}});
  }
}

}  // namespace holdfast::internal
