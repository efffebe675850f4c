#pragma once

// Highway 1.0.3 has no f64 vectors for WebAssembly. It emulates them with loops over their lanes, and clang makes SIMD
// of only some of these. The operations that the kernels spend their time with are single instructions here. The build
// includes this file before the kernels, whose calls then prefer these overloads to Highway's templates.

#include "core/native/solver/simd_targets.hpp"

#include <hwy/foreach_target.h>  // before highway.h: there is one target, and nothing is compiled again
#include <hwy/highway.h>
#include <wasm_simd128.h>

HWY_BEFORE_NAMESPACE();
namespace hwy::HWY_NAMESPACE {

using F64 = Simd<double, 2, 0>;
using F64Vector = Vec128<double, 2>;
using F64Mask = Mask128<double, 2>;

HWY_API v128_t wasm_of(F64Vector v) { return __builtin_bit_cast(v128_t, v); }
HWY_API v128_t wasm_of(F64Mask mask) { return __builtin_bit_cast(v128_t, mask); }
HWY_API F64Vector vector_of(v128_t v) { return __builtin_bit_cast(F64Vector, v); }
HWY_API F64Mask mask_of(v128_t v) { return __builtin_bit_cast(F64Mask, v); }

HWY_API F64Vector Load(F64, const double* from) { return vector_of(wasm_v128_load(from)); }
HWY_API void Store(F64Vector v, F64, double* to) { wasm_v128_store(to, wasm_of(v)); }
HWY_API F64Vector Set(F64, double value) { return vector_of(wasm_f64x2_splat(value)); }

HWY_API F64Vector Add(F64Vector a, F64Vector b) { return vector_of(wasm_f64x2_add(wasm_of(a), wasm_of(b))); }
HWY_API F64Vector Sub(F64Vector a, F64Vector b) { return vector_of(wasm_f64x2_sub(wasm_of(a), wasm_of(b))); }
HWY_API F64Vector Mul(F64Vector a, F64Vector b) { return vector_of(wasm_f64x2_mul(wasm_of(a), wasm_of(b))); }
HWY_API F64Vector Div(F64Vector a, F64Vector b) { return vector_of(wasm_f64x2_div(wasm_of(a), wasm_of(b))); }
HWY_API F64Vector Abs(F64Vector a) { return vector_of(wasm_f64x2_abs(wasm_of(a))); }
HWY_API F64Vector Sqrt(F64Vector a) { return vector_of(wasm_f64x2_sqrt(wasm_of(a))); }
// Of two numbers one of which is none, x86 takes the second one. So does a > b ? a : b, which pmax(b, a) is.
HWY_API F64Vector Max(F64Vector a, F64Vector b) { return vector_of(wasm_f64x2_pmax(wasm_of(b), wasm_of(a))); }
HWY_API F64Vector Min(F64Vector a, F64Vector b) { return vector_of(wasm_f64x2_pmin(wasm_of(b), wasm_of(a))); }

HWY_API F64Vector InterleaveLower(F64, F64Vector a, F64Vector b) {
  return vector_of(wasm_i64x2_shuffle(wasm_of(a), wasm_of(b), 0, 2));
}
HWY_API F64Vector InterleaveUpper(F64, F64Vector a, F64Vector b) {
  return vector_of(wasm_i64x2_shuffle(wasm_of(a), wasm_of(b), 1, 3));
}

HWY_API F64Mask Eq(F64Vector a, F64Vector b) { return mask_of(wasm_f64x2_eq(wasm_of(a), wasm_of(b))); }
HWY_API F64Mask Lt(F64Vector a, F64Vector b) { return mask_of(wasm_f64x2_lt(wasm_of(a), wasm_of(b))); }
HWY_API F64Mask Le(F64Vector a, F64Vector b) { return mask_of(wasm_f64x2_le(wasm_of(a), wasm_of(b))); }
HWY_API F64Mask Gt(F64Vector a, F64Vector b) { return mask_of(wasm_f64x2_gt(wasm_of(a), wasm_of(b))); }
HWY_API F64Mask Ge(F64Vector a, F64Vector b) { return mask_of(wasm_f64x2_ge(wasm_of(a), wasm_of(b))); }
HWY_API F64Mask And(F64Mask a, F64Mask b) { return mask_of(wasm_v128_and(wasm_of(a), wasm_of(b))); }
HWY_API F64Mask Or(F64Mask a, F64Mask b) { return mask_of(wasm_v128_or(wasm_of(a), wasm_of(b))); }
HWY_API F64Vector IfThenElse(F64Mask mask, F64Vector yes, F64Vector no) {
  return vector_of(wasm_v128_bitselect(wasm_of(yes), wasm_of(no), wasm_of(mask)));
}
HWY_API F64Vector IfThenElseZero(F64Mask mask, F64Vector yes) {
  return vector_of(wasm_v128_and(wasm_of(mask), wasm_of(yes)));
}

}  // namespace hwy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
