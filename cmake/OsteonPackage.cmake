# `ninja && cpack` in a build folder makes osteon_<version>_<machine>.deb;
# tools/package-test tries it in a minimal Debian.
include(GNUInstallDirs)
# The program alone is packaged: cpack does not build the tests for it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(package "${CMAKE_SOURCE_DIR}/packaging")
install(TARGETS osteon RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY "${CMAKE_SOURCE_DIR}/assets" "${CMAKE_SOURCE_DIR}/shaders"
  DESTINATION ${CMAKE_INSTALL_DATADIR}/osteon)
install(FILES "${package}/osteon.desktop" "${package}/osteon-recording.desktop"
  "${package}/osteon-launch.desktop"
  DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES "${package}/osteon.svg"
  DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES "${package}/osteon-mime.xml" DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
  RENAME osteon.xml)
install(FILES "${package}/org.osteon.Osteon.metainfo.xml"
  DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES "${package}/osteon.bash"
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME osteon)
install(FILES "${CMAKE_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/osteon
  RENAME copyright)
# The program itself says what it takes and which devices it knows.
install(CODE "execute_process(COMMAND \"${package}/generated-files\" \"$<TARGET_FILE:osteon>\"
  \"${CMAKE_BINARY_DIR}/packaging\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES "${CMAKE_BINARY_DIR}/packaging/osteon.1" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES "${CMAKE_BINARY_DIR}/packaging/70-osteon.rules" DESTINATION lib/udev/rules.d)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME osteon)
set(CPACK_PACKAGE_CONTACT "Osteon maintainers <maintainers@osteon.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# OpenGL in software is enough for pictures; fonts for the panels.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl-mesa0, libgl1-mesa-dri, fonts-inter")
# Loaded when a film is begun, a sound is played, the desktop chooses a file.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libavcodec59, libavformat59, libopenal1, libsystemd0")
include(CPack)
