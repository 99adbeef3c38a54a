#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_experiment_slurm.sh RECIPES BIN: the job array of docs/recipes in a Slurm of one node, which
# this script starts for itself, on ports of its own, as whoever runs it, and ends again.
# Exit status 77: Slurm is not installed here.
set -uo pipefail
recipes=$(realpath "$1")
export PITCHBOARD_CLI=$2/pitchboard-cli
PATH=$PATH:/usr/sbin
for program in slurmctld slurmd sbatch scontrol; do
  command -v $program > /dev/null || {
    echo "SKIP: $program is not installed (packages slurmctld, slurmd, slurm-client)"
    exit 77
  }
done
folder=$(mktemp -d)
cd "$folder" || exit 1
mkdir state spool
failures=0 controller='' node=''
end() {
  for pid in $node $controller; do kill "$pid" 2> /dev/null; done
  wait
  rm -rf "$folder"
}
trap end EXIT
fail() {
  echo "FAIL: $*"
  failures=$((failures + 1))
}
# waitFor SECONDS WORDS COMMAND: until the command's output has the words.
waitFor() {
  local until=$((SECONDS + $1)) words=$2
  shift 2
  until [[ $("$@" 2> /dev/null) == *"$words"* ]]; do
    [ $SECONDS -lt $until ] || return 1
    sleep 0.2
  done
}

read -r port nodePort <<< "$(python3 -c 'import socket
sockets = [socket.socket() for _ in range(2)]
for one in sockets: one.bind(("127.0.0.1", 0))
print(*[one.getsockname()[1] for one in sockets])')"
# No munge: nobody else is asked to believe this cluster anything.
cat > slurm.conf << CONF
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$nodePort
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
ReturnToService=2
KillWait=5
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
NodeName=node NodeHostname=$(hostname) NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
slurmctld -D > controller.txt 2>&1 &
controller=$!
slurmd -D -N node > node.txt 2>&1 &
node=$!
if ! waitFor 60 idle sinfo -h -o %T; then
  fail "Slurm does not start: $(tail -n 3 slurmctld.log slurmd.log controller.txt node.txt 2>&1)"
  exit 1
fi

cat > short.json << 'JSON'
{"version": 1, "name": "short", "runs": 6,
 "scenario": {"version": 1, "noise": "paper", "ball": {"x": 0.3},
   "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "naive"}],
   "writes": [{"variable": "COM_REFEREE", "value": 2}]},
 "stop": {"duration": 5}, "assertions": ["timeout_rate == 1"]}
JSON
"$PITCHBOARD_CLI" experiment short.json --out whole > whole.txt 2>&1 || fail "$(cat whole.txt)"
sbatch --test-only --array=1-3 "$recipes/experiment-slurm.sh" short.json results > only.txt 2>&1 ||
  fail "sbatch refuses the script: $(cat only.txt)"

# As the recipe says: an array, then the merge.
array() {
  sbatch --parsable --output=task-%a.txt --array="$1" "$recipes/experiment-slurm.sh" short.json \
    "$folder/results" 3
}
job=$(array 1-3) || { fail "the array was not taken"; exit 1; }
sbatch --parsable --output=merge.txt --dependency="afterok:$job" \
  --wrap "'$PITCHBOARD_CLI' experiment merge '$folder'/results/shard-* --out '$folder/results/all'" \
  > merging.txt || fail "the merge was not taken"
waitFor 100 COMPLETED scontrol -o show job "$(cat merging.txt)" ||
  fail "the array or its merge does not end: $(squeue; cat task-*.txt merge.txt 2>&1)"
diff -r --exclude=sessions whole results/all > difference.txt ||
  fail "a Slurm array gives other results: $(head -c 500 difference.txt)"

# A task that is submitted again goes on with what is there: here there is nothing left to play.
again=$(array 2)
waitFor 60 COMPLETED scontrol -o show job "$again" || fail "the second task: $(cat task-2.txt)"
grep -q "runs/s" task-2.txt && fail "it played its runs again: $(cat task-2.txt)"

# One that is cancelled keeps its runs, and the next one goes on with them.
sed 's/"runs": 6/"runs": 60/; s/"duration": 5/"duration": 600/' short.json > long.json
long() {
  sbatch --parsable --output=long.txt --array=1 "$recipes/experiment-slurm.sh" long.json "$folder/long"
}
job=$(long)
lines() { wc -l < long/shard-1/runs.jsonl; }
until [ "$({ lines; } 2> /dev/null || echo 0)" -ge 3 ]; do
  [ $SECONDS -lt 150 ] || break
  sleep 0.2
done
scancel "$job"
waitFor 60 CANCELLED scontrol -o show job "$job" || fail "scancel: $(scontrol show job "$job")"
waitFor 30 idle sinfo -h -o %T
kept=$(lines)
[ "$kept" -ge 3 ] || fail "a cancelled task kept $kept runs: $(cat long.txt)"
head -n 3 long/shard-1/runs.jsonl > kept.txt
job=$(long)
waitFor 100 COMPLETED scontrol -o show job "$job" || fail "the resumed task: $(cat long.txt)"
[ "$(lines)" -eq 60 ] || fail "the resumed task has $(lines) of 60 runs"
grep -qFf kept.txt long/shard-1/runs.jsonl || fail "the runs of the cancelled task are gone"

[ $failures -eq 0 ] && echo "the array in Slurm works, $SECONDS s"
exit $((failures > 0))
