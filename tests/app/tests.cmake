# Panels are tested with an ImGui context of their own, without a window; pictures of the window are
# read with stb (which ImGui needs too).
pkg_check_modules(APP_TESTS_IMGUI REQUIRED IMPORTED_TARGET imgui glfw3)
osteon_link_system(osteon_app_tests PkgConfig::APP_TESTS_IMGUI)
target_compile_definitions(osteon_app_tests PRIVATE OSTEON_PROGRAM="$<TARGET_FILE:osteon>")
add_dependencies(osteon_app_tests osteon)
