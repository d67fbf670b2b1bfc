#!/bin/sh
# Makes repose ready to run: installs the Debian packages that are missing, configures, builds.
#
#   ./setup.sh [--tests] [PRESET [TARGET]...]
#
#   --tests   also install what only the tests need, and build them: GoogleTest, clang-format,
#             clang-tidy, Clang, a compiler cache, MPI, Chromium, zsh, groff
#   PRESET    release (default), dev, sanitize, thread or fuzz
#   TARGET    build only this, not everything
#
# Started again it only checks whether there is something to do. It reports to stderr, one line a step.
set -eu

case "${1-}" in
  -h|--help) sed -n '1d; s/^# \{0,1\}//p; /^set/q' "$0"; exit ;;
esac

root=$(dirname -- "$(readlink -f -- "$0")")
needed="g++ cmake ninja-build pkg-config
  libopencv-dev libceres-dev libeigen3-dev libboost-dev libtbb-dev
  libassimp-dev libtomlplusplus-dev libpugixml-dev
  libosmesa6-dev libmeshoptimizer-dev libgif-dev
  libavformat-dev libavcodec-dev libavutil-dev libswscale-dev
  libjpeg-dev libpng-dev libtiff-dev libwebp-dev libheif-dev libexif-dev libcsv-dev
  zlib1g-dev libcairo2-dev
  libcli11-dev nlohmann-json3-dev libfmt-dev libctemplate-dev libcpp-httplib-dev libxlsxwriter-dev
  fonts-dejavu-core"
# npm may also come from a source other than Debian.
command -v npm >/dev/null || needed="$needed npm"
node_packages="calibrate/report studio/page"
tests=OFF
if [ "${1-}" = --tests ]; then
  needed="$needed libgtest-dev libgmock-dev libbenchmark-dev clang-format-14 clang-tidy-22 clang-22
    libclang-rt-22-dev lld-22 llvm-22 ccache
    libopenmpi-dev openmpi-bin chromium python3-jsonschema zsh groff-base"
  tests=ON
  node_packages="$node_packages tests"
  shift
fi
preset=release
if [ $# -gt 0 ]; then preset=$1; shift; fi
case $preset in
  release|dev|sanitize|thread|fuzz) ;;
  *)
    printf 'repose: %s is no preset. Fix: release, dev, sanitize, thread or fuzz; ./setup.sh --help\n' "$preset" >&2
    exit 2 ;;
esac
# For tests/thread_tbb.
if [ "$preset" = thread ] && [ $tests = ON ]; then needed="$needed dpkg-dev"; fi

log=$(mktemp)
trap 'rm -f -- "$log"' EXIT
trap 'exit 130' INT TERM

say() { printf 'repose: %s\n' "$*" >&2; }

# step TEXT COMMAND...  prints TEXT; shows the command's output only if it fails.
step() {
  say "$1"
  shift
  "$@" >"$log" 2>&1 && return
  cat "$log" >&2
  say "this failed: $*"
  exit 1
}

missing_packages() {
  for package in $needed; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || status=
    [ "$status" = installed ] || printf ' %s' "$package"
  done
}

# Waits for up to five minutes while another program holds the package lock.
apt() {
  waited_s=0
  until $as_root env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=10 \
      -o Acquire::Retries=3 "$@" </dev/null >"$log" 2>&1; do
    grep -q -e 'Could not get lock' -e 'Unable to lock' "$log" && [ $waited_s -lt 300 ] || return 1
    [ $waited_s -gt 0 ] || say "waiting: another program is installing packages"
    sleep 5
    waited_s=$((waited_s + 15))
  done
}

install_packages() {
  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    as_root="sudo -n"
    if ! $as_root true 2>/dev/null; then
      say "these packages are missing:$1"
      say "Fix: sudo apt-get install --no-install-recommends$1"
      exit 2
    fi
  fi
  say "installing$1"
  apt update || say "the list of packages could not be updated; continuing with the present one"
  if ! apt install -y --no-install-recommends $1; then
    tail -n 30 "$log" >&2
    say "the packages could not be installed. Fix: see the lines above, then start this again"
    exit 2
  fi
}

installed=
if command -v dpkg-query >/dev/null; then
  packages=$(missing_packages)
  if [ -n "$packages" ]; then
    install_packages "$packages"
    installed=yes
  fi
else
  say "not Debian: using the compiler, CMake, Ninja and libraries that are installed (docs/building.md" \
    "lists them)"
fi

cd -- "$root"
# Exactly the packages in package-lock.json: npm compares hashes. No package's scripts are run.
for folder in $node_packages; do
  [ "$folder/node_modules/.package-lock.json" -nt "$folder/package-lock.json" ] && continue
  step "fetching the packages of $folder/package-lock.json" \
    npm ci --ignore-scripts --no-audit --no-fund --prefix "$folder"
  touch -- "$folder/node_modules/.package-lock.json"
done
build=build/$preset
# Once configured, Ninja itself notices when CMake must run again, except for tests not requested
# before, for a change in the presets, and for packages that were missing. The last two need a fresh
# start: CMake forgets the presets' settings if the compiler changes, and does not search again for what
# it did not find.
fresh=
[ -z "$installed" ] && [ "$build/build.ninja" -nt CMakePresets.json ] || fresh=--fresh
is_built_with_tests() { grep -q '^REPOSE_TESTS:BOOL=ON' "$build/CMakeCache.txt" 2>/dev/null; }
if [ -n "$fresh" ] || { [ $tests = ON ] && ! is_built_with_tests; }; then
  if is_built_with_tests; then tests=ON; fi
  step "configuring $build" cmake --preset "$preset" $fresh -DREPOSE_TESTS=$tests
fi
if [ $# -gt 0 ]; then set -- --target "$@"; fi
first_time=
[ -e "$build/.ninja_log" ] || first_time=" (this takes some minutes the first time)"
# One compiler per core, as far as there are 2 GB of memory for each.
jobs=$(awk -v cores="$(nproc)" '/^MemAvailable/ { most = int($2 / 2e6) }
  END { print most < 1 ? 1 : most < cores ? most : cores }' /proc/meminfo)
# -k 0: a failing build names every error, not only the first.
step "building $build$first_time" cmake --build "$build" --parallel "$jobs" "$@" -- -k 0
