find_package(tomlplusplus REQUIRED)
osteon_link_system(osteon_anatomy tomlplusplus::tomlplusplus)
# Millions of field values a wrist: without optimisation a debug build would take minutes to start.
# The results are the same bits.
osteon_optimise_in_debug("${CMAKE_SOURCE_DIR}/src/anatomy/describe/shape.cpp"
  "${CMAKE_SOURCE_DIR}/src/anatomy/describe/crack.cpp"
  "${CMAKE_SOURCE_DIR}/src/anatomy/bone/near_solid.cpp"
  "${CMAKE_SOURCE_DIR}/src/anatomy/soft/near_band.cpp"
  "${CMAKE_SOURCE_DIR}/src/anatomy/bone/bone_field.cpp"
  "${CMAKE_SOURCE_DIR}/src/anatomy/soft/skin_field.cpp")
