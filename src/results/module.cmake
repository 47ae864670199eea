find_package(SQLite3 REQUIRED)
find_package(nlohmann_json 3.9 REQUIRED)
find_library(HPDF_LIBRARY hpdf REQUIRED)
target_link_libraries(osteon_results PRIVATE SQLite::SQLite3 nlohmann_json::nlohmann_json
  ${HPDF_LIBRARY})
# A lab's server of results, and the learning record store that statements are sent to.
pkg_check_modules(PQXX REQUIRED IMPORTED_TARGET libpqxx)
osteon_link_system(osteon_results PkgConfig::PQXX)
find_package(CURL REQUIRED)
osteon_link_system(osteon_results CURL::libcurl)
