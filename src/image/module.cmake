# GDCM reads and writes DICOM, zlib unpacks, libpng and libtiff read picture slices, OpenCV works on
# them. GDCM's own CMake files ask for tools that the library does not need, so it is found by hand.
find_path(GDCM_INCLUDE gdcmReader.h PATH_SUFFIXES gdcm-3.0 gdcm-3.2 REQUIRED)
foreach(part MSFF DSED DICT Common)
  find_library(GDCM_${part} gdcm${part} REQUIRED)
  target_link_libraries(osteon_image PRIVATE ${GDCM_${part}})
endforeach()
target_include_directories(osteon_image SYSTEM PRIVATE ${GDCM_INCLUDE})
pkg_check_modules(OSTEON_ZLIB REQUIRED IMPORTED_TARGET zlib)
# Not through OpenCV's imgcodecs: Debian's loads GDAL with over a hundred libraries, which made every
# start of the program 0.15 s longer.
pkg_check_modules(OSTEON_PNG REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(OSTEON_TIFF REQUIRED IMPORTED_TARGET libtiff-4)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
find_package(OpenCV REQUIRED COMPONENTS core imgproc)
target_link_libraries(osteon_image PRIVATE PkgConfig::OSTEON_ZLIB PkgConfig::TOMLPLUSPLUS
  PkgConfig::OSTEON_PNG PkgConfig::OSTEON_TIFF opencv_core opencv_imgproc)
target_include_directories(osteon_image SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
# Scans are large; a debug build works through them with the same bits, only sooner.
foreach(file components fill distance_map watershed gaussian volume)
  if(EXISTS "${CMAKE_SOURCE_DIR}/src/image/${file}.cpp")
    osteon_optimise_in_debug("${CMAKE_SOURCE_DIR}/src/image/${file}.cpp")
  endif()
endforeach()
