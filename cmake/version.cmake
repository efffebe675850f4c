# Writes version.cpp with the commit that is being built; run at every build, touches the file only on a change.
execute_process(
  COMMAND git describe --always --dirty --abbrev=12 --exclude=*
  WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
configure_file(${SOURCE_DIR}/src/api/version.cpp.in ${OUTPUT} @ONLY)
