# Films are read back by FFmpeg's own libraries.
pkg_check_modules(OSTEON_AV_TEST REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil)
osteon_link_system(osteon_media_tests PkgConfig::OSTEON_AV_TEST)
