#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. scripts/common.sh

usage() {
  cat <<'END'
Usage: scripts/package.sh [OPTION]...
Makes Debian packages of this checkout, in build/packages: pitchboard, pitchboard-cli, pitchboard-agent, libpitchboard1,
libpitchboard-dev, python3-pitchboard and pitchboard-doc. packaging/debian has what dpkg-buildpackage needs; it is copied
together with the sources into build/packages/pitchboard-VERSION, which is removed afterwards. lintian checks the packages.
  --arch ARCHITECTURE   for another processor, such as arm64; its libraries must be installed, as they are by
                        scripts/other_system.sh --arm64
  --agent               pitchboard-agent alone
  --source              a source package, too
  --symbols             packages of debug symbols, too, which takes longer
  --built FOLDER        of what was built there with cmake --preset release, instead of building it: quick, for tests; with
                        --agent, of what scripts/agent.sh built
  --into FOLDER         into this folder instead of build/packages
  --yes                 installs missing packages without asking
Example: scripts/package.sh && sudo apt install ./build/packages/pitchboard{,-cli}_*.deb
END
}

into=$PWD/build/packages built='' agent='' symbols='' what=-b arch=$(dpkg --print-architecture)
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --arch) arch=${2:?error: --arch needs an architecture of Debian, such as arm64}; shift ;;
    --agent) agent=yes ;;
    --source) what=-F ;;
    --symbols) symbols=yes ;;
    --built) built=$(readlink -e "${2:?error: --built needs a folder}") || { echo "error: there is no folder $2" >&2; exit 2; }; shift ;;
    --into) into=$(mkdir -p "${2:?error: --into needs a folder}" && readlink -e "$2"); shift ;;
    --yes) export PITCHBOARD_YES=yes ;;
    *) echo "error: no option \"$1\"" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
[ -z "$built" ] || [ -e "$built/cmake_install.cmake" ] || { echo "error: $built is no build folder of CMake" >&2; exit 2; }

lists=(scripts/packages-package.txt)
if [ -n "$agent" ]; then
  lists+=(scripts/packages-agent.txt)
elif [ "$arch" = "$(dpkg --print-architecture)" ]; then
  lists+=(scripts/packages-run.txt)
fi
install_packages "${lists[@]}"

version=$(sed -n 's/^project(Pitchboard VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
maintainer=$(sed -n 's/^Maintainer: //p' packaging/debian/control)
# Always the same folder, so that the compiler's cache knows the files again.
source=$into/pitchboard-$version
rm -rf "$source" "$into"/pitchboard_* "$into"/*pitchboard*.deb
mkdir -p "$source"
if git rev-parse --git-dir >/dev/null 2>&1; then
  git ls-files -z --cached --others --exclude-standard
else  # the sources of a release
  find . -path ./build -prune -o ! -type d -print0
fi | while IFS= read -r -d '' file; do
  [ ! -e "$file" ] || printf '%s\0' "$file"
done | tar --null --files-from=- -c | tar -C "$source" -x
[ $what = -b ] || tar -C "$into" -cJf "$into/pitchboard_$version.orig.tar.xz" "pitchboard-$version"
cp -r packaging/debian "$source/debian"
packaging/change_log.sh CHANGELOG.md "$version" "${DEBFULLNAME:-${maintainer% <*}} <${DEBEMAIL:-$(sed 's/.*<\(.*\)>/\1/' <<<"$maintainer")}>" \
  >"$source/debian/changelog"

options=(-us -uc $what) profiles=()
[ "$arch" = "$(dpkg --print-architecture)" ] || options+=("-a$arch") profiles+=(cross)
[ -z "$agent" ] || profiles+=(pkg.pitchboard.agent)
[ ${#profiles[@]} -eq 0 ] || options+=("-P$(IFS=, && echo "${profiles[*]}")")
[ "${profiles[*]}" != cross ] || options+=(-B)  # what is the same on every processor, this computer can make
[ -z "$agent" ] || [ -z "$built" ] || options+=(-d)  # built already, with the libraries of the other processor
export DEB_BUILD_OPTIONS="parallel=$(nproc)${DEB_BUILD_OPTIONS:+ $DEB_BUILD_OPTIONS}"
[ "$arch" = "$(dpkg --print-architecture)" ] || DEB_BUILD_OPTIONS+=' nocheck'
if [ -z "$symbols" ]; then
  DEB_BUILD_OPTIONS+=' noautodbgsym'
  export DEB_CFLAGS_STRIP=-g DEB_CXXFLAGS_STRIP=-g
fi
# debhelper gives every package a home of its own, in which ccache would have nothing.
! command -v ccache >/dev/null || export CCACHE_DIR=${CCACHE_DIR:-$(ccache --get-config cache_dir)}
export PITCHBOARD_BUILT=$built
[ -z "$built" ] || [ -n "$agent" ] || export DPKG_DEB_COMPRESSOR_LEVEL=0  # quick, for tests
quiet_log=$into/package.log
echo "Making packages in $into (the log is package.log there) ..." >&2
build_here() (cd "$source" && dpkg-buildpackage "${options[@]}")
quietly build_here
# What was built with ./run is not hardened. appstreamcli 1.0, of which only newer lintians tell, misses a homepage: the
# project has no address of its own yet.
suppressed=()
[ -z "$built" ] || suppressed+=(hardening-no-relro)
! lintian-explain-tags appstream-metadata-validation-failed >/dev/null 2>&1 || suppressed+=(appstream-metadata-validation-failed)
quietly lintian --allow-root --fail-on error,warning --tag-display-limit 0 ${suppressed:+--suppress-tags "$(IFS=, && echo "${suppressed[*]}")"} "$into"/pitchboard_*.changes
rm -rf "$source"
(cd "$into" && ls -- *.deb)
