# Toolchain: WebAssembly with SIMD128 by clang and Debian's wasi-libc and libc++.
#
# Headers of the host that hold nothing of the host (Boost, GLM, fmt) are taken
# from /usr/include through links in the build folder: that folder itself would
# bring the host's C library.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(HALFSPACE_WASM_CLANG 19 CACHE STRING "Version of clang, lld and libc++")
set(CMAKE_CXX_COMPILER clang++-${HALFSPACE_WASM_CLANG})
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_AR llvm-ar-${HALFSPACE_WASM_CLANG})
set(CMAKE_RANLIB llvm-ranlib-${HALFSPACE_WASM_CLANG})
set(CMAKE_EXECUTABLE_SUFFIX .wasm)

# No exceptions are thrown (STYLE 5); where memory ends, the module stops.
set(CMAKE_CXX_FLAGS_INIT
    "-msimd128 -mnontrapping-fptoint -mbulk-memory -msign-ext -mmutable-globals \
-fno-exceptions -fno-rtti -fno-threadsafe-statics \
-ffunction-sections -fdata-sections \
-D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION -DBOOST_NO_EXCEPTIONS \
-DBOOST_NO_RTTI -DBOOST_NO_TYPEID -DBOOST_LEXICAL_CAST_ASSUME_C_LOCALE \
-include ${CMAKE_CURRENT_LIST_DIR}/wasm_boost.hpp \
-include ${CMAKE_CURRENT_LIST_DIR}/wasm_sort.hpp")
# What a page loads is to be small; web/CMakeLists.txt has what is to be fast.
set(CMAKE_CXX_FLAGS_RELEASE "-Oz -DNDEBUG" CACHE STRING "")

set(headers ${CMAKE_BINARY_DIR}/host-headers)
if(NOT EXISTS ${headers})
  file(MAKE_DIRECTORY ${headers})
  foreach(name boost glm fmt)
    file(CREATE_LINK /usr/include/${name} ${headers}/${name} SYMBOLIC)
  endforeach()
endif()
include_directories(SYSTEM ${headers})
set(Boost_INCLUDE_DIR ${headers} CACHE PATH "" FORCE)
set(Boost_NO_BOOST_CMAKE ON)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
