#pragma once

namespace holdfast::internal {

/// The OpenCL C of this project: the files in `kernels/opencl/` at build time.
extern const char* const kWorldStepSource;     ///< a separate program
extern const char* const kContactSetupSource;  ///< inserted into Bullet's program that sets up contacts
extern const char* const kContactSolveSource;  ///< inserted into Bullet's program that solves contacts

}  // namespace holdfast::internal
