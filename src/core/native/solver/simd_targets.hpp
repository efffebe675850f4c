#pragma once

// Comes before Highway wherever kernels are compiled.

// Vectors are kept in arrays, which scalable ones cannot be.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
