#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# packaging/change_logs.sh CHANGELOG.md "NAME <ADDRESS>" FOLDER
# Writes changelog.gz, which is that file, and changelog.Debian.gz, the same in Debian's form.
set -euo pipefail
export LC_ALL=C TZ=UTC
gzip -9nc "$1" >"$3/changelog.gz"
{
  end=''
  entry=0
  while IFS= read -r line; do
    if [[ $line =~ ^##\ ([0-9.]+)\ \((.*)\)$ ]]; then
      [ -z "$end" ] || printf '\n%s\n\n' "$end"
      # Two versions of one day: the newer one is later in the day.
      end=" -- $2  $(date -R -d "${BASH_REMATCH[2]} 12:00 $entry minutes ago")"
      entry=$((entry + 1))
      printf 'pitchboard (%s-1) unstable; urgency=medium\n\n' "${BASH_REMATCH[1]}"
    elif [[ $line == "- "* ]]; then
      fold -s -w 75 <<<"${line#- }" | sed '1s/^/  * /; 2,$s/^/    /; s/ *$//'
    elif [[ $line == "  "* ]]; then
      fold -s -w 75 <<<"${line#  }" | sed 's/^/    /; s/ *$//'
    fi
  done
  printf '\n%s\n' "$end"
} <"$1" | gzip -9nc >"$3/changelog.Debian.gz"
