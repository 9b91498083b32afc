# Writes -D output=<header> with -D release=<version> and the revision of the sources in -D source=<folder>; leaves the file alone
# if nothing has changed, so that nothing is built again.
cmake_minimum_required(VERSION 3.25)
execute_process(
  COMMAND git -C ${source} describe --always --dirty
  OUTPUT_VARIABLE revision
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
  RESULT_VARIABLE failed)
if(failed OR NOT revision)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${output} CONTENT "#define HLC_RELEASE \"@release@\"\n#define HLC_REVISION \"@revision@\"\n" @ONLY)
