#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. scripts/common.sh

usage() {
  cat <<'END'
Usage: scripts/fuzz.sh [SECONDS] [NAME...]
Builds the fuzz targets (tests/fuzz/fuzz_NAME.cpp) with clang and sanitizers, and runs all of them, or
those that are named, for SECONDS each (default: 60), two at a time. One line for each says how many
inputs it tried, how many a second, and whether one made it fail; then the exit code is 1, the input
is in build/asan-core/fuzz/findings and its report in build/asan-core/fuzz/logs: turn it into a test.
New inputs are kept in build/asan-core/fuzz/corpus. Missing packages are installed.
Example: scripts/fuzz.sh 300 session moments
END
}

case ${1:-} in -h | --help) usage; exit 0 ;; esac
seconds=${1:-60}
[[ $seconds =~ ^[0-9]+$ ]] || { echo "error: SECONDS must be a whole number" >&2; usage >&2; exit 2; }
shift || true
all=(tests/fuzz/fuzz_*.cpp)
all=("${all[@]##*/fuzz_}")
all=("${all[@]%.cpp}")
targets=("${@:-${all[@]}}")
for target in "${targets[@]}"; do
  [ -e "tests/fuzz/fuzz_$target.cpp" ] || { echo "error: no target \"$target\"; there are: ${all[*]}" >&2; exit 2; }
done

install_packages scripts/packages-run.txt scripts/packages-clang.txt
build asan-core "${targets[@]/#/fuzz_}"

build=build/asan-core/fuzz
seeds=$build/seeds
rm -rf "$seeds"
mkdir -p "${all[@]/#/$seeds/}" "$build/findings"
cp tests/data/gamecontroller/*.bin "$seeds/referee/"
cp resources/profiles/*.json "$seeds/profile/"
cp resources/teams/*.json "$seeds/formats/"
cp resources/rules/*.json resources/robots/*.json resources/runtime/*.json "$seeds/rules/"
cp resources/experiments/*.json resources/situations/*.json docs/examples/*.json "$seeds/experiment/"
cp tests/data/sessions/{small,plain_broken_off}.mcap "$seeds/session/"  # small ones: more inputs a second
cp tests/data/sessions/*.mcap "$seeds/moments/"
# The first byte says which reader gets the rest (fuzz_recordings.cpp).
for file in tests/data/recordings/*.mcap tests/data/recordings/ros2/{cdr_test,for_seek}.mcap; do
  { printf 'm'; cat "$file"; } > "$seeds/recordings/${file##*/}"
done
{ printf 'd'; cat tests/data/recordings/ros2/cdr_test.db3; } > "$seeds/recordings/cdr_test.db3"
printf 'ctime;x [m];name\n0,5;1;a\n1;2;"b"\n' > "$seeds/recordings/table.csv"
sed -n '/^```yml log.yaml$/,/^```$/{/^```/d;p}' docs/other-robots.md | sed '1s/^/y/' > "$seeds/recordings/log.yaml"
printf '2uint8 a\nfloat64[] b\nstring c\nP[2] d\n====================\nMSG: p/P\nint16 x\0\0\1\0\0\1\0\0\0\0\0\0\0' > "$seeds/recordings/ros2msg"
printf 'imodule p { module msg { @appendable struct T { long a; sequence<double> b; string c; }; }; };\0\0\11\0\0\4\0\0\0' > "$seeds/recordings/idl"
printf 'j{"a": [1, {"name": "b"}], "stamp": {"sec": 1, "nanosec": 2}}' > "$seeds/recordings/json"
printf 't{"op":"advertise","channels":[{"id":1,"topic":"/a","encoding":"protobuf","schema":"AA=="}]}' > "$seeds/foxglove/text"
printf 'q{"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]}' > "$seeds/foxglove/request"
printf 'c\3\0\0\0\200\77\1\0\0\0\0\0\0\0\0\2\0\0\0ab' > "$seeds/foxglove/control"
printf 'b\1\1\0\0\0\2\0\0\0\0\0\0\0{}' > "$seeds/foxglove/binary"
printf 'sws://robot3:8765/a,robot=3,team=red,map=FILE' > "$seeds/foxglove/source"
cp resources/scenarios/*.json "$seeds/scenario/"
cp tests/data/catalogs/* resources/*.json "$seeds/catalog/"
printf '[Communication]\nno_player_robofei = 3\n[Pitchboard Management]\nprocesses = vision decision\ncommand.vision = python3 "a b.py" --key {key}\nresponse_timeout = 5\n' \
  > "$seeds/scenario/robot.ini"
printf '{"pitchboardPlots": 1, "current": 0, "tabs": [{"name": "A", "plots": [{"kind": "chart", "title": "T", "values": [0, 1], "rightValues": [2, 3], "curves": [{"kind": "difference", "inputs": ["B1/A", "first/B"], "colour": "#ff8800"}]}]}]}' \
  > "$seeds/layout/one.json"
number=0
while IFS= read -r text; do
  printf '%s' "$text" > "$seeds/short_texts/$((number += 1)).txt"
done <<'TEXTS'
hypot(B1.TRUE_X - 2, {B1/ball x}) * 100 > 3 && !B2.A ? deg(pi) : wrap(t, 360)
192.168.0.0/24
10.0.0.7
100,catalog=FILE,size=4096,robot=3,rate=100,team=red
PBT1 path 3 1 1500 -200 0 0
PBT1 cloud 3 2 100 200 90000 5 -100 0 0 1
PB1 2 450 300 90 12 1 0 4500300
TEXTS
for trace in tests/data/traces/i_action_0*.json; do
  { cat "$trace"; printf '\0'; cat "${trace%.json}.csv.gz"; } > "$seeds/trace/${trace##*/}"
