# OpenGL 3.3 through libepoxy, EGL for pictures without a window, libpng to save pictures,
# meshoptimizer for coarser bones.
pkg_check_modules(OSTEON_EPOXY REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(OSTEON_EGL REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(OSTEON_PNG REQUIRED IMPORTED_TARGET libpng)
target_link_libraries(osteon_render PRIVATE PkgConfig::OSTEON_EPOXY PkgConfig::OSTEON_EGL
  PkgConfig::OSTEON_PNG)
find_package(meshoptimizer REQUIRED)
osteon_link_system(osteon_render meshoptimizer::meshoptimizer)
# EGL's header and OpenGL's do not go together in every order.
set_source_files_properties("${CMAKE_SOURCE_DIR}/src/render/gl/offscreen_context.cpp"
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
