# SPDX-License-Identifier: GPL-3.0-or-later
# For ./run, ./test, .ci/run and scripts/: install_packages LIST..., quietly COMMAND..., build PRESET
# TARGET... Run from the top folder. With PITCHBOARD_YES=yes (--yes of the commands) nothing is asked.
# A line of a list is a package, or a package and a command: it is needed only where the command is
# missing, because another packaging of the same program would be in conflict with it. A package that an
# installed one provides is there, too: what is a package on one system is a part of another one on the next.

# Names of all installed packages and of what they provide, one a line.
installed_packages() {
  dpkg-query -W -f='${db:Status-Status}|${Package},${Provides}\n' |
    sed -n 's/^installed|//p' | tr ',' '\n' | sed 's/(.*//; s/ //g; /^$/d'
}

install_packages() {
  local missing=() package command installed
  installed=$(installed_packages)
  while read -r package command; do
    [ -n "$package" ] || continue
    [ -z "$command" ] || ! command -v "$command" >/dev/null || continue
    grep -qxF -- "$package" <<<"$installed" || missing+=("$package")
  done < <(cat "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "error: packages are missing and there is no sudo; as root: apt-get install ${missing[*]}" >&2
      return 2
    fi
    as_root=(sudo)
    may_install "${missing[@]}" || return 2
  fi
  echo "Installing ${#missing[@]} packages: ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# may_install PACKAGE...: says what sudo would install, and asks. Where nobody can answer, the answer is no, as apt-get's.
may_install() {
  local answer
  [ -z "${PITCHBOARD_YES:-}" ] || return 0
  echo "These packages of your system are missing (with those that they need):" >&2
  printf '  %s\n' "$*" | fold -s -w 100 >&2
  if [ -t 0 ] && [ -t 2 ]; then
    read -r -p "Install them with sudo apt-get? [Y/n] " answer
    case $answer in '' | [Yy] | [Yy][Ee][Ss]) return 0 ;; esac
  fi
  echo "error: nothing was installed. Install them yourself: sudo apt-get install $*" >&2
  [ -t 0 ] && [ -t 2 ] || echo "       or say --yes, and they are installed without asking." >&2
  return 1
}

# quietly COMMAND...: says nothing when all is well, the end of what it said when it is not. It goes into $quiet_log.
quiet_log=build/build.log
quietly() {
  local log=$quiet_log
  mkdir -p "$(dirname "$log")"
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
  local preset=$1 log=build/build-$1.log hits=build/compiler-cache-$1.log quiet_log=build/build-$1.log
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
