#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_second_run.sh SOURCE: what scripts/second_run.sh does with tests that pass, fail, and fail only once.
set -uo pipefail
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0
fail() {
  echo "FAIL: $*"
  failures=$((failures + 1))
}
. "$source/scripts/second_run.sh"
mkdir -p tests checkout
printf '# A comment.\ntst_known 2026-01-02 it waits for a printer\n' >"$known_unstable"

# once NAME: a test that fails when it is run for the first time.
once() { echo "add_test($1 bash -c \"echo $1 speaks; [ -e $1 ] || { touch $1; exit 1; }\")"; }
# run TEST...: both runs with these tests; the code and the report are in `code`, `reported` and `report`.
run() {
  rm -rf checkout "$second_runs"
  mkdir checkout
  printf '%s\n' "$@" >checkout/CTestTestfile.cmake
  code=0 reported=0
  ctest --test-dir checkout >/dev/null 2>&1 || second_run checkout >first.txt 2>&1 || code=$?
  report=$(report_second_runs 2>&1) || reported=$?
}
good='add_test(tst_good true)'
bad='add_test(tst_bad false)'

run "$good"
[ "$code $reported $report" = "0 0 " ] || fail "a test that passes: $code, $reported, $report"
run "$good" "$bad"
[ $code -ne 0 ] || fail "a test that fails twice is accepted"
[ -z "$report" ] || fail "a test that fails twice is called unstable: $report"
[ "$(cat checkout/Testing/Temporary/LastTestsFailed.log)" = 2:tst_bad ] || fail "the list of failed tests is wrong"
run "$good" "$(once tst_known)" "$(once tst_new)"
[ "$code $reported" = "0 0" ] || fail "two unstable tests: $code, $reported"
[ ! -e checkout/Testing/Temporary/LastTestsFailed.log ] || fail "tests that passed are in the list of failed ones"
[[ $report == *"tst_known needed a second run (2026-01-02 it waits for a printer)"* ]] || fail "the cause is not named: $report"
[[ $report == *"tst_new needed a second run (not in tests/unstable.txt)"* ]] || fail "tst_new is not named: $report"
for test in tst_known tst_new; do
  for log in first second; do
    grep -q "^$test speaks" "$second_runs/$test.$log.log" || fail "$test.$log.log does not have its output"
    ! grep -v "$test" "$second_runs/$test.$log.log" | grep -q speaks || fail "$test.$log.log has another test's output"
  done
done
run "$(once tst_a)" "$(once tst_b)" "$(once tst_c)"
[ $code -eq 0 ] && [ $reported -ne 0 ] || fail "three unstable tests are accepted: $code, $reported"

# The list of the project: a name of a test, a date and a cause.
while read -r name date cause; do
  [[ $date =~ ^20[0-9]{2}-[01][0-9]-[0-3][0-9]$ && -n $cause ]] || fail "tests/unstable.txt: \"$name\" has no date or no cause"
done < <(grep -v '^#' "$source/tests/unstable.txt")
[ $failures -eq 0 ]
