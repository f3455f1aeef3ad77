# Compiles each program of this folder by COMPILER, as a careful user does, with
# no header but those of face/ and spec/; and counts its lines, but for blank
# ones and comments.
set(most_picture 8)
set(most_drilled_part 12)
set(most_painter 15)
set(most_scan_lines 12)
set(most_errors 10)
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
  file(STRINGS ${program} lines REGEX "^ *[^ /]")
  list(LENGTH lines count)
  cmake_path(GET program STEM name)
  if(NOT count LESS_EQUAL most_${name})
    message(FATAL_ERROR "${program} has ${count} lines, over ${most_${name}}")
  endif()
endforeach()
