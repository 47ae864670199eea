#FFmpeg's headers alone: its libraries are loaded when a film is begun, see libav.h.
pkg_check_modules(OSTEON_AV REQUIRED libavcodec libavformat libavutil)
    target_include_directories(osteon_media SYSTEM PRIVATE ${OSTEON_AV_INCLUDE_DIRS})
        target_link_libraries(osteon_media PRIVATE ${CMAKE_DL_LIBS})
