# The closed loop needs an emulated user.
target_link_libraries(osteon_session_tests PRIVATE osteon_device)
target_link_libraries(osteon_session_tests PRIVATE nlohmann_json::nlohmann_json)
# Counts what a tick takes from the heap.
target_sources(osteon_session_tests PRIVATE "${CMAKE_SOURCE_DIR}/tests/count_allocations.cpp")
