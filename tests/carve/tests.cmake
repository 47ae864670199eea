# The oracle of tunnels (GPL: in tests and benchmarks only). Optimised, g++ 12 warns of its insides.
find_package(CGAL REQUIRED)
set(tunnel_oracle "${CMAKE_CURRENT_SOURCE_DIR}/carve/tunnel_oracle.cpp")
# A library of its own: two programs use what takes a minute to compile.
add_library(osteon_tunnel_oracle STATIC "${tunnel_oracle}")
target_compile_options(osteon_tunnel_oracle PRIVATE
  $<$<CONFIG:Release>:-O1> $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
target_link_libraries(osteon_tunnel_oracle PRIVATE osteon_flags PUBLIC osteon_mesh gmp mpfr)
target_include_directories(osteon_tunnel_oracle PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
osteon_link_system(osteon_tunnel_oracle CGAL::CGAL)
target_link_libraries(osteon_carve_tests PRIVATE osteon_tunnel_oracle)
target_sources(osteon_carve_tests PRIVATE "${CMAKE_SOURCE_DIR}/tests/count_allocations.cpp")
# A hundred tunnels in each of four bones take minutes: by themselves, and only where asked.
add_executable(osteon_carve_long_tests
  "${CMAKE_CURRENT_SOURCE_DIR}/carve/tunnels_in_bones.cpp")
target_link_libraries(osteon_carve_long_tests PRIVATE osteon_flags osteon_carve osteon_anatomy
  osteon_tunnel_oracle GTest::gtest_main)
target_include_directories(osteon_carve_long_tests PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
target_compile_definitions(osteon_carve_long_tests PRIVATE
  OSTEON_SOURCE_DIR="${CMAKE_SOURCE_DIR}" OSTEON_BINARY_DIR="${CMAKE_BINARY_DIR}")
osteon_use_test_headers(osteon_carve_long_tests carve)
gtest_discover_tests(osteon_carve_long_tests TEST_PREFIX "carve." DISCOVERY_MODE PRE_TEST
  PROPERTIES TIMEOUT 1800 LABELS exhaustive)
