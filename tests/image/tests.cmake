# Tests spoil series through GDCM and write pictures through OpenCV.
target_include_directories(osteon_image_tests SYSTEM PRIVATE ${GDCM_INCLUDE} ${OpenCV_INCLUDE_DIRS})
find_package(OpenCV REQUIRED COMPONENTS core imgcodecs)
target_include_directories(osteon_image_tests SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(osteon_image_tests PRIVATE ${GDCM_MSFF} ${GDCM_DSED} ${GDCM_DICT}
  ${GDCM_Common} opencv_core opencv_imgcodecs z)
