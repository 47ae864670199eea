# A stand-in for the vendor's library, loaded at run time as the real one is, and one without the
# calls.
add_library(osteon_stub_hd MODULE
  "${CMAKE_CURRENT_SOURCE_DIR}/device/phantom/stub_hd/stub_hd.cpp"
  "${CMAKE_SOURCE_DIR}/src/device/virtual_hand.cpp")
target_link_libraries(osteon_stub_hd PRIVATE osteon_flags Eigen3::Eigen Threads::Threads)
target_include_directories(osteon_stub_hd PRIVATE "${CMAKE_SOURCE_DIR}/src/device/phantom")
add_library(osteon_old_hd MODULE "${CMAKE_CURRENT_SOURCE_DIR}/device/phantom/stub_hd/old_hd.cpp")
target_link_libraries(osteon_old_hd PRIVATE osteon_flags)
add_dependencies(osteon_device_tests osteon_stub_hd osteon_old_hd)
target_link_libraries(osteon_device_tests PRIVATE ${CMAKE_DL_LIBS})
target_compile_definitions(osteon_device_tests PRIVATE
  STUB_HD="$<TARGET_FILE:osteon_stub_hd>" OLD_HD="$<TARGET_FILE:osteon_old_hd>")

# Emulated devices that more than one test program plays with.
add_library(osteon_emulated_devices STATIC
  "${CMAKE_CURRENT_SOURCE_DIR}/device/falcon/emulated_falcon.cpp")
target_link_libraries(osteon_emulated_devices PRIVATE osteon_flags PUBLIC osteon_device)
target_include_directories(osteon_emulated_devices PUBLIC
  "${CMAKE_SOURCE_DIR}/src/device" "${CMAKE_CURRENT_SOURCE_DIR}")
target_link_libraries(osteon_device_tests PRIVATE osteon_emulated_devices)

# The whole simulator through each driver.
add_subdirectory(drivers)
