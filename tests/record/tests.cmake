# Tampering goes around the library's own code.
target_link_libraries(osteon_record_tests PRIVATE SQLite::SQLite3)
