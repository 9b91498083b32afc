# Registers the tests of one GoogleTest executable when ctest starts, which includes this with
#   name     the executable's target
#   program  the executable; where it is not built, <name>_NOT_BUILT stands for its tests, and fails
#   list     where its tests' names are kept until it is built again or one of these values changes
#   filter   GoogleTest filter
#   labels, timeout_s, runs_alone, is_real_time  properties of its tests
# Every test is a process, called as GoogleTest calls it. With HLC_TESTS_BY_SUITE in the environment every suite of unit
# tests is one: three of four starts are saved (under asan one takes 0.1 s), and the output names the test that failed.
# Tests that drive in real time run alone; with HLC_REAL_TIME_TOGETHER in the environment in parallel with each other, if
# only these are selected: a run of three cars needs an eighth of a processor.
if(NOT EXISTS ${program})
  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)
  return()
endif()

if(NOT EXISTS ${list} OR NOT ${list} IS_NEWER_THAN ${program} OR NOT ${list} IS_NEWER_THAN ${CMAKE_PARENT_LIST_FILE})
  execute_process(COMMAND ${program} --gtest_list_tests "--gtest_filter=${filter}"
                  OUTPUT_FILE ${list} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    file(REMOVE ${list})
    message(FATAL_ERROR "${program} --gtest_list_tests: ${result}")
  endif()
endif()

if(is_real_time)
  list(APPEND labels real_time)
  if(NOT DEFINED ENV{HLC_REAL_TIME_TOGETHER})
    set(runs_alone ON)
  endif()
endif()

set(by_suite OFF)
if(DEFINED ENV{HLC_TESTS_BY_SUITE} AND "${labels}" MATCHES "^unit")
  set(by_suite ON)
endif()

# add(NAME FILTER): one process, which runs the tests that GoogleTest selects by the filter.
function(add test tests)
  add_test("${test}" ${program} "--gtest_filter=${tests}")
  set_tests_properties("${test}" PROPERTIES LABELS "${labels}" TIMEOUT ${timeout_s} RUN_SERIAL ${runs_alone})
  if(NOT by_suite) # of a suite, one skipped test would hide another that failed
    set_tests_properties("${test}" PROPERTIES SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
  endif()
endfunction()

# "Suite." on a line, then its tests, each behind two spaces; behind a name, perhaps, "  # GetParam() = ...".
file(STRINGS ${list} lines REGEX "^([A-Za-z0-9_/]+\\.( |$)|  [A-Za-z0-9_/]+)")
set(suites)
foreach(line IN LISTS lines)
  string(REGEX REPLACE " +#.*" "" text "${line}")
  if(text MATCHES "^[^ ]")
    set(suite "${text}")
    list(APPEND suites "${suite}")
    set(tests_of_${suite})
  else()
    string(STRIP "${text}" test)
    list(APPEND tests_of_${suite} "${suite}${test}")
  endif()
endforeach()
foreach(suite IN LISTS suites)
  if(by_suite)
    string(REGEX REPLACE "\\.$" "" test "${name}/${suite}") # suites of two executables may have one name
    set(tests "${suite}*")
    if(NOT filter STREQUAL "*") # which leaves out some tests of a suite
      string(JOIN ":" tests ${tests_of_${suite}})
    endif()
    add("${test}" "${tests}")
  else()
    foreach(test IN LISTS tests_of_${suite})
      add("${test}" "${test}")
    endforeach()
  endif()
endforeach()
