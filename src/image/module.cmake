# GDCM reads and writes DICOM, zlib unpacks, OpenCV reads picture slices and works on them. GDCM's own
# CMake files ask for tools that the library does not need, so it is found by hand.
find_path(GDCM_INCLUDE gdcmReader.h PATH_SUFFIXES gdcm-3.0 gdcm-3.2 REQUIRED)
foreach(part MSFF DSED DICT Common)
  find_library(GDCM_${part} gdcm${part} REQUIRED)
  target_link_libraries(osteon_image PRIVATE ${GDCM_${part}})
endforeach()
target_include_directories(osteon_image SYSTEM PRIVATE ${GDCM_INCLUDE})
pkg_check_modules(OSTEON_ZLIB REQUIRED IMPORTED_TARGET zlib)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs)
target_link_libraries(osteon_image PRIVATE PkgConfig::OSTEON_ZLIB PkgConfig::TOMLPLUSPLUS
  opencv_core opencv_imgproc opencv_imgcodecs)
target_include_directories(osteon_image SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
# Scans are large; a debug build works through them with the same bits, only sooner.
foreach(file components fill distance_map watershed gaussian volume)
  if(EXISTS "${CMAKE_SOURCE_DIR}/src/image/${file}.cpp")
    set_source_files_properties("${CMAKE_SOURCE_DIR}/src/image/${file}.cpp"
      PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Debug>:-O2>" SKIP_PRECOMPILE_HEADERS ON)
  endif()
endforeach()
