#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# packaging/man_pages.sh VERSION DATE FOLDER PROGRAM...
# Writes a compressed manual page for every program and every command of it into the folder, made
# from what --help says. Needs help2man, no display.
set -euo pipefail
export LC_ALL=C.UTF-8 TZ=UTC
version=$1 folder=$3
SOURCE_DATE_EPOCH=$(date -d "$2" +%s)
export SOURCE_DATE_EPOCH
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rm -rf "$folder"
mkdir -p "$folder"

# page PROGRAM WORD...: the page of "PROGRAM WORD...", then those of its commands.
page() {
  local program=$1 help name summary command
  shift
  name=$(IFS=-; echo "$(basename "$program")${*:+-$*}")
  help=$("$program" "$@" --help-all)
  # The first sentence names the page; examples go to the end, where manuals have them.
  summary=$(sed -n '/^$/q;p' <<<"$help" | tr '\n' ' ' | sed 's/^Pitchboard: //;s/\. .*//;s/\. *$//')
  {
    echo '#!/bin/sh'
    echo "cat <<'END_OF_HELP'"
    awk '/^Examples?:$/ { example = 1; next }
         example && !NF { example = 0; next }
         example        { examples = examples $0 "\n"; next }
                        { print }
         END { if (examples) printf "\nExamples:\n%s", examples }' <<<"$help"
    echo 'END_OF_HELP'
  } >"$work/$name"
  chmod +x "$work/$name"
  help2man --no-info --no-discard-stderr --version-string="$version" --name="$summary" \
    --source="Pitchboard $version" --manual="Pitchboard" "$work/$name" |
    sed '/^\.SH EXAMPLES/,$ s/^\.IP$/.IP\n.nf/' |
    gzip -9n >"$folder/$name.1.gz"
  for command in $(sed -n '/^Commands:/,/^$/s/^  \([a-z][a-z-]*\)\( .*\)\{0,1\}$/\1/p' <<<"$help"); do
    page "$program" "$@" "$command"
  done
}

for program in "$@"; do page "$program"; done
