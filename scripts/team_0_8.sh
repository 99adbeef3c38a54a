#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The robots of version 0.8, built as an opponent of today's.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

usage() {
  cat <<'END'
Usage: scripts/team_0_8.sh DIR
Builds pitchboard-robot of version 0.8 in DIR, and puts beside it a runtime profile that plays with it
(team-0.8.json; team-0.8-programs.json: as a team's own programs) and a tournament against today's robots.
Example:
  scripts/team_0_8.sh /tmp/team-0.8
  pitchboard-cli tournament /tmp/team-0.8/against-0.8.json --out results
END
}

case ${1:-} in
  -h | --help) usage; exit 0 ;;
  '') usage >&2; exit 2 ;;
esac
dir=$(readlink -m "$1")
commit=f5ea91a5
mkdir -p "$dir"
[ -e "$dir/source/CMakeLists.txt" ] || git worktree add --detach "$dir/source" $commit
cmake -S "$dir/source" -B "$dir/build" -G Ninja -DPITCHBOARD_STUDIO=OFF -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=Release
ninja -C "$dir/build" pitchboard-robot
sed "s|\./build|$dir/build|" tests/data/teams/team-0.8-programs.json > "$dir/team-0.8-programs.json"
cp tests/data/teams/team-0.8.json tests/data/teams/against-0.8.json "$dir"
echo "$dir/against-0.8.json"
