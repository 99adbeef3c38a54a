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

# build PRESET TARGET...
build() {
  local preset=$1
  shift
  echo "Building $preset (the log is in build/build.log) ..." >&2
  quietly cmake --preset "$preset"
  quietly cmake --build --preset "$preset" --target "$@"
}
