# Installs the build in BUILD_DIR below WORK_DIR, then configures, builds and
# runs the consumer in SOURCE_DIR against what was installed.
#
#   cmake -D BUILD_DIR=... -D SOURCE_DIR=... -D WORK_DIR=... -D GENERATOR=...
#         -D COMPILER=... -D FLAGS=... -P install_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${status}): ${command}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
run(${WORK_DIR}/build/library)

# A component needs no package that only others use.
set(absent "")
foreach(package Boost ZLIB PNG glm)
  list(APPEND absent -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/fast -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D COMPONENT=fast ${absent}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/fast)
run(${WORK_DIR}/fast/library)

# The same without CMake.
find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG AND NOT FLAGS)
  file(GLOB_RECURSE package ${WORK_DIR}/prefix/halfspace.pc)
  cmake_path(GET package PARENT_PATH folder)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs halfspace
                  OUTPUT_VARIABLE options OUTPUT_STRIP_TRAILING_WHITESPACE)
  separate_arguments(options)
  run(${COMPILER} -std=c++20 ${SOURCE_DIR}/library.cpp ${options}
      -o ${WORK_DIR}/library)
  run(${WORK_DIR}/library)
endif()
