#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. scripts/common.sh
. scripts/second_run.sh

usage() {
  cat <<'END'
Usage: scripts/other_system.sh [--core | --packages | --arm64] RELEASE...
Does on a fresh system of another release of Debian what the README says. It makes the root of that system in a
temporary folder with debootstrap, clones the last commit of this checkout into it, and there runs
  programs  ./run --build-only
  help      --help and --help-all of every program and of all of its commands
  hashes    five scenarios: their states at the end have the same hashes as with the programs of this system
  tests     ./test: the quick tests; --core: only those of simcore, telemetry and robotlink, which need fewer packages
With --packages it makes Debian's packages there instead, and uses them in another fresh root:
  packages  scripts/package.sh, lintian included
  install   all packages are installed, every program says its version; then all are removed, and nothing of them is left
  main-job  autopkgtest runs the tests of the packages (packaging/debian/tests)
With --arm64 it builds for arm64 there, with Debian's compilers and libraries for that processor; no program that was
built runs before the tests, which qemu-user runs:
  libraries  what packaging/debian/control needs, for arm64
  cross      programs and library
  hashes     the five scenarios have the same hashes as on this system
  tests      those of simcore and telemetry
  packages   scripts/package.sh --arch arm64
Pitchboard promises that bookworm and trixie pass. What fails on another release, such as forky, is only reported.
The logs are in build/other_systems/RELEASE. Packages and compiled files stay in the cache of the user for the next time,
and for other clones: ${XDG_CACHE_HOME:-~/.cache}/pitchboard/other_systems/RELEASE, which may be removed. The root of the
system is removed at the end. Needs root rights.
Exit code 1: something failed. Exit code 3: no other system can be made here (no rights, no mounts, no mirror).
Example: scripts/other_system.sh trixie bookworm
         scripts/other_system.sh --packages trixie bookworm
         scripts/other_system.sh --arm64 bookworm
END
}

promised='bookworm trixie'
core='' packages='' arm64='' releases=()
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --core) core=yes ;;
    --packages) packages=yes ;;
    --arm64) arm64=yes ;;
    [a-z]*) releases+=("$1") ;;
    *) echo "error: no option \"$1\"" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
