#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_manuals.sh SOURCE BIN: the manual pages and completions in packaging/ say what the programs say. With
# PITCHBOARD_WRITE_DOCS=1 it writes them.
set -euo pipefail
source=$1 bin=$2
programs=("$bin"/{pitchboard,pitchboard-agent,pitchboard-cli,pitchboard-robot})
if [ -n "${PITCHBOARD_WRITE_DOCS:-}" ]; then
  "$source/packaging/write_pages.sh" "$source/packaging" "${programs[@]}"
  exit 0
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$source/packaging/write_pages.sh" "$folder" "${programs[@]}"
[ "$(ls "$folder/man" | wc -l)" -gt 20 ] || { echo "FAIL: only these pages were made: $(ls "$folder/man")"; exit 1; }
for kind in man completions; do
  diff -ru "$source/packaging/$kind" "$folder/$kind" || failed=yes
done
[ -z "${failed:-}" ] || { echo "FAIL: they are old; write them with: PITCHBOARD_WRITE_DOCS=1 ./test -R tst_manuals"; exit 1; }
command -v man >/dev/null || exit 0  # a fresh system has no man; all others check that it finds no mistake
for page in "$folder"/man/*.1; do
  said=$(sed 's/@[A-Z_]*@/1/g' "$page" | man -Tutf8 --warnings=w -l /dev/stdin 2>&1 >/dev/null) || true
  [ -z "$said" ] || { echo "FAIL: $(basename "$page"): $said"; exit 1; }
done
