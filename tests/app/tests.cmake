# Panels are tested with an ImGui context of their own, without a window.
if(OSTEON_WINDOW)
  pkg_check_modules(APP_TESTS_IMGUI REQUIRED IMPORTED_TARGET imgui glfw3)
  osteon_link_system(osteon_app_tests PkgConfig::APP_TESTS_IMGUI)
  # Films of the window are read back.
  pkg_check_modules(APP_TESTS_AV REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil)
  osteon_link_system(osteon_app_tests PkgConfig::APP_TESTS_AV)
endif()

# The loops by themselves, without the window: quick enough to build for the thread sanitizer.
file(GLOB loops_tests CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/app/loops/*_test.cpp")
osteon_test_program(osteon_loops_tests app osteon_loops ${loops_tests})
target_include_directories(osteon_loops_tests PRIVATE "${CMAKE_SOURCE_DIR}/src/device")
target_link_libraries(osteon_loops_tests PRIVATE ${CMAKE_DL_LIBS})
target_compile_definitions(osteon_loops_tests PRIVATE STUB_HD="$<TARGET_FILE:osteon_stub_hd>")
add_dependencies(osteon_loops_tests osteon_stub_hd)
