#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. scripts/common.sh

case ${1:-} in
  -h | --help)
    cat <<'END'
Usage: scripts/growth.sh [WORD]
Measures how cost grows with the work (tests/benchmarks/growth.cpp): each kind of work at five sizes in one
process. A line for each kind, or for those whose name contains WORD: time, memory and bytes of the largest
size, and after "^" the exponent. Exits with 1 if an exponent is above 1.2. Takes about two minutes, and
other programs change little, because it counts processor time. docs/performance.md has a table of exponents.
END
    exit 0 ;;
esac
install_packages scripts/packages-run.txt scripts/packages-test.txt
build release growth
exec build/release/benchmarks/growth "$@"
