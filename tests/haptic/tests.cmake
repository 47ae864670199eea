#The closed loop needs an emulated user; dlsym reaches the functions that realtime_test watches.
target_link_libraries(osteon_haptic_tests PRIVATE osteon_device ${CMAKE_DL_LIBS})
