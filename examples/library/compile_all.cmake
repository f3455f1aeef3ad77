# Compiles each program of this folder by COMPILER, as a careful user does, with
# no header but those of face/ and spec/.
file(GLOB programs ${SOURCE_DIR}/examples/library/*.cpp)
list(FILTER programs EXCLUDE REGEX document_test)
foreach(program ${programs})
  execute_process(
    COMMAND ${COMPILER} -std=c++20 -Wall -Wextra -Wconversion -Wshadow -Werror
            -fsyntax-only -I${SOURCE_DIR}/face/include
            -I${SOURCE_DIR}/spec/include ${program}
    RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${COMPILER} does not compile ${program}")
  endif()
endforeach()
