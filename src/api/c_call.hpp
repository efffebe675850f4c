#pragma once

#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "api/c_arguments.hpp"
#include "api/c_handles.hpp"
#include "holdfast/holdfast.h"
#include "holdfast/holdfast.hpp"

/// How every function of the C interface runs: the object behind a handle, one thread at a time, no exception.
namespace holdfast::internal {

/// What every object of the C interface keeps.
struct CObject {
  std::mutex in_use;
  std::string message;                      ///< why the last call failed; empty when it did not
  std::vector<holdfast::Problem> problems;  ///< that the last call found
  bool out_of_memory = false;               ///< the last call had no memory for its message
};

/// Runs the work of a call, whose status is what it returns.
template <class Work>
int run_call(CObject& object, Work&& work) noexcept {
  try {
    object.out_of_memory = false;
    object.message.clear();
    object.problems.clear();
    try {
      return work();
    } catch (const BadArgument& bad) {
      object.message = bad.what;
      return HOLDFAST_BAD_ARGUMENT;
    } catch (const holdfast::Error& error) {
      object.message = error.what();
      object.problems = error.problems();
    } catch (const std::exception& error) {
      object.message = error.what();
    }
  } catch (...) {
    object.out_of_memory = true;
  }
  return HOLDFAST_ERROR;
}

/// Makes an object, and then runs the work that completes it.
template <class Object, class Handle, class Work>
int make_object(Handle** handle, Work&& work) noexcept {
  if (handle == nullptr) return HOLDFAST_BAD_ARGUMENT;
  *handle = nullptr;
  try {
    auto object = std::make_shared<Object>();
    const int status = run_call(*object, [&] { return work(*object); });
    *handle = Handles<Handle, Object>::all().add(std::move(object));
    return status;
  } catch (...) {
    return HOLDFAST_ERROR;
  }
}

/// Runs a call on the object of a handle.
template <class Object, class Handle, class Work>
int call_object(const Handle* handle, Work&& work) noexcept {
  const std::shared_ptr<Object> object = Handles<Handle, Object>::all().find(handle);
  if (object == nullptr) return HOLDFAST_BAD_HANDLE;
  const std::unique_lock lock(object->in_use, std::try_to_lock);
  if (!lock) return HOLDFAST_IN_USE;
  return run_call(*object, [&] { return work(*object); });
}

/// The message of the object of a handle.
template <class Object, class Handle>
const char* message_of(const Handle* handle) noexcept {
  const std::shared_ptr<Object> object = Handles<Handle, Object>::all().find(handle);
  if (object == nullptr) return "there is no such object: it was freed, or never made";
  const std::unique_lock lock(object->in_use, std::try_to_lock);
  if (!lock) return "another thread uses the object";
  return object->out_of_memory ? "memory ran out" : object->message.c_str();
}

}  // namespace holdfast::internal
