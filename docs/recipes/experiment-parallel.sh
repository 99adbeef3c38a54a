#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# experiment-parallel.sh EXPERIMENT DIR SHARDS: an experiment in shards with GNU parallel.
# On several computers: add --sshloginfile HOSTS and a folder that all of them see.
# A second start goes on where the first was interrupted.
set -euo pipefail
experiment=$1 dir=$2 shards=$3
cli=${PITCHBOARD_CLI:-pitchboard-cli}
mkdir -p "$dir"
parallel --will-cite --jobs "${PITCHBOARD_JOBS:-100%}" \
  "$cli" experiment "$experiment" --out "$dir/shard-{}" --shard "{}/$shards" --jobs 1 --resume \
  ::: $(seq "$shards")
"$cli" experiment merge "$dir"/shard-* --out "$dir/all"
