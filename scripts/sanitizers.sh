#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. scripts/common.sh

usage() {
  cat <<'END'
Usage: scripts/sanitizers.sh [asan|asan-core|tsan] [--build-only | CTEST OPTION...]
Builds with sanitizers and runs the tests; every report fails its test.
  asan       addresses, leaks and undefined behaviour in all tests (default), in build/asan-ubsan
  asan-core  the same in the tests of simcore, telemetry and robotlink, and in those that are for every build
             (label every_build), in build/asan-core
  tsan       data races in the tests in which threads work at the same time, in build/tsan
Reports from libraries that are not ours are left out by tests/sanitizers/*.supp.
Example: scripts/sanitizers.sh tsan -R 'tst_match_runner|tst_udp_receiver'
END
}

label=
case ${1:-asan} in
  asan) preset=asan-ubsan targets=(all) ;;
  asan-core) preset=asan-core targets=(build_{simcore,telemetry,robotlink,every_build}_tests)
    label='^(simcore|telemetry|robotlink|every_build)$' ;;
  tsan) preset=tsan targets=(build_threads_tests) label='^threads$' ;;
  -h | --help) usage; exit 0 ;;
  *) echo "error: no sanitizer \"$1\"" >&2; usage >&2; exit 2 ;;
esac
shift || true

unset DISPLAY WAYLAND_DISPLAY
export LC_ALL=C.UTF-8
jobs=$(nproc)
[ $preset = tsan ] || jobs=$((2 * jobs))  # many tests wait for other programs
install_packages scripts/packages-run.txt scripts/packages-test.txt scripts/packages-clang.txt
build "$preset" "${targets[@]}"
[ "${1:-}" != --build-only ] || exit 0
ctest --preset "$preset" -j"$jobs" ${label:+-L "$label"} "$@"
