# The oracle of tunnels (GPL: in tests and benchmarks only). Optimised, g++ 12 warns of its insides.
find_package(CGAL REQUIRED)
set(tunnel_oracle "${CMAKE_CURRENT_SOURCE_DIR}/carve/tunnel_oracle.cpp")
set_source_files_properties("${tunnel_oracle}" PROPERTIES
  COMPILE_OPTIONS "$<$<CONFIG:Release>:-O2>;$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>"
  SKIP_PRECOMPILE_HEADERS ON)
target_sources(osteon_carve_tests PRIVATE "${tunnel_oracle}")
osteon_link_system(osteon_carve_tests CGAL::CGAL)
target_link_libraries(osteon_carve_tests PRIVATE gmp mpfr)
target_sources(osteon_carve_tests PRIVATE "${CMAKE_SOURCE_DIR}/tests/count_allocations.cpp")
# A hundred tunnels in each of four bones take minutes: by themselves, and only where asked.
add_executable(osteon_carve_long_tests
  "${CMAKE_CURRENT_SOURCE_DIR}/carve/tunnels_in_bones.cpp" "${tunnel_oracle}")
target_link_libraries(osteon_carve_long_tests PRIVATE osteon_flags osteon_carve osteon_anatomy
  GTest::gtest_main gmp mpfr)
osteon_link_system(osteon_carve_long_tests CGAL::CGAL)
target_include_directories(osteon_carve_long_tests PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
target_compile_definitions(osteon_carve_long_tests PRIVATE
  OSTEON_SOURCE_DIR="${CMAKE_SOURCE_DIR}" OSTEON_BINARY_DIR="${CMAKE_BINARY_DIR}")
osteon_use_test_headers(osteon_carve_long_tests carve)
gtest_discover_tests(osteon_carve_long_tests TEST_PREFIX "carve." DISCOVERY_MODE PRE_TEST
  PROPERTIES TIMEOUT 1800 LABELS exhaustive)
