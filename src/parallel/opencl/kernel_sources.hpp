#pragma once

namespace holdfast::internal {

/// The project's OpenCL C, from `kernels/opencl/`, as it was when this was built.
extern const char* const kWorldStepSource;     ///< a program of its own
extern const char* const kContactSetupSource;  ///< goes into Bullet's program that sets contacts up
extern const char* const kContactSolveSource;  ///< goes into Bullet's program that solves them

}  // namespace holdfast::internal
