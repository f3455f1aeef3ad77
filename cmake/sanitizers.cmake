if(HALFSPACE_SANITIZE)
  add_compile_options(-fsanitize=${HALFSPACE_SANITIZE}
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${HALFSPACE_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # False there, as GCC's manual says; builds without sanitizers look for it.
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
  if(HALFSPACE_SANITIZE MATCHES "address")
    # What these would see ends in a fault of memory, and the code for them
    # takes an eighth of the time it is compiled in.
    add_compile_options(-fno-sanitize=null,object-size,vptr)
    if(NOT HALFSPACE_LIBFUZZER)
      # A third more. A pointer that left its array is found where it is used;
      # only long campaigns look at addresses that are not used, and at their
      # alignment.
      add_compile_options(-fno-sanitize=alignment,pointer-overflow)
    endif()
  endif()
endif()
if(HALFSPACE_LIBFUZZER)
  # The libraries too, so that the fuzzer sees which of their code an input
  # reaches; the targets of fuzz/ link its main program.
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
