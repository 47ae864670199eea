# The oracles: exact rationals and CGAL (GPL: in tests and benchmarks only).
find_package(CGAL REQUIRED)
osteon_link_system(osteon_hull_tests CGAL::CGAL)