[ ${#releases[@]} -gt 0 ] || { echo "error: which release? For example: trixie" >&2; usage >&2; exit 2; }

cannot() {
  echo "error: no other system can be made here: $*" >&2
  exit 3
}
[ "$(id -u)" -eq 0 ] || cannot "this needs root rights; try sudo scripts/other_system.sh"
install_packages <(printf 'debootstrap\ndebian-archive-keyring\n') || cannot "debootstrap is missing"
unshare --mount --pid --ipc --fork true 2>/dev/null || cannot "mounts in a namespace of their own are not allowed"
# The mirror and the proxy that apt has on this system.
mirror=$(apt-get indextargets --format '$(ORIGIN) $(CODENAME) $(COMPONENT) $(SITE)' 'Created-By: Packages' |
  awk -v release="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")" \
    '$1 == "Debian" && $2 == release && $3 == "main" && !url { url = $4 } END { print url }')
[ -n "$mirror" ] || cannot "apt has no mirror of Debian in its sources, or no lists yet (apt-get update)"
proxy=$(apt-config dump --format '%v' Acquire::http::Proxy)
[ -z "$proxy" ] || export http_proxy=$proxy
git diff --quiet HEAD || echo "warning: changes that are not committed are not tested" >&2

root=$(mktemp -d -t pitchboard-system.XXXXXX)
chmod 755 "$root" # users of the system have to get into it, such as that of munge
# in_root mounts in a namespace of its own, so that nothing else is below the root here.
# unshare ignores SIGTERM; its processes end with it.
child=''
trap '[ -z "$child" ] || { kill -KILL "$child" && wait; } 2>/dev/null; rm -rf --one-file-system "$root"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# in_root COMMAND...: runs it in the clone. Its mounts and processes are gone when it ends, however it ends.
in_root() {
  unshare --mount --pid --ipc --fork --kill-child bash -c '
    set -euo pipefail
    root=$1 cache=$2
    shift 2
    mount --make-rprivate /
    mount -t proc proc "$root/proc"
    mount -t tmpfs shm "$root/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=0666,mode=0620,gid=5 devpts "$root/dev/pts"
    mount --bind "$cache/packages" "$root/var/cache/apt/archives"
    mount --bind "$cache/compiled" "$root/root/.cache/ccache"
    exec chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb LC_ALL=C.UTF-8 \
      QT_QPA_PLATFORM=offscreen ${http_proxy:+http_proxy="$http_proxy"} \
      bash -c "cd /root/pitchboard && exec \"\$@\"" in_root "$@"' in_root "$root" "$cache" "$@" &
  child=$!
  local code=0
  wait "$child" || code=$?
  child=''
  return $code
}
make_root() {
  rm -rf --one-file-system "${root:?}"/*
  # A release that is newer than debootstrap is made as unstable is.
  local script=/usr/share/debootstrap/scripts/$1
  [ -e "$script" ] || script=/usr/share/debootstrap/scripts/sid
  debootstrap --variant=minbase --cache-dir="$cache/packages" "$1" "$root" "$mirror" "$script" || return
  mkdir -p "$root/root/.cache/ccache"
  echo 'APT::Keep-Downloaded-Packages "true";' >"$root/etc/apt/apt.conf.d/keep"
  ! [ -e /etc/resolv.conf ] || cp --remove-destination /etc/resolv.conf "$root/etc/resolv.conf"
  git clone --quiet "file://$PWD" "$root/root/pitchboard"
}

# What runs in the root, too: each function is given to its bash.
hashes() {
  local scenario
  for scenario in "match --duration 300" "match-3v3 --duration 300 --noise realistic" "scenario-1 --duration 60" \
    "published-match-3v3 --duration 300" "match-11v11 --duration 60 --seed 7"; do
    echo "$scenario: $(${1:-} build/${2:-release}/bin/pitchboard-cli simulate --scenario $scenario --json | grep -o '"state_hash": *"[^"]*"')"
  done
}
help_page() {
  local page command
  if ! page=$("$@" --help 2>&1) || { [[ $page == *--help-all* ]] && ! "$@" --help-all >/dev/null; }; then
    printf 'error: %s --help failed:\n%s\n' "$*" "$page" >&2
    return 1
  fi
  echo "$* --help: $(wc -l <<<"$page") lines"
  for command in $(sed -n '/^Commands:$/,/^$/s/^  \([a-z][a-z-]*\).*/\1/p' <<<"$page"); do
    help_page "$@" "$command" || return
  done
}
help_pages() {
  local program
  for program in build/release/bin/pitchboard*; do help_page "$program" || return; done
}
core_tests() {
  . scripts/common.sh
  unset QT_QPA_PLATFORM
  install_packages <(grep -E '^(python3|lld)' scripts/packages-test.txt) &&
    build release build_{simcore,telemetry,robotlink}_tests &&
    ctest --preset release -j"$((2 * $(nproc)))" -L '^(simcore|telemetry|robotlink)$' -LE slow
}
quick_tests() { ./test; }
# In a fresh system with the packages in /root/packages.
install_and_remove() {
  local installed program
  apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends autopkgtest || return
  dpkg --get-selections >/root/before
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends /root/packages/*.deb || return
  for program in pitchboard pitchboard-cli pitchboard-robot pitchboard-agent; do
    echo "$program $("$program" --version)" || return
  done
  python3 -c 'import pitchboard; print("module", pitchboard.__version__)' || return
  installed=$(dpkg-query -W -f '${Package} ' '*pitchboard*')
  DEBIAN_FRONTEND=noninteractive apt-get purge -y -qq $installed || return
  # What libc6 and others only recommend was not there before.
  apt-get autoremove --purge -y -qq -o APT::AutoRemove::RecommendsImportant=false -o APT::AutoRemove::SuggestsImportant=false || return
  dpkg --get-selections | diff /root/before - || { echo "error: not all packages are gone"; return 1; }
  ! find / -xdev \( -path /root -o -path /proc -o -path /var/lib/apt -o -path /var/cache \) -prune -o -iname '*pitchboard*' -print |
    grep . || { echo "error: these files are left"; return 1; }
}
# Puts packaging/debian where Debian's tools expect it.
debian_folder() {
  cp -r packaging/debian debian
  packaging/change_log.sh CHANGELOG.md "$(sed -n 's/^project(Pitchboard VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)" \
    "$(sed -n 's/^Maintainer: //p' debian/control)" >debian/changelog
}
main_job() {
  debian_folder
  autopkgtest --no-built-binaries /root/packages/*.deb . -- null
}
tests_twice() {
  . scripts/second_run.sh
  "$1" || second_run build/release -j"$((2 * $(nproc)))"
}
# same_hashes [EMULATOR BUILD]
same_hashes() {
  in_root bash -c "$(declare -f hashes); hashes $*" >"$logs/hashes.there" &&
    [ "$(grep -c '"0x' "$logs/hashes.here")" -eq 5 ] && diff "$logs/hashes.here" "$logs/hashes.there"
}

failed=()
# step NAME COMMAND...: what it says goes into a log.
step() {
  local name=$1 log=$logs/$1.log begin=$SECONDS
  shift
  if "$@" >"$log" 2>&1; then
    echo "$release: $name passed, $((SECONDS - begin)) s"
  else
    tail -n 40 "$log" >&2
    echo "error: $release: $name failed; all it said is in $log" >&2
    failed+=("$release: $name")
    return 1
  fi
}

# packages_of RELEASE: builds them there, and uses them in another root.
packages_of() {
  step packages in_root scripts/package.sh || return
  rm -rf "$logs/packages" && mkdir "$logs/packages"
  cp "$root"/root/pitchboard/build/packages/*.deb "$logs/packages"
  step root make_root "$1" && cp -r "$logs/packages" "$root/root/packages"
  step install in_root bash -c "$(declare -f install_and_remove); install_and_remove" || true
  step main-job in_root bash -c "$(declare -f debian_folder main_job); main_job" || true
}

# For arm64, in the root.
arm64_libraries() {
  debian_folder
  dpkg --add-architecture arm64 && apt-get update -qq || return
  DEBIAN_FRONTEND=noninteractive apt-get build-dep -y -qq --no-install-recommends -aarm64 -Pcross,nocheck . &&
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends ccache crossbuild-essential-arm64 dpkg-dev lld qemu-user python3 &&
    rm -r debian
}
# Configured as debhelper does it, and with tests, which qemu-user runs.
arm64_configure() {
  local compiler=aarch64-linux-gnu
  cmake -G Ninja -S . -B build/arm64 -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 \
    -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_C_COMPILER=$compiler-gcc \
    -DCMAKE_CXX_COMPILER=$compiler-g++ -DPKG_CONFIG_EXECUTABLE=/usr/bin/$compiler-pkg-config -DCMAKE_INSTALL_PREFIX=/usr \
    -DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64 -DQT_HOST_PATH=/usr \
    -DQT_HOST_PATH_CMAKE_DIR="/usr/lib/$(dpkg-architecture -qDEB_BUILD_MULTIARCH)/cmake"
}
arm64_cross() { arm64_configure && ninja -C build/arm64 programs; }
arm64_tests() {
  ninja -C build/arm64 build_{simcore,telemetry}_tests &&
    ctest --test-dir build/arm64 --output-on-failure -j"$(nproc)" -L '^(simcore|telemetry)$' -LE slow
}
arm64_of() {
  step libraries in_root bash -c "$(declare -f debian_folder arm64_libraries); arm64_libraries" &&
    step cross in_root bash -c "$(declare -f arm64_configure arm64_cross); arm64_cross" || return
  step hashes same_hashes qemu-aarch64 arm64 || true
  step tests in_root bash -c "$(declare -f arm64_tests); arm64_tests" || true
  step packages in_root scripts/package.sh --arch arm64 || return
  rm -rf "$logs/packages" && mkdir "$logs/packages" && cp "$root"/root/pitchboard/build/packages/*.deb "$logs/packages"
}

[ -n "$packages" ] || build release pitchboard-cli
for release in "${releases[@]}"; do
  logs=build/other_systems/$release cache=${XDG_CACHE_HOME:-$HOME/.cache}/pitchboard/other_systems/$release
  mkdir -p "$logs" "$cache/packages/partial" "$cache/compiled"
  # apt of two systems cannot use the same packages at the same time.
  exec 9>"$cache/lock"
  flock --nonblock 9 || { echo "$release: waiting for another run that uses $cache ..." >&2 && flock 9; }
  step root make_root "$release" || cannot "the system $release could not be made from $mirror"
  if [ -n "$packages" ]; then
    packages_of "$release" || true
    continue
  fi
  hashes >"$logs/hashes.here"
  if [ -n "$arm64" ]; then
    arm64_of || true
    continue
  fi
  step programs in_root ./run --build-only || continue
  step help in_root bash -c "$(declare -f help_page help_pages); help_pages" || true
  step hashes same_hashes || true
  # Not beside those of this system, which .ci/run may be running: programs in real time would wait for one another.
  exec 8>build/tests.lock
  flock 8
  tests=quick_tests
  [ -z "$core" ] || tests=core_tests
  step tests in_root bash -c "$(declare -f $tests tests_twice); tests_twice $tests" || true
  for log in "$root/root/pitchboard/$second_runs"/*.log; do
    [ ! -e "$log" ] || { mkdir -p "$second_runs" && cp "$log" "$second_runs/$release:${log##*/}"; }
  done
  report_second_runs "$release:" || failed+=("$release: too many unstable tests")
done
code=0
for one in "${failed[@]}"; do
  if [[ " $promised " == *" ${one%%:*} "* ]]; then
    echo "error: $one failed" >&2
    code=1
  else
    echo "report: $one failed; this release is not promised" >&2
  fi
done
exit $code
