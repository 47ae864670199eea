find_package(spdlog REQUIRED)
target_link_libraries(osteon_base PRIVATE spdlog::spdlog PUBLIC Threads::Threads)
# Where a build that was not installed finds its assets.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/base/file.cpp PROPERTIES
  COMPILE_DEFINITIONS "OSTEON_SOURCE_DIR=\"${CMAKE_SOURCE_DIR}\"")
