# Discs of drawn patients; skin is palpated on generated knees.
target_link_libraries(osteon_physics_tests PRIVATE osteon_anatomy)
# Twenty patients with each tear, and a hundred thousand cuts, take minutes: by themselves, and only
# where asked.
add_executable(osteon_physics_long_tests
  "${CMAKE_CURRENT_SOURCE_DIR}/physics/soft/every_patients_disc.cpp"
  "${CMAKE_CURRENT_SOURCE_DIR}/physics/soft/solid_many_cuts.cpp")
target_link_libraries(osteon_physics_long_tests PRIVATE osteon_flags osteon_physics osteon_anatomy
  GTest::gtest_main)
target_include_directories(osteon_physics_long_tests PRIVATE
  "${CMAKE_SOURCE_DIR}/src/physics" "${CMAKE_CURRENT_SOURCE_DIR}")
target_compile_definitions(osteon_physics_long_tests PRIVATE OSTEON_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
osteon_use_test_headers(osteon_physics_long_tests physics)
gtest_discover_tests(osteon_physics_long_tests TEST_PREFIX "physics." DISCOVERY_MODE PRE_TEST
  PROPERTIES TIMEOUT 1800 LABELS exhaustive)
