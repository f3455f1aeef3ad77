# Fails if one of OBJECTS has a function that the linker may take for that of
# another file, which may be compiled for fewer instructions.
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} -C ${object}
    OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]* [WVu] [^\n]*" shared "${symbols}")
  if(shared)
    message(FATAL_ERROR "${object} shares\n${shared}")
  endif()
endforeach()
