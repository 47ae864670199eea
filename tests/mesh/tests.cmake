# The oracle of self-crossings (GPL: in tests and benchmarks only).
find_package(CGAL REQUIRED)
osteon_link_system(osteon_mesh_tests CGAL::CGAL)
