#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# An experiment as a Slurm job array; a task is a shard. The folder is one that all nodes see.
#   sbatch --array=1-64 experiment-slurm.sh EXPERIMENT DIR
#   sbatch --dependency=afterok:JOB --wrap 'pitchboard-cli experiment merge DIR/shard-* --out DIR/all'
# A task that was cancelled or ran out of time keeps its runs and goes on with them when it is
# submitted again; say then how many shards there are in all:
#   sbatch --array=7 experiment-slurm.sh EXPERIMENT DIR 64
#SBATCH --job-name=pitchboard
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem=500M
#SBATCH --time=01:00:00
#SBATCH --signal=B:TERM@60
set -euo pipefail
experiment=$1 dir=$2 shards=${3:-$SLURM_ARRAY_TASK_COUNT}
exec "${PITCHBOARD_CLI:-pitchboard-cli}" experiment "$experiment" \
  --out "$dir/shard-$SLURM_ARRAY_TASK_ID" --shard "$SLURM_ARRAY_TASK_ID/$shards" \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" --resume
