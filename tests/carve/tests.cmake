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
