find_package(tomlplusplus REQUIRED)
osteon_link_system(osteon_tissue tomlplusplus::tomlplusplus)

# The loops over rows of cubes, once for each width of registers; a debug build gets the same bits,
# only sooner.
set(rows base)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND rows avx2 avx512)
  set_property(SOURCE "${CMAKE_SOURCE_DIR}/src/tissue/hex/hex_row_avx2.cpp"
    APPEND PROPERTY COMPILE_OPTIONS -mavx2)
  set_property(SOURCE "${CMAKE_SOURCE_DIR}/src/tissue/hex/hex_row_avx512.cpp"
    APPEND PROPERTY COMPILE_OPTIONS -mavx512f)
else()
  set_source_files_properties("${CMAKE_SOURCE_DIR}/src/tissue/hex/hex_row_avx2.cpp"
    "${CMAKE_SOURCE_DIR}/src/tissue/hex/hex_row_avx512.cpp" PROPERTIES HEADER_FILE_ONLY ON)
endif()
foreach(row IN LISTS rows)
  set_property(SOURCE "${CMAKE_SOURCE_DIR}/src/tissue/hex/hex_row_${row}.cpp"
    APPEND PROPERTY COMPILE_OPTIONS "$<$<CONFIG:Debug>:-O2>")
  set_source_files_properties("${CMAKE_SOURCE_DIR}/src/tissue/hex/hex_row_${row}.cpp" PROPERTIES
    SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endforeach()
