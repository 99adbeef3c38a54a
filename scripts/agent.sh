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

install_packages scripts/packages-agent.txt
launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
for name in "${names[@]}"; do
  folder=build/agent/$name
  quietly cmake -G Ninja -S app/agent -B "$folder" -DCMAKE_SYSTEM_NAME=Linux \
    -DCMAKE_SYSTEM_PROCESSOR="${processors[$name]}" -DCMAKE_C_COMPILER="${triplets[$name]}-gcc" \
    -DCMAKE_CXX_COMPILER="${triplets[$name]}-g++" "${launcher[@]}"
  quietly cmake --build "$folder"
  stat -c '%s bytes  %n' "$folder/bin/pitchboard-agent"
  [ $package = no ] || scripts/package.sh --agent --arch "$name" --built "$folder" --into "build/packages/$name"
done
