# The window: GLFW for the display, Dear ImGui (with its GLFW and OpenGL 3 backends, which Debian
# compiles into the library) for the panels, epoxy for OpenGL's entry points.
if(OSTEON_WINDOW)
  pkg_check_modules(GLFW REQUIRED IMPORTED_TARGET glfw3)
  pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
  pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
  osteon_link_system(osteon_app PkgConfig::IMGUI PkgConfig::GLFW PkgConfig::EPOXY)
  osteon_link_system(osteon_commands PkgConfig::IMGUI PkgConfig::GLFW PkgConfig::EPOXY)
endif()
target_link_libraries(osteon_app PRIVATE ${CMAKE_DL_LIBS} Threads::Threads)

# One of the two files that know the operating system's clock and scheduler.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  set_source_files_properties("${CMAKE_CURRENT_SOURCE_DIR}/loops/realtime_portable.cpp"
    PROPERTIES HEADER_FILE_ONLY ON)
else()
  set_source_files_properties("${CMAKE_CURRENT_SOURCE_DIR}/loops/realtime_linux.cpp"
    PROPERTIES HEADER_FILE_ONLY ON)
endif()

# Recordings as HDF5 files: the serial library's C interface.
pkg_search_module(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial hdf5)
osteon_link_system(osteon_app PkgConfig::HDF5)
