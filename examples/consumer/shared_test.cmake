# Checks the shared LIBRARY: its SONAME is that, with a version; it needs no
# other library of Halfspace; it shows no symbols but those of its interface.
#
#   cmake -D LIBRARY=... -D SONAME=... -P shared_test.cmake
find_program(READELF readelf REQUIRED)
find_program(NM nm REQUIRED)
execute_process(COMMAND ${READELF} -d ${LIBRARY} OUTPUT_VARIABLE dynamic
                COMMAND_ERROR_IS_FATAL ANY)
if(NOT SONAME MATCHES "^libhalfspace\\.so\\.[0-9]+\\.[0-9]+$" OR
   NOT dynamic MATCHES "SONAME[^\n]*\\[${SONAME}\\]")
  message(FATAL_ERROR "the soname is not ${SONAME}:\n${dynamic}")
endif()
if(dynamic MATCHES "NEEDED[^\n]*libhalfspace")
  message(FATAL_ERROR "it needs another library of Halfspace:\n${dynamic}")
endif()
execute_process(COMMAND ${NM} -D -C --defined-only ${LIBRARY}
                OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "," symbols "${symbols}")
string(REGEX REPLACE "\n" ";" symbols "${symbols}")
set(count 0)
foreach(symbol ${symbols})
  string(REGEX REPLACE "^[0-9a-f]+ [A-Za-z] " "" name "${symbol}")
  # Functions of the interface, and types of it that are thrown or compared.
  if(name MATCHES "^(typeinfo (name )?for |vtable for )?halfspace(::|_)" AND
     NOT name MATCHES "halfspace::(fast|ref|io|csg|shadow|detail)::" AND
     NOT name MATCHES "::State::")
    math(EXPR count "${count} + 1")
  else()
    list(APPEND others "${symbol}")
  endif()
endforeach()
if(others)
  list(JOIN others "\n" others)
  message(FATAL_ERROR "symbols that are not of the interface:\n${others}")
endif()
if(count LESS 50)
  message(FATAL_ERROR "only ${count} symbols")
endif()
