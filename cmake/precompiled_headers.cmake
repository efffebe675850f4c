# What nearly every source reads of libraries that do not change: parsing it is two thirds of the time of a build.
# Targets with equal compiler options share one, by REUSE_FROM. A source still includes what it uses: the lint reads
# the sources without these.
function(holdfast_precompile_headers target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string>
    <string_view> <vector> <Eigen/Geometry> ${ARGN})
endfunction()
