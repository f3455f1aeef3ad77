# Every target of the project goes through this function: one set of flags.
function(halfspace_target target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
    # No contraction: a filter's error bound counts every rounding.
    -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND
     CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 warns falsely of overlap in `"x" + std::string` (GCC PR 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(HALFSPACE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# Libraries in which time is spent: with -O2, which the preset release has for
# all else, booleans take 1.07 to 1.14 times as long, and reading an STL file
# 1.07 to 1.11 times.
function(halfspace_hot_target target)
  halfspace_target(${target})
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug" AND
     NOT HALFSPACE_WEB STREQUAL "MODULE")
    target_compile_options(${target} PRIVATE -O3)
  endif()
endfunction()

# Tests and the program: what they compute with is in the libraries, which are
# optimised more.
function(halfspace_test_target target)
  halfspace_target(${target})
  target_compile_options(${target} PRIVATE ${HALFSPACE_TEST_OPTIONS})
endfunction()

# Unit tests of rooms that do all of the work: optimising them takes nearly half
# of the time they are compiled in (io's 25.6 s, without it 14.5).
function(halfspace_unit_test_target target)
  halfspace_test_target(${target})
  if(HALFSPACE_TEST_OPTIONS)
    target_compile_options(${target} PRIVATE -O0)
  endif()
endfunction()

# Sources of a target that a unity build compiles as one: what they name for
# themselves must differ. Those in no group are compiled alone. Small groups can
# be one unit, since reading headers takes longer than their own code: that of
# group g is named by unit_of_g.
function(halfspace_unity_group target group)
  if(DEFINED unit_of_${group})
    set(group ${unit_of_${group}})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target}
    PROPERTIES UNITY_GROUP ${group})
endfunction()

# Every folder under src is a group, and what lies in src itself is one.
function(halfspace_unity_folders target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    string(REGEX REPLACE "^src/([^/]+).*" "\\1" folder ${folder})
    halfspace_unity_group(${target} ${folder} ${source})
  endforeach()
endfunction()

# The tests of a room, beside which this CMakeLists.txt stands: they are listed
# there and nowhere else. They are one unity group, unless they are kept APART.
function(halfspace_test_room target)
  cmake_parse_arguments(room APART "" "" ${ARGN})
  target_sources(${target} PRIVATE ${room_UNPARSED_ARGUMENTS})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME name)
  if(NOT room_APART)
    halfspace_unity_group(${target} ${name} ${room_UNPARSED_ARGUMENTS})
  endif()
endfunction()
