# The double-precision build of Bullet; where a system has only the other one, that will do, but
# recordings with moving bones then replay on that system alone.
pkg_check_modules(bullet64 IMPORTED_TARGET bullet-float64)
if(bullet64_FOUND)
  osteon_link_system(osteon_physics PkgConfig::bullet64)
else()
  pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet)
  osteon_link_system(osteon_physics PkgConfig::bullet)
endif()