done
printf 'PBD1 3 12\nlayer a/b robot 0.5\ncolour #11223344\nwidth 3\narrow 0 0 1.5 -0.5\ntext 1 1 hello\nmore c\ndisc 1 2 0.3\n' \
  > "$seeds/drawings/shapes.txt"
printf '1 450 300 90 12 83 -4 1 1 1 1 1 8 1.57 148 OUT\nPBD1 1\nlayer b belief 2\npolygon 0 0 1 0 1 1\n' \
  > "$seeds/drawings/message.txt"
printf 'PB2 3 7 4500300 @REFRESH=2000 @WAITING=0 @BLACKBOARD=1 DECISION_ACTION_A=1 IMU_EULER_Z=-1.5707964 VOLTAGE=189 OUT' \
  > "$seeds/pb2/message.txt"
{
  printf '\003\062PB2 4 0 1000 @REFRESH=2000 @WAITING=0 @BLACKBOARD=1 LOCALIZATION_X=450 LOCALIZATION_Y=300 OUT\n'
  printf '\003\375PB2 4 1 9000 VISION_BALL_DIST=80.5 OUR_GAIT=3 OUT\n\003\062PB2 4 0 8900 VOLTAGE=189 OUT\n'
} > "$seeds/variables/conversation.txt"
grep '^→ ' docs/worlds.md | sed 's/^→ //; s/"scenario": "one-robot", //; s/"ticks": [0-9]*/"ticks": 2/' \
  > "$seeds/lines/conversation.txt"
number=0
while IFS=$'\t' read -r _ _ datagram; do
  printf '%s' "$datagram" > "$seeds/text/$((number += 1)).txt"
done < tests/data/telemetry/telemetry_capture_1_robot_60s.txt

# A message of each format, and behind the byte that chooses the format or the port.
python3 - tests/data/team_messages.json "$seeds" <<'PYTHON'
import json, math, pathlib, struct, sys
seeds = pathlib.Path(sys.argv[2])
for place, message in enumerate(json.load(open(sys.argv[1], encoding="utf-8"))["messages"]):
    data = bytes.fromhex(message["hex"]) if "hex" in message else message["text"].encode()
    for first in range(24):
        (seeds / "formats" / f"{place}-{first}").write_bytes(bytes([first]) + data)
    for port in range(8):
        (seeds / "live" / f"{place}-{port}").write_bytes(bytes([port]) + data)
robot = {"number": 3, "slot": 0, "address": 167772161, "port": 5000, "last": 1000, "messages": 2,
         "arrivals": [0, 1000], "values": [1, None], "words": ["1", ""], "errors": [0, 1],
         "processes": [{"p": 0.9, "known": True, "since": 0}], "sequence": {"bits": 8, "newest": 3}}
options = {"ourTeam": 12, "field": "spl", "teams": [{"setup": "{\"number\": 12}", "profile": ""}]}
state = {"time": 1, "options": options, "robots": json.dumps({"robots": [robot]}),
         "referee": [{"at": 0, "address": 1, "port": 3838, "localPort": 3838, "base64": "UkdtZQ=="}]}
