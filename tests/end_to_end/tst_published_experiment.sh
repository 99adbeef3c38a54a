#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_published_experiment.sh BIN: the published experiment with the published physics, 1000 runs
# without errors and 1000 with them, against what the published code gave when it was played again;
# and the t-test against the real robot, computed once more from the table of runs.
set -uo pipefail
cli=$1/pitchboard-cli
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
fail() {
  echo "FAIL: $*"
  exit 1
}
# The built-in file, as a results folder keeps it; without rigid bodies, which the paper has not.
"$cli" experiment paper-scenario-1 --out one --runs 1 > one.txt 2>&1
python3 - << 'PY' || fail "the built-in experiment: $(cat one.txt)"
import json
whole = json.load(open("one/experiment.json"))
whole["conditions"] = [c for c in whole["conditions"] if c["name"].startswith("published")]
names = [c["name"] for c in whole["conditions"]]
for figure in whole["compare"]:
    if "conditions" in figure:
        figure["conditions"] = [c for c in figure["conditions"] if c in names]
whole["runs"] = 1000
assert len(names) == 2 and len(whole["assertions"]) == 4
json.dump(whole, open("published.json", "w"))
PY
"$cli" experiment published.json --out results --jobs 2 > results.txt 2>&1 || fail "$(cat results.txt)"
[ "$(grep -c '^holds' results.txt)" -eq 4 ] || fail "not four assertions: $(cat results.txt)"
python3 - << 'PY' || fail "the t-test against the real robot"
import csv, json, math, statistics
summary = json.load(open("results/summary.json"))
report = open("results/report.md").read()
assert "The published 53 % of goals" in report
for condition in ("published, no errors", "published, with errors"):
    walked = [float(row["walked_m"]) for row in csv.DictReader(open("results/runs.csv"))
              if row["condition"] == condition]
    assert len(walked) == 1000
    ours, theirs = statistics.variance(walked) / 1000, 0.4282 ** 2 / 10
    t = (statistics.fmean(walked) - 8.484) / math.sqrt(ours + theirs)
    freedom = (ours + theirs) ** 2 / (ours ** 2 / 999 + theirs ** 2 / 9)
    told = [c for c in summary["comparisons"]
            if c["of"] == condition and c["minus"] == "real robot (Table 2)" and c["metric"] == "walked_m"]
    assert len(told) == 1, told
    assert abs(told[0]["welch"]["t"] - t) < 1e-6, (told, t)
    assert abs(told[0]["welch"]["df"] - freedom) < 1e-6, (told, freedom)
    line = "Distance walked, m | %s | real robot (Table 2)" % condition
    assert line in report, line
PY
echo "the published experiment gives what the published code gave"
