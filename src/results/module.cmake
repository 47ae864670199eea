find_package(SQLite3 REQUIRED)
find_package(nlohmann_json 3.9 REQUIRED)
find_library(HPDF_LIBRARY hpdf REQUIRED)
target_link_libraries(osteon_results PRIVATE SQLite::SQLite3 nlohmann_json::nlohmann_json
  ${HPDF_LIBRARY})
