# A second build of the same code is quick where ccache is installed; nothing depends on it.
find_program(HOLDFAST_CCACHE ccache)
mark_as_advanced(HOLDFAST_CCACHE)
if(HOLDFAST_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${HOLDFAST_CCACHE})
  # What ccache asks for where headers are precompiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${HOLDFAST_CCACHE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endif()

# One target carries the flags that all of our code is compiled with.
add_library(holdfast_options INTERFACE)
target_include_directories(holdfast_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)

# Results must have the same bits whatever the compiler: no contraction of a*b+c, never -ffast-math.
target_compile_options(holdfast_options INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
  -Woverloaded-virtual -Wold-style-cast
  -Wno-missing-field-initializers)  # designated initialisers name what they set; the rest has defaults
# Nor whatever the processor: Eigen's vectorised sums of three or four numbers add in another order than its plain ones,
# and which of the two it takes depends on the instruction set that the compiler is allowed. Costs nothing that can be
# measured (docs/develop/notebook/2026-11-24_equal_bits.md); what needs SIMD has it from Highway.
target_compile_definitions(holdfast_options INTERFACE EIGEN_DONT_VECTORIZE)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns of overlaps and overflows inside std::string's own operator+ (GCC bugs 105651 and 105329).
  target_compile_options(holdfast_options INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
endif()
if(HOLDFAST_WARNINGS_AS_ERRORS)
  target_compile_options(holdfast_options INTERFACE -Werror)
endif()

if(HOLDFAST_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)  # coverage for libFuzzer; only its targets link its main
endif()
if(HOLDFAST_SANITIZE)
  add_compile_options(-fsanitize=${HOLDFAST_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${HOLDFAST_SANITIZE})
endif()
