# Loops over rows of nodes become vectors only where the compiler need not keep errno and traps;
# neither changes a bit of a result.
set_source_files_properties("${CMAKE_SOURCE_DIR}/src/carve/field/cut_rows.cpp"
  PROPERTIES COMPILE_OPTIONS "-O3;-fno-math-errno;-fno-trapping-math" SKIP_PRECOMPILE_HEADERS ON)
# Fields are made and meshed at load; a debug build gets the same bits, only sooner.
osteon_optimise_in_debug("${CMAKE_SOURCE_DIR}/src/carve/field/make_uncut_field.cpp")
find_package(tomlplusplus REQUIRED)
osteon_link_system(osteon_carve tomlplusplus::tomlplusplus)
