# Debian packages that each job needs. Sourced by the other tools.

packages_build=(
  g++ cmake ninja-build ccache pkg-config ca-certificates git
  libeigen3-dev libbullet-dev libassimp-dev libopencv-dev libglfw3-dev libimgui-dev
  libusb-1.0-0-dev libepoxy-dev libsqlite3-dev libzstd-dev libtomlplusplus-dev
  nlohmann-json3-dev libcli11-dev libspdlog-dev libfmt-dev libexpected-dev libmeshoptimizer-dev
  libgdcm-dev zlib1g-dev libpng-dev libtiff-dev libhpdf-dev libhdf5-dev libpqxx-dev libcurl4-openssl-dev
  libavcodec-dev libavformat-dev libavutil-dev
  libnanoflann-dev libegl-dev libgl1-mesa-dri libegl-mesa0 fonts-inter
)
packages_test=(
  libgtest-dev libgmock-dev libumockdev-dev umockdev xvfb xauth xdotool xserver-xorg-core
  xserver-xorg-video-dummy x11-xserver-utils clang clang-format libclang-rt-14-dev sqlite3
  libcgal-dev libboost-dev libgmp-dev libmpfr-dev libqhull-dev invesalius-examples plastimatch
  postgresql libxml2-utils libopenal1 dbus-daemon libsystemd0
)
packages_bench=(libbenchmark-dev libumockdev-dev umockdev libcgal-dev libqhull-dev libccd-dev libfcl-dev
  libglpk-dev coinor-libclp-dev libopenvdb-dev)
packages_package=(debootstrap dpkg-dev)

# Installs what is missing of the packages named, and says so. Quick when nothing is.
install_missing() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
      missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  if ! command -v apt-get >/dev/null; then
    echo "These packages are needed: ${missing[*]}. Install them with your system's tool." >&2
    return 1
  fi
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || {
      echo "Missing: ${missing[*]}. Install them as root: apt-get install ${missing[*]}" >&2
      return 1
    }
    as_root=(sudo)
  fi
  echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}"
}

# Configures where needed, with tests when $with_tests is ON: configure_preset PRESET
configure_preset() {
  local preset=$1 tests=${with_tests:-OFF} log
  local cache=build/$preset/CMakeCache.txt
  if [ -f "build/$preset/build.ninja" ]; then
    [ "$tests" = OFF ] && return 0
    grep -q '^OSTEON_TESTS:BOOL=ON' "$cache" && return 0
  fi
  echo "Configuring $preset"
  log=$(mktemp)
  cmake --preset "$preset" -DOSTEON_TESTS="$tests" >"$log" 2>&1 || {
    cat "$log" >&2
    rm -f "$log"
    return 1
  }
  rm -f "$log"
}

# Configures and builds: build_preset PRESET [TARGET...]
build_preset() {
  local preset=$1
  shift
  export NINJA_STATUS="[%f/%t, %es] "
  configure_preset "$preset"
  echo "Building $preset"
  cmake --build "build/$preset" ${1:+--target "$@"}
}
