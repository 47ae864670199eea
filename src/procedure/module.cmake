find_package(nlohmann_json 3.9 REQUIRED)
target_link_libraries(osteon_procedure PRIVATE nlohmann_json::nlohmann_json)
