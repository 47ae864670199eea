# CGAL solves a share of the contact programmes with exact numbers, as an independent judge.
target_link_libraries(osteon_collide_tests PRIVATE gmp mpfr)
