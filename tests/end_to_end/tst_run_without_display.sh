#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_run_without_display.sh RUN BIN: ./run on a computer without a display, with programs built in BIN.
set -uo pipefail
run=$1
export PITCHBOARD_BIN=$2
unset DISPLAY WAYLAND_DISPLAY QT_QPA_PLATFORM
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0

# expect EXIT_CODE TEXT ARGUMENT...: ./run ends with the code and says the text; its pictures are removed.
expect() {
  local code=$1 text=$2 said
  shift 2
  rm -f field.png
  said=$("$run" "$@" 2>&1)
  local ended=$?
  if [ $ended -ne "$code" ] || [[ $said != *"$text"* ]]; then
    printf 'FAIL: ./run %s ended with %s instead of %s, or does not say "%s":\n%s\n' \
      "$*" $ended "$code" "$text" "$said"
    failures=$((failures + 1))
  fi
}
expect_picture() {
  [ "$(head -c 4 field.png 2>/dev/null | tail -c 3)" = PNG ] && return
  echo "FAIL: $1: there is no field.png"
  failures=$((failures + 1))
}

# The default decides by processes on System V blackboards: with keys of this test's own.
expect 0 "Score " --duration 1 --key-base $((700000000 + $$ * 100))
expect_picture "separate processes"
expect 0 "5.00 s simulated" --duration 5 --cognition inline
expect_picture "--duration"
expect 0 "Scenario 1: " --scenario scenario-1 --duration=2 --cognition=inline
expect_picture "--scenario"
cp field.png before.png
expect 0 "One robot and a ball (" --cognition inline --scenario=one-robot --duration 2
expect_picture "--scenario=NAME"
if cmp -s field.png before.png; then
  echo "FAIL: two scenarios give the same picture"
  failures=$((failures + 1))
fi
expect 0 "One robot and a ball (" --scenario one-robot --duration 2 --cognition inline --save-moment mine.pitchboard.json
expect 0 "One robot and a ball, at 2.0 s" mine.pitchboard.json --duration 1 --cognition inline
expect 0 "scenario-1" --list
expect 0 "" --render-scenario one-robot --picture field.png
expect_picture "--render-scenario"

# In a checkout the picture goes to the build folder, which git ignores.
mkdir -p checkout/docs checkout/scripts
cp "$run" checkout/ && cp "$(dirname "$run")/scripts/common.sh" checkout/scripts/
for place in . docs; do
  said=$(cd checkout/$place && "$folder/checkout/run" --scenario one-robot --duration 1 --cognition inline 2>&1)
  pictures=$(cd checkout && find . -name '*.png')
  if [ "$pictures" != ./build/field.png ] || [[ $said != *"checkout/build/field.png"* ]]; then
    printf 'FAIL: in %s of a checkout there is "%s", and ./run says:\n%s\n' $place "$pictures" "$said"
    failures=$((failures + 1))
  fi
  rm -rf checkout/build
done

"$PITCHBOARD_BIN/pitchboard-cli" record --scenario one-robot --duration 2 -o match.mcap >/dev/null 2>&1
expect 0 "Replay needs a window" match.mcap
expect 0 "121 rows of" match.mcap
expect 0 "121 rows of" --session match.mcap
expect 2 "error:" nothing.mcap
expect 2 "there is no display, and Live needs a window; pitchboard-cli listen" --live
expect 2 "pitchboard-cli record" --record other.mcap
expect 2 "--theme needs a window" --theme dark
# The list is the program's, whatever comes to it.
for option in $("$PITCHBOARD_BIN/pitchboard" --option-list pitchboard | sed -n 's/ .*Live needs a window.*//p'); do
  expect 2 "Live needs a window" "$option" 1
done
expect 2 "Live needs a window" --variables-port-base=0
expect 2 "Live needs a window" --attach 100
expect 0 "Score " --cognition inline --keep-speed --duration 1 --scenario one-robot
expect_picture "an option without a value"
expect 2 "error:" --no-such-option
exit $((failures > 0))
