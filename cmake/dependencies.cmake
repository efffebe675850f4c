# Debian 12's packages; tools/install_dependencies.sh installs them, docs/develop/architecture.md says why each is there.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(hwy 1.0 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(TBB REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)
find_package(HDF5 1.10 REQUIRED COMPONENTS C)
find_package(PkgConfig REQUIRED)
pkg_check_modules(inih REQUIRED IMPORTED_TARGET inih)
pkg_check_modules(libdeflate REQUIRED IMPORTED_TARGET libdeflate)
find_package(ZLIB REQUIRED)
if(HOLDFAST_OPENMP)
  find_package(OpenMP REQUIRED COMPONENTS CXX)
endif()

# Of OpenSSL one hash is used: linked statically where it can be, that is a few pages instead of a library that takes the
# loader a millisecond.
add_library(holdfast_crypto INTERFACE)
target_include_directories(holdfast_crypto SYSTEM INTERFACE ${OPENSSL_INCLUDE_DIR})
get_filename_component(crypto_folder ${OPENSSL_CRYPTO_LIBRARY} DIRECTORY)
find_library(HOLDFAST_CRYPTO_STATIC NAMES libcrypto.a HINTS ${crypto_folder} NO_DEFAULT_PATH)
if(HOLDFAST_CRYPTO_STATIC)
  target_link_libraries(holdfast_crypto INTERFACE ${HOLDFAST_CRYPTO_STATIC} ${CMAKE_DL_LIBS})
else()
  target_link_libraries(holdfast_crypto INTERFACE OpenSSL::Crypto)
endif()

# HDF5's CMake module of Debian gives variables only.
add_library(holdfast_hdf5 INTERFACE)
target_include_directories(holdfast_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
# Debian's shared library draws in a client for the web and thirty libraries more, 7 ms at every start: programs take the
# static one, whose part for the web is left out when linking. It cannot be part of a shared library, which takes the
# shared one.
list(GET HDF5_C_LIBRARIES 0 hdf5_shared)
get_filename_component(hdf5_folder ${hdf5_shared} DIRECTORY)
find_library(HOLDFAST_HDF5_STATIC NAMES libhdf5.a hdf5/serial/libhdf5.a HINTS ${hdf5_folder} ${hdf5_folder}/hdf5/serial NO_DEFAULT_PATH)
find_library(HOLDFAST_SZIP NAMES sz)
if(HOLDFAST_HDF5_STATIC AND HOLDFAST_SZIP)
  set(in_library $<STREQUAL:$<TARGET_PROPERTY:TYPE>,SHARED_LIBRARY>)
  add_library(holdfast_hdf5_static INTERFACE)
  target_link_libraries(holdfast_hdf5_static INTERFACE ${HOLDFAST_HDF5_STATIC} ${HOLDFAST_SZIP} ZLIB::ZLIB ${CMAKE_DL_LIBS} m)
  # Sanitizers have an allocator of their own, and end a program that asks it for too much.
  if(NOT HOLDFAST_SANITIZE)
    add_library(holdfast_hdf5_memory STATIC ${PROJECT_SOURCE_DIR}/src/io/results/hdf5_memory.cpp)
    target_link_libraries(holdfast_hdf5_static INTERFACE holdfast_hdf5_memory)
    target_link_options(holdfast_hdf5 INTERFACE $<$<NOT:${in_library}>:-Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc>)
  endif()
  target_link_libraries(holdfast_hdf5 INTERFACE
    $<${in_library}:${HDF5_C_LIBRARIES}> $<$<NOT:${in_library}>:holdfast_hdf5_static>)
else()
  target_link_libraries(holdfast_hdf5 INTERFACE ${HDF5_C_LIBRARIES})
endif()
