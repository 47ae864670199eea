find_package(nlohmann_json 3.9 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
target_link_libraries(osteon_procedure PRIVATE nlohmann_json::nlohmann_json
  PkgConfig::TOMLPLUSPLUS)
