# Installs the libraries so that find_package(halfspace) gives halfspace::spec,
# halfspace::ref, halfspace::fast, halfspace::shadow, halfspace::io,
# halfspace::csg and, over them, halfspace::halfspace.
include(CMakePackageConfigHelpers)

set(HALFSPACE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/halfspace)

# Each target is a component, in a file of its own, so that nobody needs what a
# component that he does not use needs.
foreach(target spec ref fast io shadow csg face)
  get_target_property(component halfspace_${target} EXPORT_NAME)
  install(TARGETS halfspace_${target}
          EXPORT halfspace_${target}_targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT halfspace_${target}_targets
          NAMESPACE halfspace::
          FILE halfspace_${component}.cmake
          DESTINATION ${HALFSPACE_PACKAGE_DIR})
endforeach()
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/spec/include/
                  ${CMAKE_CURRENT_SOURCE_DIR}/ref/include/
                  ${CMAKE_CURRENT_SOURCE_DIR}/fast/include/
                  ${CMAKE_CURRENT_SOURCE_DIR}/shadow/include/
                  ${CMAKE_CURRENT_SOURCE_DIR}/io/include/
                  ${CMAKE_CURRENT_SOURCE_DIR}/csg/include/
                  ${CMAKE_CURRENT_SOURCE_DIR}/face/include/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# For users without CMake: what a static library needs goes with it. Paths are
# from the file itself, wherever the package is put.
file(RELATIVE_PATH HALFSPACE_PC_INCLUDE /${CMAKE_INSTALL_LIBDIR}/pkgconfig
     /${CMAKE_INSTALL_INCLUDEDIR})
set(HALFSPACE_PC_LIBS "-lhalfspace")
if(NOT HALFSPACE_SHARED)
  string(APPEND HALFSPACE_PC_LIBS " -lhalfspace_csg -lhalfspace_fast"
         " -lhalfspace_io -lhalfspace_ref -lhalfspace_spec -ltbb -lpng -lz")
  if(HALFSPACE_HAS_3MF)
    string(APPEND HALFSPACE_PC_LIBS " -lzip -lexpat")
  endif()
  if(HALFSPACE_REF_NUMBER STREQUAL "gmp")
    string(APPEND HALFSPACE_PC_LIBS " -lgmp")
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/halfspace.pc.in
               ${CMAKE_CURRENT_BINARY_DIR}/halfspace.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/halfspace.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/halfspaceConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/halfspaceConfig.cmake
  INSTALL_DESTINATION ${HALFSPACE_PACKAGE_DIR})
# Before 1.0 a minor release may change the interface.
write_basic_package_version_file(
  ${CMAKE_CURRENT_BINARY_DIR}/halfspaceConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/halfspaceConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/halfspaceConfigVersion.cmake
        DESTINATION ${HALFSPACE_PACKAGE_DIR})
