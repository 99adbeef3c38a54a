# SPDX-License-Identifier: GPL-3.0-or-later
# For ./run, ./test, .ci/run and scripts/: install_packages LIST..., quietly COMMAND..., build PRESET
# TARGET... Run from the top folder.
# A line of a list is a package, or a package and a command: it is needed only where the command is
# missing, because another packaging of the same program would be in conflict with it.

install_packages() {
  local missing=() package command
  while read -r package command; do
    [ -n "$package" ] || continue
    [ -z "$command" ] || ! command -v "$command" >/dev/null || continue
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' ||
      missing+=("$package")
  done < <(cat "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "error: packages are missing and there is no sudo; as root: apt-get install ${missing[*]}" >&2
      return 2
    fi
    as_root=(sudo)
  fi
  echo "Installing ${#missing[@]} packages: ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# quietly COMMAND...: says nothing when all is well, the end of what it said when it is not.
quietly() {
  mkdir -p build
  local log=build/build.log
  if ! "$@" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    echo "error: this failed: $*; all it said is in $log" >&2
    return 2
  fi
}

# show_progress LOG: a line about each step of ninja (NINJA_STATUS below) on standard error: how far it is and
# how long it still takes. On a terminal it is one line that changes, elsewhere one line a minute.
show_progress() {
  local terminal=0
  [ ! -t 2 ] || terminal=1
  tee "$1" | awk -v terminal=$terminal '
    match($0, /^\[[1-9][0-9]* [0-9]+ [0-9.]+\]/) {
      split(substr($0, 2, RLENGTH - 2), step, " ")
      left = step[3] * (step[2] - step[1]) / step[1]
      text = sprintf("  %d of %d, %s left", step[1], step[2],
                     left < 60 ? "less than a minute" : sprintf("about %d min", left / 60 + 0.5))
      if (terminal) printf "\r%-60s", text
      else if (step[3] >= next_line) { print text; next_line = step[3] + 60 }
      fflush()
    }
    END { if (terminal && text != "") printf "\r%-60s\r", "" }' >&2
}

# build PRESET TARGET...
build() {
  local preset=$1 log=build/build.log hits=build/compiler-cache.log
  shift
  echo "Building $preset (the log is in $log) ..." >&2
  quietly cmake --preset "$preset"
  rm -f "$hits"
  if ! CCACHE_STATSLOG=$PWD/$hits NINJA_STATUS='[%f %t %e] ' \
    cmake --build --preset "$preset" --target "$@" 2>&1 | show_progress "$log"; then
    tail -n 60 "$log" >&2
    echo "error: the build failed; all it said is in $log" >&2
    return 2
  fi
  [ ! -e "$hits" ] || awk '/_cache_hit$/ { hit++ } /^cache_miss$/ { miss++ }
    END { if (hit + miss) printf "Compiler cache: %d of %d files (%d %%)\n", hit, hit + miss, 100 * hit / (hit + miss) }' \
    "$hits" >&2
}
