find_package(tomlplusplus REQUIRED)
osteon_link_system(osteon_tissue tomlplusplus::tomlplusplus)

# The loops over rows of cubes, along rods and over tetrahedra, once for each width of registers; a debug build gets
# the same bits, only sooner.
set(rows hex/hex_row rod/rod_rows tet/tet_rows)
set(widths base)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND widths avx2 avx512)
endif()
foreach(row IN LISTS rows)
  set(row "${CMAKE_SOURCE_DIR}/src/tissue/${row}")
  foreach(width IN LISTS widths)
    set_property(SOURCE "${row}_${width}.cpp" APPEND PROPERTY COMPILE_OPTIONS
      "$<$<CONFIG:Debug>:-O2>" -fno-math-errno)
    set_source_files_properties("${row}_${width}.cpp" PROPERTIES
      SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  endforeach()
  if("avx2" IN_LIST widths)
    set_property(SOURCE "${row}_avx2.cpp" APPEND PROPERTY COMPILE_OPTIONS -mavx2)
    set_property(SOURCE "${row}_avx512.cpp" APPEND PROPERTY COMPILE_OPTIONS -mavx512f)
  else()
    set_source_files_properties("${row}_avx2.cpp" "${row}_avx512.cpp" PROPERTIES
      HEADER_FILE_ONLY ON)
  endif()
endforeach()
