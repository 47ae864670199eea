# STL, OBJ and PLY are read by our own strict code; assimp reads glTF.
find_package(assimp REQUIRED)
osteon_link_system(osteon_mesh assimp::assimp)
# Surface extraction runs when a case is loaded; a debug build gets the same bits, only sooner.
osteon_optimise_in_debug("${CMAKE_SOURCE_DIR}/src/mesh/surface/isosurface.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/surface/isosurface_grid.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/surface/surface_relax.cpp")
find_package(ZLIB REQUIRED)
osteon_link_system(osteon_mesh ZLIB::ZLIB)
find_package(meshoptimizer REQUIRED)
osteon_link_system(osteon_mesh meshoptimizer::meshoptimizer)
# Tetrahedra likewise.
osteon_optimise_in_debug("${CMAKE_SOURCE_DIR}/src/mesh/tet/bcc_lattice.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/surface/distance.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet/lattice_cuts.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet/stuffing.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet/tet_flips.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet/tet_smooth.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet/tet_work.cpp")
