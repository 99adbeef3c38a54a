#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# packaging/change_log.sh CHANGELOG.md VERSION "NAME <ADDRESS>" >debian/changelog
# Writes Debian's change log: this version and those before it. What changed is in CHANGELOG.md, which every package
# has, too.
set -euo pipefail
export LC_ALL=C TZ=UTC
entry=0
while read -r version date; do
  # Two versions of one day: the newer one is later in the day.
  printf 'pitchboard (%s-1) unstable; urgency=medium\n\n  * New version; changelog.gz has what changed.\n\n -- %s  %s\n\n' \
    "$version" "$3" "$(date -R -d "$date 12:00 $entry minutes ago")"
  entry=$((entry + 1))
done < <(sed -n 's/^## \([0-9.]*\) (\(.*\))$/\1 \2/p' "$1" | sed -n "/^${2//./\\.} /,\$p")
[ $entry -gt 0 ] || { echo "error: $1 has no line \"## $2 (YEAR-MONTH-DAY)\"; add it" >&2; exit 2; }
