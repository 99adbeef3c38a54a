#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_experiment_recipes.sh RECIPES BIN: the recipes of docs/experiments.md, and the command line of
# experiments from outside: exit codes, interruption, shards, replay, situation tests.
set -uo pipefail
recipes=$1
export PITCHBOARD_CLI=$2/pitchboard-cli PITCHBOARD_JOBS=2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0
fail() {
  echo "FAIL: $*"
  failures=$((failures + 1))
}
# expect CODE TEXT ARGUMENT...: the program ends with the code and says the text.
expect() {
  local code=$1 text=$2 said ended
  shift 2
  said=$("$PITCHBOARD_CLI" "$@" 2>&1)
  ended=$?
  [ $ended -eq "$code" ] && [[ $said == *"$text"* ]] ||
    fail "$* ended with $ended instead of $code, or does not say \"$text\": $said"
}
# same A B: the files of both folders have the same bytes; recorded sessions aside.
same() {
  diff -r --exclude=sessions "$1" "$2" > difference.txt || fail "$1 and $2: $(head -c 500 difference.txt)"
}

cat > short.json << 'JSON'
{"version": 1, "name": "short", "runs": 6, "record": [2],
 "scenario": {"version": 1, "noise": "paper", "ball": {"x": 0.3},
   "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "naive"}],
   "writes": [{"variable": "COM_REFEREE", "value": 2}]},
 "stop": {"duration": 5}, "success": "time_s == 5", "assertions": ["success_rate == 1"]}
JSON
expect 0 "holds   as the scenario: success_rate == 1 (success_rate = 1)" experiment short.json --out whole
[ -s whole/sessions/run-000002.mcap ] || fail "run 2 was not recorded"
expect 2 "holds results; add --resume" experiment short.json --out whole
expect 0 "as in the results" experiment replay whole --run 5 -o five.mcap
expect 0 "B1" inspect five.mcap
expect 2 "there is no run 7" experiment replay whole --run 7
# The report alone, after somebody has removed it; of a folder without results there is none.
cp whole/report.html report-before.html && rm whole/report.html whole/runs.csv
expect 0 "holds   as the scenario: success_rate == 1 (success_rate = 1)" experiment report whole
cmp whole/report.html report-before.html || fail "the report differs from the first one"
[ -s whole/runs.csv ] || fail "runs.csv was not written"
expect 2 "is this the folder of an experiment" experiment report no-such-folder
expect 2 "--shard must be i/n" experiment short.json --out x --shard 3/2
sed 's/"time_s == 5"/"goal"/' short.json > bad.json
expect 1 "FAILED  as the scenario: success_rate == 1 (success_rate = 0)" experiment bad.json --out bad
grep -q '<failure message="success_rate = 0"/>' bad/junit.xml || fail "junit.xml tells no failure"
mkdir cases && cp bad.json short.json cases
expect 1 "2 tests, 2 assertions, 1 failed" test cases --junit all.xml
expect 0 "8 tests, 25 assertions, 0 failed" test
expect 0 "1 test, " test ready-positions
expect 2 "no such folder, file or example" test no-such-test
# What cannot be read is an error of its own; the rest, in subfolders too, is played, and the JUnit file is written.
mkdir -p mixed/sub && cp short.json mixed/sub && cp bad.json mixed/z.json
echo '{"version": 1' > mixed/broken.json
printf '{"version": 1, "name": "n\u0001", "x": 1}' > mixed/a.json
sed 's/, *"assertions": \[[^]]*\]//' short.json > mixed/empty.json
ln -s .. mixed/sub/above
expect 2 "5 tests, 2 assertions, 1 failed, 3 with errors" test mixed --junit mixed.xml
expect 2 "no/such/folder" test no/such/folder --junit nothing.xml
python3 -c 'import xml.etree.ElementTree as t
suites = t.parse("mixed.xml").getroot()
assert [s.get("errors", "0") for s in suites] == ["1", "1", "1", "0", "0"], [s.attrib for s in suites]
assert [s.get("failures") for s in suites] == ["0", "0", "0", "0", "1"], [s.attrib for s in suites]
assert "assertions" in suites[2].find("testcase/error").get("message")
assert t.parse("nothing.xml").getroot().find("testsuite/testcase/error") is not None' || fail "mixed.xml"
python3 -c 'import xml.etree.ElementTree as t
r = t.parse("all.xml").getroot()
assert [s.get("failures") for s in r] == ["1", "0"], [s.attrib for s in r]' || fail "all.xml"
python3 - << 'PY' || fail "runs.csv and summary.json differ"
import csv, json, statistics
rows = list(csv.DictReader(open("whole/runs.csv")))
summary = json.load(open("whole/summary.json"))["conditions"][0]["metrics"]
for name in ("walked_m", "displacement_m", "kicks"):
    values = [float(row[name]) for row in rows]
    assert abs(statistics.fmean(values) - summary[name]["mean"]) < 1e-12, name
    assert abs(statistics.stdev(values) - summary[name]["sd"]) < 1e-9, name
    assert abs(statistics.median(values) - summary[name]["median"]) < 1e-12, name
