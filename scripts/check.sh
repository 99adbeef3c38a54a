#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The rules of the project that a machine can check. ./test runs the tests; this runs the rest.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. scripts/common.sh

usage() {
  cat <<'END'
Usage: scripts/check.sh [--full] [--base COMMIT] [CHECK...]
Checks, in this order (default: all of them):
  format     clang-format over the whole tree
  docs       links, file names and options that the documents name are there; types and pydoc of the Python module
  includes   include directions between libraries and modules (tst_layers)
  tidy       clang-tidy over the sources that changed since COMMIT (default: main)
  tidy-all   clang-tidy over all sources; long; only when asked for
  headers    every public header compiles alone
  core-only  everything that needs no Qt Widgets builds by itself
  benchmarks  the benchmarks build
--full adds, or takes as names:
  asan       all tests with address, leak and undefined-behaviour sanitizers
  threads    the tests in which threads work at the same time, with the thread sanitizer
  no-pch     the programs build file by file, without precompiled headers (tests never have any)
  clang      everything builds with clang, too
Every check runs whatever the others say; the last line counts them, and the exit code is 1 when one
failed. Missing packages (scripts/packages-*.txt) are installed.
Examples:
  scripts/check.sh format docs      # in a few seconds, before a commit
  scripts/check.sh --full           # before a release
END
}

checks=()
full=no
base=
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --full) full=yes ;;
    --base) base=${2:?error: --base needs a commit}; shift ;;
    format | docs | includes | tidy | tidy-all | headers | core-only | benchmarks | asan | threads | no-pch | clang)
      checks+=("$1") ;;
    *) echo "error: no check \"$1\"" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
if [ ${#checks[@]} -eq 0 ]; then
  checks=(format docs includes tidy headers core-only benchmarks)
  [ $full = no ] || checks+=(asan threads no-pch clang)
elif [ $full = yes ]; then
  checks+=(asan threads no-pch clang)
fi

unset DISPLAY WAYLAND_DISPLAY
export LC_ALL=C.UTF-8 QT_QPA_PLATFORM=offscreen

sources() { git ls-files --cached --others --exclude-standard "$@" | while read -r f; do [ ! -e "$f" ] || echo "$f"; done; }

# tests/data is what tests read, as it was made elsewhere.
format() { sources '*.h' '*.cpp' ':!tests/data' | xargs clang-format --dry-run --Werror; }

# scripts/spelling.txt has the words that are right all the same.
docs() {
  python3 scripts/check_docs.py
  # The module for Python: its types, and its documentation as pydoc shows it.
  mypy --strict --cache-dir build/mypy robotlink/laboratory/capi/python/pitchboard
  python_docs
  sources app simcore telemetry robotlink ui tests docs scripts packaging '*.md' run test install \
    ':!tests/data' ':!docs/reference' ':!*.svg' ':!*.png' ':!scripts/spelling.txt' |
    xargs codespell --ignore-words scripts/spelling.txt
}

# Everything that the module offers is described. This needs its library; a build without one has nothing to show.
python_docs() {
  local library=build/release/lib/libpitchboard_sim.so.1 name
  [ -e $library ] || { echo "pydoc: skipped, because build/release has no library"; return 0; }
  PYTHONPATH=robotlink/laboratory/capi/python PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - <<'END'
import inspect, pitchboard, pydoc
page = pydoc.plain(pydoc.render_doc(pitchboard))
missing = [name for name in pitchboard.__all__ if name not in page]
for name in pitchboard.__all__:
    thing = getattr(pitchboard, name)
    members = vars(thing).items() if inspect.isclass(thing) else ()
    missing += [name] * (not thing.__doc__)
    missing += [f"{name}.{key}" for key, value in members if not key.startswith("_")
                and (inspect.isfunction(value) or isinstance(value, property)) and not inspect.getdoc(value)]
raise SystemExit("no description: " + ", ".join(missing) if missing else None)
END
}

includes() {
  quietly cmake --preset core-only
  quietly cmake --build --preset core-only --target tst_layers
  build/core-only/tests/tst_layers
}

headers() {
  quietly cmake --preset release
  quietly cmake --build --preset release --target headers
}

benchmarks() {
  quietly cmake --preset release
  quietly cmake --build --preset release --target benchmarks
}

core-only() {
  quietly cmake --preset core-only
  quietly cmake --build --preset core-only
}

# clang does not read gcc's precompiled headers: a build folder without them, in which nothing is compiled. No source
# includes what moc makes; one includes what protoc makes.
tidy_these() {
  [ $# -gt 0 ] || { echo "no source has changed"; return 0; }
  quietly cmake --preset tidy
  quietly ninja -C build/tidy telemetry/formats/messages/messages/team_messages.pb.h
  printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option 2> \
    >(grep -vE '^[0-9]+ warnings? (generated|treated)' >&2)
}

tidy() {
  local since=$base changed
  if [ -z "$since" ]; then
    for since in origin/main main HEAD~1; do git rev-parse -q --verify "$since^{commit}" >/dev/null && break; done
  fi
  since=$(git merge-base "$since" HEAD)
  mapfile -t changed < <(comm -12 <(sources 'app/*.cpp' 'simcore/*.cpp' 'telemetry/*.cpp' 'robotlink/*.cpp' 'ui/*.cpp' | sort) \
    <({ git diff --name-only "$since"; git ls-files --others --exclude-standard; } | sort -u))
  tidy_these "${changed[@]}"
}

tidy-all() {
  local all
  mapfile -t all < <(sources 'app/*.cpp' 'simcore/*.cpp' 'telemetry/*.cpp' 'robotlink/*.cpp' 'ui/*.cpp')
  tidy_these "${all[@]}"
}

asan() { scripts/sanitizers.sh asan; }

threads() { scripts/sanitizers.sh tsan; }

no-pch() {
  quietly cmake --preset no-pch
  quietly cmake --build --preset no-pch
}

clang() {
  install_packages scripts/packages-clang.txt
  quietly cmake --preset clang
  quietly cmake --build --preset clang
}

install_packages scripts/packages-run.txt scripts/packages-test.txt scripts/packages-check.txt
failed=()
for check in "${checks[@]}"; do
  echo "--- $check"
  # A shell of its own: "set -e" holds inside a function that is called in a condition no longer.
  code=0
  (set -e; "$check") & wait $! || code=$?
  [ $code -eq 0 ] || { failed+=("$check"); echo "error: $check failed" >&2; }
done
echo "${#checks[@]} checks, ${#failed[@]} failed${failed[*]:+: ${failed[*]}}"
[ ${#failed[@]} -eq 0 ]