(seeds / "live_state" / "one").write_text(json.dumps(state))
# A robot that turns: all variables in the first row, then IMU, ball and corners.
rows = bytes([0]) + b"\xff" + struct.pack("<iiififfi", 2, 10, 1, 0.0, 0, 150.0, 5.0, 0)
rows += b"\xff" + struct.pack("<ffffiiif", 140.0, 40.0, -140.0, -40.0, 300, 350, 0, 10.0)
rows += b"\xff" + struct.pack("<ffffiiif", 200.0, 10.0, 210.0, 20.0, 0, 1, 2, 0.0)
for row in range(1, 40):
    turned = 0.01 * row + 0.004 * math.sin(7 * row)
    rows += b"\x68" + struct.pack("<fff", turned, 150 + 5 * math.sin(row), 5 - math.degrees(turned))
    rows += b"\x02" + struct.pack("<f", 40 - math.degrees(turned) + math.cos(3 * row)) + b"\x00"
(seeds / "calibrate" / "turns").write_bytes(rows)

def frame(binary, body):
    return bytes([binary]) + len(body).to_bytes(2, "little") + body
pose = {"id": 1, "topic": "/amcl_pose", "encoding": "json", "schema": "",
        "schemaName": "geometry_msgs/msg/PoseWithCovarianceStamped"}
joint = {"id": 2, "topic": "/joint", "encoding": "cdr", "schemaName": "a/msg/B", "schema": "float64 x"}
turned = {"x": 0, "y": 0, "z": 0, "w": 1}
body = json.dumps({"pose": {"pose": {"position": {"x": 1, "y": 2}, "orientation": turned}}}).encode()
(seeds / "foxglove" / "conversation").write_bytes(
    b"c" + frame(0, b'{"op":"serverInfo","name":"a","sessionId":"b"}')
    + frame(0, json.dumps({"op": "advertise", "channels": [pose, joint]}).encode())
    + frame(1, bytes([1]) + struct.pack("<IQ", 1, 10**9) + body)
    + frame(1, bytes([1]) + struct.pack("<IQ", 2, 10**9) + b"\0\1\0\0" + struct.pack("<d", 1.5))
    + frame(0, b'{"op":"unadvertise","channelIds":[1]}'))

def record(stream, body):
    return bytes([stream]) + len(body).to_bytes(2, "little") + body
message = b"1 450 300 90 12 83 -4 1 1 1 1 1 8 1.57 148 OUT"
referee = pathlib.Path("tests/data/gamecontroller/v12hl640_PLAYING_1-0.bin").read_bytes()
(seeds / "moments" / "live").write_bytes(record(2, json.dumps(state).encode()) + record(0, message)
                                         + record(1, referee) + record(0, message))
PYTHON

# fuzz NAME: one line about it; fails if an input made the target fail. (Entropic schedules would take more
# time than what is tested.)
fuzz() {
  local target=$1 length=2000 log=$build/logs/$1.log code=0 runs rate
  case $target in
    profile | experiment | scenario) length=8000 ;;
    lines) length=1000 ;;
    calibrate) length=700 ;;  # every input is fitted
    session) length=8200 ;;
    live_state | moments | catalog) length=16000 ;;
  esac
  UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 \
    "build/asan-core/bin/fuzz_$target" -max_total_time="$seconds" -entropic=0 -max_len=$length -timeout=25 -rss_limit_mb=1024 \
    -artifact_prefix="$build/findings/$target-" -dict="tests/fuzz/$target.dict" \
    -print_final_stats=1 "$build/corpus/$target" "$seeds/$target" >"$log" 2>&1 || code=$?
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  local found="no finding"
  [ $code -eq 0 ] || found="FAILED, see $log$(sed -n 's/.*Test unit written to /; input: /p' "$log")"
  printf '%-10s %9s inputs %7s/s  %s\n' "$target" "${runs:-0}" "${rate:-0}" "$found"
  [ $code -eq 0 ]
}

mkdir -p "$build/findings" "$build/logs" "${targets[@]/#/$build/corpus/}"
export -f fuzz
export build seeds seconds
printf '%s\n' "${targets[@]}" | xargs -P 2 -I{} bash -c 'set -euo pipefail; fuzz {}' || {
  echo "error: a fuzz target failed" >&2
  exit 1
}
