if(HALFSPACE_SANITIZE)
  add_compile_options(-fsanitize=${HALFSPACE_SANITIZE}
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${HALFSPACE_SANITIZE})
endif()