PY

# A hundred times the runs need next to no more memory: 8 bytes for each figure of a run.
sed 's/"duration": 5/"duration": 0.1/; s/"record": \[2\],//; s/time_s == 5/time_s > 0/' short.json > tiny.json
python3 - << 'PY' || fail "memory grows with the number of runs"
import os
def peak_megabytes(runs):
    cli = os.environ["PITCHBOARD_CLI"]
    out = os.open("/dev/null", os.O_WRONLY)
    child = os.posix_spawn(cli, [cli, "experiment", "tiny.json", "--out", "tiny-%d" % runs, "--runs",
                                 str(runs), "--jobs", "2"], os.environ,
                           file_actions=[(os.POSIX_SPAWN_DUP2, out, 1), (os.POSIX_SPAWN_DUP2, out, 2)])
    _, status, use = os.wait4(child, 0)
    assert status == 0, status
    return use.ru_maxrss / 1024
few, many = peak_megabytes(50), peak_megabytes(5000)
assert many < few + 8, (few, many)
PY

# GNU parallel gives the same bytes as one program.
if command -v parallel > /dev/null; then
  "$recipes/experiment-parallel.sh" "$folder/short.json" "$folder/shards" 3 > parallel.txt 2>&1 ||
    fail "experiment-parallel.sh: $(cat parallel.txt)"
  same whole shards/all
else
  echo "SKIP: GNU parallel is not installed"
fi
# A Slurm array: the script as a node runs it, task by task (tst_experiment_slurm has a real one).
bash -n "$recipes/experiment-slurm.sh" || fail "experiment-slurm.sh is no bash"
for task in 1 2; do
  SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=2 SLURM_CPUS_PER_TASK=1 \
    "$recipes/experiment-slurm.sh" short.json array > task.txt 2>&1 || fail "task $task: $(cat task.txt)"
done
expect 0 "whole" experiment merge array/shard-1 array/shard-2 --out whole-array
same whole whole-array
expect 2 "a shard is missing" experiment merge array/shard-1 --out half
expect 2 "of 6 runs have ended; play the others" experiment report array/shard-1

# Interrupted after the first runs have ended, then resumed: the same bytes.
sed 's/"runs": 6/"runs": 400/; s/"record": \[2\],//; s/"duration": 5/"duration": 60/; s/time_s == 5/time_s == 60/' \
  short.json > long.json
"$PITCHBOARD_CLI" experiment long.json --out long --jobs 2 > interrupted.txt 2>&1 &
pid=$!
while kill -0 $pid 2> /dev/null && [ "$({ wc -l < long/runs.jsonl; } 2> /dev/null || echo 0)" -lt 3 ]; do :; done
kill -INT $pid
wait $pid
code=$?
if [ $code -eq 2 ]; then
  grep -q "runs; add --resume to continue" interrupted.txt || fail "interrupted: $(cat interrupted.txt)"
  [ ! -e long/report.md ] || fail "an interrupted experiment has a report"
  expect 0 "holds" experiment long.json --out long --resume
else
  fail "it ended with $code before it could be interrupted"
fi
expect 0 "holds" experiment long.json --out long-whole --jobs 1
same long long-whole

[ $failures -eq 0 ] && echo "all recipes work"
exit $((failures > 0))
