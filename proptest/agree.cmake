# The agreement tests: `fast` decides what `ref` decides.
add_library(halfspace_agree_scenes
  ${CMAKE_CURRENT_LIST_DIR}/agree_scenes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/agree_solids.cpp)
halfspace_target(halfspace_agree_scenes)
target_link_libraries(halfspace_agree_scenes PUBLIC halfspace::fast
                                                    halfspace::spec)

foreach(stem IN ITEMS agree_blend agree_boolean agree_boolean_shadow
                agree_display_tree agree_image
                agree_shadow agree_tree)
  add_executable(${stem}_test
    ${CMAKE_CURRENT_LIST_DIR}/${stem}_test.cpp)
  halfspace_test_target(${stem}_test)
  target_link_libraries(${stem}_test PRIVATE halfspace_agree_scenes
                        halfspace::fast halfspace::ref halfspace::shadow
                        GTest::gtest_main)
  gtest_discover_tests(${stem}_test PROPERTIES LABELS agree)
endforeach()

# The same bytes by every compiler: tools/determinism.sh tries others.
add_executable(determinism ${CMAKE_CURRENT_LIST_DIR}/determinism.cpp)
halfspace_target(determinism)
target_link_libraries(determinism PRIVATE
  halfspace_agree_scenes halfspace::fast halfspace::io halfspace::ref)
add_test(NAME Determinism.TheBytesAreThoseOfEveryCompiler
  COMMAND determinism ${CMAKE_CURRENT_LIST_DIR}/determinism.txt)
set_tests_properties(Determinism.TheBytesAreThoseOfEveryCompiler
                     PROPERTIES LABELS agree)
