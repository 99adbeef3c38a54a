#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

usage() {
  cat <<'END'
Usage: scripts/sanitizers.sh [asan|tsan] [CTEST OPTION...]
Builds everything with sanitizers and runs the tests; every report fails its test.
  asan   addresses, leaks and undefined behaviour (default), in build/asan-ubsan
  tsan   data races, in build/tsan
Reports from libraries that are not ours are left out by tests/sanitizers/*.supp.
Example: scripts/sanitizers.sh tsan -R 'tst_match_runner|tst_udp_receiver'
END
}

case ${1:-asan} in
  asan) preset=asan-ubsan ;;
  tsan) preset=tsan ;;
  -h | --help) usage; exit 0 ;;
  *) echo "error: no sanitizer \"$1\"" >&2; usage >&2; exit 2 ;;
esac
shift || true

unset DISPLAY WAYLAND_DISPLAY
export LC_ALL=C.UTF-8
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" -j2 "$@"
