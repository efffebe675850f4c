# Debian 12's packages; tools/install_dependencies.sh installs them, docs/architecture.md says why each is there.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(TBB REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)
find_package(HDF5 1.10 REQUIRED COMPONENTS C)
find_package(PkgConfig REQUIRED)
pkg_check_modules(inih REQUIRED IMPORTED_TARGET inih)
pkg_check_modules(libdeflate REQUIRED IMPORTED_TARGET libdeflate)
if(HOLDFAST_OPENMP)
  find_package(OpenMP REQUIRED COMPONENTS CXX)
endif()

# HDF5's CMake module of Debian gives variables only.
add_library(holdfast_hdf5 INTERFACE)
target_include_directories(holdfast_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(holdfast_hdf5 INTERFACE ${HDF5_C_LIBRARIES})
