# Tests spoil series through GDCM and write pictures through libpng and libtiff.
target_include_directories(osteon_image_tests SYSTEM PRIVATE ${GDCM_INCLUDE})
target_link_libraries(osteon_image_tests PRIVATE ${GDCM_MSFF} ${GDCM_DSED} ${GDCM_DICT}
  ${GDCM_Common} png tiff z)
