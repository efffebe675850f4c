#pragma once

#include <CL/cl.h>

#include <utility>

namespace holdfast::internal {

/// Owns an OpenCL object.
template <class Object, auto kRelease>
class OpenClHandle {
 public:
  OpenClHandle() = default;
  explicit OpenClHandle(Object object) : object_(object) {}
  OpenClHandle(OpenClHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  OpenClHandle& operator=(OpenClHandle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~OpenClHandle() {
    if (object_ != nullptr) kRelease(object_);
  }

  Object get() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  Object object_ = nullptr;
};

using ClContext = OpenClHandle<cl_context, clReleaseContext>;
using ClQueue = OpenClHandle<cl_command_queue, clReleaseCommandQueue>;
using ClProgram = OpenClHandle<cl_program, clReleaseProgram>;
using ClKernel = OpenClHandle<cl_kernel, clReleaseKernel>;
using ClBuffer = OpenClHandle<cl_mem, clReleaseMemObject>;

}  // namespace holdfast::internal
