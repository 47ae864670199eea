# A hundred thousand cuts take minutes: by themselves, and only where asked.
add_executable(osteon_tissue_long_tests
  "${CMAKE_CURRENT_SOURCE_DIR}/tissue/sheet/skin_many_cuts.cpp"
  "${CMAKE_CURRENT_SOURCE_DIR}/tissue/rod/rod_many_cuts.cpp")
target_link_libraries(osteon_tissue_long_tests PRIVATE osteon_flags osteon_tissue GTest::gtest_main)
target_include_directories(osteon_tissue_long_tests PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
osteon_use_test_headers(osteon_tissue_long_tests tissue)
gtest_discover_tests(osteon_tissue_long_tests TEST_PREFIX "tissue." DISCOVERY_MODE PRE_TEST
  PROPERTIES TIMEOUT 1800 LABELS exhaustive)
