#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# packaging/write_pages.sh FOLDER PROGRAM...
# Writes man/*.1, a manual page for every program and every command of it, made from what --help-all says, and
# completions/{bash,zsh}, which the programs print. packaging/ has them; tst_manuals compares them with the programs.
# Version and date are names that CMake replaces. Needs help2man, no display.
set -euo pipefail
export LC_ALL=C.UTF-8 TZ=UTC
folder=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rm -rf "$folder"/{man,completions}
mkdir -p "$folder"/{man,completions/{bash,zsh}}

# page PROGRAM WORD...: the page of "PROGRAM WORD...", then those of its commands.
page() {
  local program=$1 help name summary command all=--help-all
  shift
  [[ $program != */pitchboard-agent ]] || all=--help  # all of its options are common
  name=$(IFS=-; echo "$(basename "$program")${*:+-$*}")
  help=$("$program" "$@" $all)
  # The first sentence names the page; examples go to the end, where manuals have them.
  summary=$(sed -n '/^$/q;p' <<<"$help" | tr '\n' ' ' | sed 's/^Pitchboard: //;s/\. .*//;s/\. *$//')
  {
    echo '#!/bin/sh'
    echo "cat <<'END_OF_HELP'"
    awk '/^Documentation: / { next }  # a path of this computer
         /^Examples?:$/ { example = 1; next }
         example && !NF { example = 0; next }
         example        { examples = examples $0 "\n"; next }
                        { print }
         END { if (examples) printf "\nExamples:\n%s", examples }' <<<"$help"
    echo 'END_OF_HELP'
  } >"$work/$name"
  chmod +x "$work/$name"
  help2man --no-info --no-discard-stderr --version-string=@PROJECT_VERSION@ --name="$summary" \
    --source="Pitchboard @PROJECT_VERSION@" --manual="Pitchboard" "$work/$name" |
    sed -e '1s/.*/.\\" SPDX-License-Identifier: GPL-3.0-or-later/' \
      -e '/^\.TH /s/"[A-Z][a-z]* [0-9]\{4\}"/"@PITCHBOARD_RELEASE_DATE@"/' \
      -e '/^\.SH EXAMPLES/,$ s/^\.IP$/.IP\n.nf/' >"$folder/man/$name.1"
  for command in $(sed -n '/^Commands:/,/^$/s/^  \([a-z][a-z-]*\)\( .*\)\{0,1\}$/\1/p' <<<"$help"); do
    page "$program" "$@" "$command"
  done
}

for program in "$@"; do
  page "$program"
  name=$(basename "$program")
  [ "$name" != pitchboard-agent ] || continue  # it has a few options and no commands
  "$program" --completion bash >"$folder/completions/bash/$name"
  "$program" --completion zsh >"$folder/completions/zsh/_$name"
done
