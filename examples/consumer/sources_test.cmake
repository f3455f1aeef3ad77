# Configures the consumer with Halfspace's SOURCES in place of a package, by
# add_subdirectory() or, with FETCH, by FetchContent, and compiles it.
#
#   cmake -D SOURCES=... -D SOURCE_DIR=... -D WORK_DIR=... -D GENERATOR=...
#         -D COMPILER=... -D FETCH=... -P sources_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${status}): ${command}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR} -G ${GENERATOR}
    -D SOURCES=${SOURCES} -D FETCH=${FETCH} -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=${COMPILER})
set(object library.cpp.o)
if(GENERATOR MATCHES Ninja)
  set(object CMakeFiles/library.dir/library.cpp.o)
endif()
run(${CMAKE_COMMAND} --build ${WORK_DIR} --target ${object})
if(NOT EXISTS ${WORK_DIR}/CMakeFiles/library.dir/library.cpp.o)
  message(FATAL_ERROR "the consumer was not compiled")
endif()
