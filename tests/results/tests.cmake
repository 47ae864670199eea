find_package(SQLite3 REQUIRED)
target_link_libraries(osteon_results_tests PRIVATE nlohmann_json::nlohmann_json SQLite::SQLite3)
