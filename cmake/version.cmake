# Writes version.cpp with the commit that is being built; run at every build, touches the file only on a change.
execute_process(
  COMMAND git describe --always --dirty --abbrev=12 --exclude=*
  WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
# Sources that `git archive` has packed are told their commit in a file.
if(NOT commit)
  file(STRINGS ${SOURCE_DIR}/cmake/commit.txt commit LIMIT_INPUT 12)
  if(NOT commit MATCHES "^[0-9a-f]+$")
    set(commit unknown)
  endif()
endif()
configure_file(${SOURCE_DIR}/src/api/version.cpp.in ${OUTPUT} @ONLY)
