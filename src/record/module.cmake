find_package(SQLite3 REQUIRED)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
target_link_libraries(osteon_record PRIVATE SQLite::SQLite3 PkgConfig::zstd)
