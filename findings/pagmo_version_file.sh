#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# pagmo 2.19.1 (Debian 13, libpagmo-dev 2.19.1-1), found with CMake 3.25 and 3.31.
#
# Its CMake version file accepts only the minor version that is installed (SameMinorVersion), so a project that asks
# for a lower bound does not find it: find_package(pagmo 2.18), and even find_package(pagmo 2), are refused, although
# 2.19.1 is newer. Projects have to ask without a version and compare afterwards.
# Output seen:
#   find_package(pagmo 2): found 0, considered 2.19.1
#   find_package(pagmo 2.18): found 0, considered 2.19.1
# Needs apt-get with a mirror of Debian, dpkg-deb and cmake. Fails if the behaviour is another one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Debian 13 beside this system's own lists: the first mirror of Debian that apt has here.
mirror=$(apt-get indextargets --format '$(ORIGIN) $(COMPONENT) $(SITE)' 'Created-By: Packages' |
  awk '$1 == "Debian" && $2 == "main" && !url { url = $3 } END { print url }')
mkdir -p "$folder"/apt/lists/partial "$folder"/apt/archives/partial "$folder"/packages
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror trixie main" >"$folder/apt/sources.list"
apt() {
  apt-get -qq -o APT::Sandbox::User=root -o Dir::Etc::SourceList="$folder/apt/sources.list" -o Dir::Etc::SourceParts=- \
    -o Dir::State::Lists="$folder/apt/lists" -o Dir::Cache="$folder/apt" "$@"
}
apt update
(cd "$folder/packages" && apt download libpagmo-dev=2.19.1-1 >/dev/null)
dpkg-deb -x "$folder"/packages/libpagmo-dev_2.19.1-1_*.deb "$folder/root"

cat >"$folder/find.cmake" <<'CMAKE'
foreach(asked 2 2.18)
  file(GLOB folder ${ROOT}/usr/lib/*/cmake/pagmo)
  find_package(pagmo ${asked} CONFIG QUIET PATHS ${folder} NO_DEFAULT_PATH)
  message("find_package(pagmo ${asked}): found ${pagmo_FOUND}, considered ${pagmo_CONSIDERED_VERSIONS}")
  unset(pagmo_DIR CACHE)
endforeach()
CMAKE
seen=$(cmake -D ROOT="$folder/root" -P "$folder/find.cmake" 2>&1)
echo "$seen"
[ "$seen" = "find_package(pagmo 2): found 0, considered 2.19.1
find_package(pagmo 2.18): found 0, considered 2.19.1" ] || { echo "The behaviour has changed." >&2; exit 1; }
