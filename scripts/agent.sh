#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. scripts/common.sh

usage() {
  cat <<'END'
Usage: scripts/agent.sh [--package] [amd64] [arm64] [armhf]
Builds pitchboard-agent, the program for the robot, for the named processors (default: all three), each as one
static file: build/agent/ARCHITECTURE/bin/pitchboard-agent. --package makes Debian packages of them, too, in
build/packages/ARCHITECTURE (scripts/package.sh --agent). Missing packages are installed, Debian's cross compilers among them.
The libraries zstd and zlib of another processor are fetched once from this system's mirror, into build/agent/ARCHITECTURE.
Example: scripts/agent.sh --package arm64
END
}

package=no names=()
for argument in "$@"; do
  case $argument in
    -h | --help) usage; exit 0 ;;
    --package) package=yes ;;
    amd64 | arm64 | armhf) names+=("$argument") ;;
    *) echo "error: no processor \"$argument\"" >&2; usage >&2; exit 2 ;;
  esac
done
[ ${#names[@]} -gt 0 ] || names=(amd64 arm64 armhf)
declare -A triplets=([amd64]=x86_64-linux-gnu [arm64]=aarch64-linux-gnu [armhf]=arm-linux-gnueabihf)
declare -A processors=([amd64]=x86_64 [arm64]=aarch64 [armhf]=arm)

# libraries ARCHITECTURE FOLDER: zstd and zlib of another processor in FOLDER/usr. apt keeps lists of its own there, so that
# nothing of this system changes and no root rights are needed.
libraries() {
  local arch=$1 into=$PWD/$2 quiet_log=$PWD/$2.log
  [ ! -e "$into/usr" ] || return 0
  rm -rf "$into.part"
  mkdir -p "$into.part"/apt/{lists,archives}/partial "$into.part/root"
  # A list that cannot be fetched now (of security updates, say) matters only if the packages are not found.
  fetch() {
    cd "$into.part" || return
    local package apt=(apt-get -o APT::Architecture="$arch" -o APT::Architectures="$arch" -o APT::Sandbox::User=root
      -o Dir::State::Lists="$PWD/apt/lists" -o Dir::State::status=/dev/null -o Dir::Cache="$PWD/apt")
    "${apt[@]}" update
    "${apt[@]}" download libzstd-dev zlib1g-dev || return
    for package in *.deb; do dpkg-deb -x "$package" root || return; done
  }
  fetch_there() (fetch)
  quietly fetch_there
  mv "$into.part/root" "$into"
  rm -rf "$into.part"
}

install_packages scripts/packages-agent.txt
launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
for name in "${names[@]}"; do
  folder=build/agent/$name found=()
  if [ ! -e "/usr/lib/${triplets[$name]}/libzstd.a" ] || [ ! -e "/usr/lib/${triplets[$name]}/libz.a" ]; then
    libraries "$name" "$folder/libraries"
    found=(-DCMAKE_PREFIX_PATH="$PWD/$folder/libraries/usr")
  fi
  quietly cmake -G Ninja -S app/agent -B "$folder" -DCMAKE_SYSTEM_NAME=Linux \
    -DCMAKE_SYSTEM_PROCESSOR="${processors[$name]}" -DCMAKE_C_COMPILER="${triplets[$name]}-gcc" \
    -DCMAKE_CXX_COMPILER="${triplets[$name]}-g++" "${found[@]}" "${launcher[@]}"
  quietly cmake --build "$folder"
  stat -c '%s bytes  %n' "$folder/bin/pitchboard-agent"
  [ $package = no ] || scripts/package.sh --agent --arch "$name" --built "$folder" --into "build/packages/$name"
done
