# Filling every built-in soft part and bending many knees takes minutes of one core: by itself, and
# only where asked.
add_executable(osteon_anatomy_long_tests "${CMAKE_CURRENT_SOURCE_DIR}/anatomy/soft/every_soft_filled.cpp"
  "${CMAKE_CURRENT_SOURCE_DIR}/anatomy/soft/every_portal_placed.cpp")
target_link_libraries(osteon_anatomy_long_tests PRIVATE osteon_flags osteon_anatomy GTest::gtest_main)
target_include_directories(osteon_anatomy_long_tests PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
target_compile_definitions(osteon_anatomy_long_tests PRIVATE OSTEON_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
osteon_use_test_headers(osteon_anatomy_long_tests anatomy)
gtest_discover_tests(osteon_anatomy_long_tests TEST_PREFIX "anatomy." DISCOVERY_MODE PRE_TEST
  PROPERTIES TIMEOUT 900 LABELS exhaustive)
