# What `cmake --install` puts where: the program with its plug-ins and page, the library with its headers, and what lets
# other projects find it. What the program alone needs is the component `program`.
include(CMakePackageConfigHelpers)

# Says what to build where a part of a component is not built: the error of an install rule names a file and no remedy.
function(holdfast_require_built component remedy)
  foreach(target ${ARGN})
    if(TARGET ${target})
      list(APPEND files $<TARGET_FILE:${target}>)
    endif()
  endforeach()
  install(CODE "
    set(holdfast_files \"${files}\")
    foreach(file IN LISTS holdfast_files)
      if(NOT EXISTS \"\${file}\")
        message(FATAL_ERROR \"\${file} is not built.\n${remedy}\")
      endif()
    endforeach()" COMPONENT ${component})
endfunction()

set(plugins holdfast-page-server holdfast-bullet holdfast-bullet-f64 holdfast-bullet-opencl)
holdfast_require_built(program "Build the program first:
    cmake --build ${CMAKE_BINARY_DIR} --target holdfast" holdfast)
holdfast_require_built(Unspecified "Build everything first:
    cmake --build ${CMAKE_BINARY_DIR}
or install the program alone:
    cmake --install ${CMAKE_BINARY_DIR} --component program" holdfast_library holdfast_core ${plugins} holdfast-mpi)

install(TARGETS holdfast RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
# The program alone works without plug-ins: `holdfast engines` says what builds those that are not there.
foreach(plugin ${plugins})
  if(TARGET ${plugin})
    install(TARGETS ${plugin} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${HOLDFAST_PLUGIN_FOLDER} COMPONENT program OPTIONAL)
  endif()
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/holdfast.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/holdfast.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME holdfast COMPONENT program)
if(TARGET holdfast-mpi)
  install(TARGETS holdfast-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(TARGETS holdfast_library holdfast_core EXPORT holdfastTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/holdfast DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/holdfast)
install(EXPORT holdfastTargets NAMESPACE holdfast:: DESTINATION ${package_folder})
configure_package_config_file(cmake/holdfastConfig.cmake.in ${PROJECT_BINARY_DIR}/holdfastConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/holdfastConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/holdfastConfig.cmake ${PROJECT_BINARY_DIR}/holdfastConfigVersion.cmake
  DESTINATION ${package_folder})

# The pkg-config file finds the others from where it lies itself: the prefix of `cmake --install` need not be that of the build.
file(RELATIVE_PATH HOLDFAST_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" HOLDFAST_PC_PREFIX "${HOLDFAST_PC_PREFIX}")
cmake_path(APPEND HOLDFAST_PC_LIBDIR "\${prefix}" ${CMAKE_INSTALL_LIBDIR})
cmake_path(APPEND HOLDFAST_PC_INCLUDEDIR "\${prefix}" ${CMAKE_INSTALL_INCLUDEDIR})
configure_file(cmake/holdfast.pc.in ${PROJECT_BINARY_DIR}/holdfast.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/holdfast.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
