# STL, OBJ and PLY are read by our own strict code; assimp reads glTF.
find_package(assimp REQUIRED)
osteon_link_system(osteon_mesh assimp::assimp)
# Surface extraction runs when a case is loaded; a debug build gets the same bits, only sooner.
set_source_files_properties("${CMAKE_SOURCE_DIR}/src/mesh/isosurface.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/isosurface_grid.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/surface_relax.cpp"
  PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Debug>:-O2>" SKIP_PRECOMPILE_HEADERS ON)
find_package(meshoptimizer REQUIRED)
osteon_link_system(osteon_mesh meshoptimizer::meshoptimizer)
# Tetrahedra likewise.
set_source_files_properties("${CMAKE_SOURCE_DIR}/src/mesh/bcc_lattice.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/distance.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/lattice_cuts.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/stuffing.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet_flips.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet_smooth.cpp"
  "${CMAKE_SOURCE_DIR}/src/mesh/tet_work.cpp"
  PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Debug>:-O2>" SKIP_PRECOMPILE_HEADERS ON)
