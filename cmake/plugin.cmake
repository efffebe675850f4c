# Plug-ins lie in a folder of their own below the libraries. It carries the version of the interface, so that of two
# versions on one machine each loads its own.
set(HOLDFAST_PLUGIN_FOLDER holdfast/${HOLDFAST_SOVERSION})

# A plug-in is loaded by its name (src/api/plugin_file.hpp), and shows nothing but what it marks.
function(holdfast_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${HOLDFAST_PLUGIN_FOLDER})
  target_link_options(${name} PRIVATE -Wl,--exclude-libs,ALL -Wl,--as-needed)
endfunction()
