# SPDX-License-Identifier: GPL-3.0-or-later
# For .ci/run and scripts/other_system.sh: second_run BUILD_FOLDER [CTEST OPTION...], report_second_runs. Run from the
# top folder. Some tests wait for other processes on a computer that may be busy. What fails is run once more, and that
# is never hidden: a test that passes only then is unstable, which is a defect to be mended.

second_runs=build/second_runs    # NAME.first.log and NAME.second.log of every test that was run twice
known_unstable=tests/unstable.txt
maximum_unstable=2               # with more of them in one run something else is wrong, and the run fails

# log_of_test LOG NAME: the part of a log of ctest that belongs to this test.
log_of_test() {
  awk -v name="$2" '/^[0-9]+\/[0-9]+ Testing: / { inside = $NF == name } inside' "$1"
}

# second_run BUILD_FOLDER [CTEST OPTION...]: after a run of ctest that failed, runs the failed tests again. Fails if one
# of them fails again, or if no test had failed: then ctest had another reason. FirstTest.log in the folder of
# LastTest.log is the log of the first run.
second_run() {
  local build=$1 temporary=$1/Testing/Temporary name failed code=0
  shift
  failed=$(cut -d: -f2 "$temporary/LastTestsFailed.log" 2>/dev/null)
  [ -n "$failed" ] || return 1
  mkdir -p "$second_runs"
  for name in $failed; do log_of_test "$temporary/LastTest.log" "$name" >"$second_runs/$name.first.log"; done
  cp "$temporary/LastTest.log" "$temporary/FirstTest.log"
  echo "Running what failed once more:" $failed >&2
  ctest --test-dir "$build" --rerun-failed --output-on-failure "$@" || code=$?
  [ $code -ne 0 ] || rm "$temporary/LastTestsFailed.log"  # ctest leaves the old one if nothing failed
  for name in $failed; do log_of_test "$temporary/LastTest.log" "$name" >"$second_runs/$name.second.log"; done
  return $code
}

# report_second_runs [PREFIX]: names the tests that passed only in their second run. Fails if there are too many of
# them. On another system (scripts/other_system.sh) the name of the system stands in front of the test's.
report_second_runs() {
  local log name known unstable=0
  for log in "$second_runs/${1:-}"*.second.log; do
    [ -e "$log" ] && grep -qx 'Test Passed\.' "$log" || continue
    name=${log##*/} name=${name%.second.log}
    known=$(awk -v name="${name##*:}" '$1 == name { $1 = ""; print substr($0, 2) }' "$known_unstable")
    echo "unstable: $name needed a second run (${known:-not in $known_unstable}); logs: $second_runs/$name.{first,second}.log" >&2
    unstable=$((unstable + 1))
  done
  [ $unstable -le $maximum_unstable ]
}
