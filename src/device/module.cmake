find_package(tomlplusplus REQUIRED)
pkg_check_modules(LIBUSB REQUIRED IMPORTED_TARGET libusb-1.0)
osteon_link_system(osteon_device tomlplusplus::tomlplusplus PkgConfig::LIBUSB)

# Vendors' libraries are loaded at run time: one of two files knows how.
target_link_libraries(osteon_device PRIVATE ${CMAKE_DL_LIBS})
if(WIN32)
  set(other_loader "posix")
else()
  set(other_loader "windows")
endif()
set_source_files_properties("${CMAKE_SOURCE_DIR}/src/device/phantom/shared_library_${other_loader}.cpp"
  PROPERTIES HEADER_FILE_ONLY ON)
