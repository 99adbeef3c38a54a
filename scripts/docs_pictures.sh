#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes docs/images/* from the program itself: scripts/docs_pictures.sh [NAME...]
# Commit them when the window has changed. Needs a release build, xvfb, xdotool, imagemagick, ffmpeg, librsvg2-bin and optipng. Robots and a referee of
# live.png are played by this script on the published ports, so no studio may be listening.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
root=$PWD bin=$PWD/build/release/bin images=$PWD/docs/images
if [ -z "${PITCHBOARD_PICTURES:-}" ]; then
  PITCHBOARD_PICTURES=1 exec xvfb-run -a -s "-screen 0 1440x900x24" "$0" "$@"
fi
work=/tmp/pitchboard-pictures # its name can be seen in a picture
rm -rf "$work" && mkdir -p "$work"
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$work"' EXIT
cd "$work"
export HOME=$work QT_QPA_PLATFORM=xcb LC_ALL=C.UTF-8 XDG_RUNTIME_DIR=$work
chmod 700 "$work"

# studio ARGUMENT...: opens the window, without what an earlier picture has left in the settings.
studio() {
  rm -f settings.ini
  "$bin/pitchboard" --settings "$work/settings.ini" --size 1440x900 --theme "${theme:-dark}" "$@" &
  window=$!
  xdotool search --sync --onlyvisible --name Pitchboard >/dev/null
  sleep 2
  xdotool mousemove 0 0 search --onlyvisible --name Pitchboard windowfocus %@ 2>/dev/null || true
}
# find TEXT: types it into Ctrl+K and chooses the first entry.
find() {
  xdotool key ctrl+k && sleep 0.5
  # Without a window manager nobody gives the new window the focus.
  xdotool search --onlyvisible --class pitchboard | tail -1 | xargs xdotool windowfocus
  xdotool type --delay 20 "$1" && sleep 0.7
  xdotool key Return && sleep 0.7
  xdotool search --onlyvisible --class pitchboard | head -1 | xargs xdotool windowfocus
}
# drag X FROM TO: the edge above the plots, for example.
drag() {
  xdotool mousemove "$1" "$2" sleep 0.3 mousedown 1 sleep 0.3 mousemove "$1" $((($2 + $3) / 2)) sleep 0.3 \
    mousemove "$1" "$3" sleep 0.3 mouseup 1 sleep 0.7
}
# click X Y
click() { xdotool mousemove "$1" "$2" click 1 && sleep 0.7; }
# shoot NAME: takes the picture and closes the window.
shoot() {
  sleep "${2:-1}"
  import -window root "$1.png"
  kill "$window" && wait "$window" 2>/dev/null || true
}
# page PAGE FILE: writes the block of a documentation page that has this file name.
page() {
  sed -n "/^\`\`\`[a-z]* ${2//\//\\/}\$/,/^\`\`\`\$/{/^\`\`\`/d;p}" "$root/docs/$1" >"$(basename "$2")"
}
# chart FILE.html N NAME: the N-th chart of a report, as a picture.
chart() {
  python3 - "$1" "$2" >chart.svg <<'END'
import re, sys
page = open(sys.argv[1]).read()
style = "".join(re.findall(r"<style>(.*?)</style>", page, re.S))
colours = dict(re.findall(r"--(\w+): ([^;]+);", style.split("@media")[0]), c="#2f6fc6")  # those of the light theme
style = re.sub(r"var\(--(\w+)\)", lambda name: colours[name[1]], "\n".join(re.findall(r"^\.(?:axis|grid|curve|area|bar).*$", style, re.M)))
svg = re.findall(r"<svg.*?</svg>", page, re.S)[int(sys.argv[2])]
if "xmlns" not in svg.split(">")[0]:
    svg = svg.replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1)
svg = re.sub(r"var\(--(\w+)\)", lambda name: colours[name[1]], svg)
print(svg.replace(">", "><style>svg { font-family: sans-serif } %s</style>" % style, 1))
END
  rsvg-convert --background-color white --width 880 chart.svg -o "$3.png"
}
# terminal NAME COMMAND: what a command prints, as in a terminal; at most 30 lines.
terminal() {
  { echo "\$ ${*:2}" | sed "s,$root/,,; s, | sed .*,,"; bash -c "PATH=$bin:\$PATH; ${*:2}" 2>&1 | head -30; } >terminal.txt
  python3 - terminal.txt >terminal.svg <<'END'
import html, sys
lines = open(sys.argv[1]).read().splitlines()
width, height = 32 + round(8.43 * max(map(len, lines))), 24 + 18 * len(lines)
print('<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d"><rect width="100%%" height="100%%" fill="#232629"/>' % (width, height))
for i, line in enumerate(lines):
    print('<text xml:space="preserve" x="16" y="%d" font-family="DejaVu Sans Mono" font-size="14" fill="#eff0f1">%s</text>' % (28 + 18 * i, html.escape(line)))
print("</svg>")
END
  rsvg-convert terminal.svg -o "$1.png"
}
recording() {
  [ -f match.mcap ] || "$bin/pitchboard-cli" record --scenario match-3v3 --seed 7 --duration 2:00 -o match.mcap >/dev/null
}

# The ball is dragged to a robot; the others follow it, and a curve shows how far away it is.
first-minute() {
  rm -f settings.ini
  "$bin/pitchboard" --settings "$work/settings.ini" --size 1280x800 --theme light --scenario kick-off &
  window=$!
  xdotool search --sync --onlyvisible --name Pitchboard mousemove 596 450 >/dev/null
  sleep 3
  ffmpeg -loglevel error -y -f x11grab -framerate 10 -video_size 1280x800 -i "$DISPLAY" -t 10 -c:v libx264 -qp 0 \
    -preset ultrafast first-minute.mkv &
  local film=$! step
  sleep 1.5
  xdotool mousemove 596 350 sleep 0.2 mousemove 596 281 sleep 0.5 mousedown 1
  for step in {1..14}; do xdotool mousemove $((596 + step * 9)) $((281 + step * 8)) sleep 0.08; done
  xdotool sleep 0.3 mouseup 1 sleep 0.4 mousemove 560 520
  wait "$film"
  kill "$window" && wait "$window" 2>/dev/null || true
  ffmpeg -loglevel error -y -i first-minute.mkv -vf scale=960:-1:flags=lanczos -c:v libwebp_anim -loop 0 -quality 55 \
    -compression_level 6 first-minute.webp
}
studio-dark() { studio --scenario match-3v3 --play-to 3600; shoot studio-dark; }
studio-light() { theme=light studio --scenario kick-off; shoot studio-light 12; }
scenario() {
  sed -n '/^```json two-against-one.json$/,/^```$/{/^```/d;p}' "$root/docs/scenarios.md" >two.json
  "$bin/pitchboard" --render-scenario two.json --picture scenario.png --size 800x600
}
referee() {
  studio --scenario match --play-to 5400
  sleep 5 # until it has played so far
  find "Panels: Referee"
  shoot referee
}
drawings() {
  sed -n '/^```python draw_robot.py$/,/^```$/{/^```/d;p}' "$root/docs/drawings.md" >draw_robot.py
  studio --scenario match-3v3 --match 0 --play-to 1800
  python3 draw_robot.py 1 127.0.0.1:1240 &
  shoot drawings 4
  kill $!
  convert drawings.png -crop 716x492+301+104 +repage drawings.png
}
blackboard() {
  studio --scenario match-3v3 --play-to 3600
  xdotool mousemove 1150 102 click 1 && sleep 0.5
  xdotool type --delay 20 "b1/decision" && sleep 1
  shoot blackboard
  convert blackboard.png -crop 418x300+1022+62 +repage blackboard.png
}
advisor() {
  terminal advisor "pitchboard-cli record --scenario match-3v3 --seed 2 --advisor blue --duration 2:00 -o learned.mcap;" \
    "pitchboard-cli export learned.mcap --to csv-even --rate 0.1 --robots B2 --variables 'ADVISOR_A*'"
}
behaviours() {
  studio --scenario match-3v3 --play-to 900
  find "Localization particles"
  find "Planned path"
  shoot behaviours
  convert behaviours.png -crop 716x492+301+104 +repage behaviours.png
}
agent() {
  # The robots of a match stand in for real ones; the agent reads their blackboards.
  "$bin/pitchboard-cli" simulate --scenario match-3v3 --cognition separate --match 0 --speed 1 --duration 60 >/dev/null 2>&1 &
  robots=$!
  sleep 2
  for robot in 1 2 3; do
    "$bin/pitchboard-agent" --robot "$robot" --to 127.0.0.1 2>/dev/null &
    robots+=" $!"
  done
  echo '{"name": "Our team", "number": 12, "colour": "blue"}' >ours.json
  studio --live --robots 3 --team ours.json --our-team 12
  shoot agent 15
  # shellcheck disable=SC2086
  kill $robots && wait $robots 2>/dev/null || true # they would be seen in live.png, too
}
other-robots() {
  "$bin/pitchboard-cli" import "$root/tests/data/recordings/robot_walks.mcap" -o walk.mcap --force 2>/dev/null
  "$bin/pitchboard-cli" export walk.mcap --to png --from 10 -o other-robots.png --force
}
map-topics() {
  cp "$root/tests/data/recordings/robot_walks.mcap" walk.mcap
  cat >walk.mapping.json <<'END'
{"mapping": 1, "robots": [{"number": 3, "pose": {"topic": "/robot3/amcl_pose", "x": "pose.pose.position.x",
  "y": "pose.pose.position.y", "orientation": "pose.pose.orientation", "covariance": "pose.covariance"},
  "ball": {"topic": "/robot3/ball", "x": "x_mm", "y": "y_mm", "unit": "mm", "seen": "seen"}}]}
END
  theme=light studio walk.mcap
  find "Map topics of recordings"
  dialog=$(xdotool search --sync --onlyvisible --name "Map topics" | tail -1)
  xdotool windowfocus "$dialog" && sleep 2
  import -window "$dialog" map-topics.png
  kill "$window" && wait "$window" 2>/dev/null || true
}
align-recordings() {
  page other-robots.md team.json
  page other-robots.md log.yaml
  mv team.json log.mapping.json
  cp "$root/tests/data/recordings/robot_walks.mcap" robot3.mcap
  theme=light studio
  find "Map topics of recordings"
  files=$(xdotool search --sync --onlyvisible --name "Map topics of recordings" | tail -1)
  xdotool windowfocus "$files" && sleep 1
  xdotool type --delay 20 '"log.yaml" "robot3.mcap"' && xdotool key alt+o
  dialog=$(xdotool search --sync --onlyvisible --name "Map topics of 2" | tail -1)
  xdotool windowfocus "$dialog" && sleep 2
  xdotool key alt+l Down && sleep 3
  import -window "$dialog" align-recordings.png
  kill "$window" && wait "$window" 2>/dev/null || true
}
rollouts() {
  PYTHONPATH=$root/robotlink/laboratory/capi/python /usr/bin/python3 - >heat.mvg <<'END'
# Where the ball is after 5 s: shares of rollouts in cells of 0.25 m, on a field of 9 m by 6 m, 80 pixels a metre.
import collections
from pitchboard import Rollouts

with_ball = {"ball_x": 1.6, "ball_y": 0.6, "ball_sigma": 0.1, "state": 3}
rollouts = Rollouts("match-3v3")
belief = rollouts.beginning()
belief.game.update(with_ball)
belief.robots[0].update(x=1.3, y=0.5, yaw=0.3, sigma=0.1)
belief.robots[3].update(x=2.4, y=0.3, yaw=3.1, sigma=0.15)
outcomes = rollouts.play(belief, count=3000, seconds=10)
cells = collections.Counter((int((x + 5.5) * 4), int((y + 4) * 4))
                            for x, y in zip(outcomes["look_x"], outcomes["look_y"]))
px = lambda x: 440 + 80 * x
py = lambda y: 320 - 80 * y
print("stroke none")
most = max(cells.values())
for (i, j), n in sorted(cells.items()):
    x, y = i / 4 - 5.5, j / 4 - 4
    print("fill rgba(240,163,94,%.2f) rectangle %g,%g %g,%g" % (min(1, 0.1 + 0.9 * (n / most) ** 0.5), px(x), py(y + 0.25), px(x + 0.25) - 1, py(y) - 1))
print("fill none stroke #c3cec6 stroke-width 4")
print("rectangle %g,%g %g,%g line %g,%g %g,%g circle %g,%g %g,%g" % (px(-4.5), py(3), px(4.5), py(-3), px(0), py(3), px(0), py(-3), px(0), py(0), px(0.75), py(0)))
for side in (-1, 1):
    print("rectangle %g,%g %g,%g rectangle %g,%g %g,%g" % (min(px(side * 4.5), px(side * 3.9)), py(1.725), max(px(side * 4.5), px(side * 3.9)), py(-1.725), min(px(side * 4.5), px(side * 5.1)), py(0.9), max(px(side * 4.5), px(side * 5.1)), py(-0.9)))
print("stroke white stroke-width 2")
for number, robot in enumerate(belief.robots):
    print("fill %s circle %g,%g %g,%g" % ("#4f8fe3" if number < 3 else "#d8605b", px(robot["x"]), py(robot["y"]), px(robot["x"]) + 13, py(robot["y"])))
print("fill #f0a35e circle %g,%g %g,%g" % (px(1.6), py(0.6), px(1.6) + 7, py(0.6)))
END
  convert -size 880x640 xc:'#33453a' -draw "$(cat heat.mvg)" rollouts.png
}
processes() {
  sed -n '/^```python chase.py$/,/^```$/{/^```/d;p}' "$root/docs/tutorial-python-robot.md" >chase.py
  chmod +x chase.py
  studio --scenario match-3v3 --runtime "B1=program=$work/chase.py"
  find "Panels: Processes"
  shoot processes 8
}
live() {
  echo '{"name": "Our team", "number": 12, "colour": "blue"}' >ours.json
  studio --live --team ours.json --our-team 12
  # Three robots and the referee, as tests/data has recorded it.
  python3 - "$root/tests/data/gamecontroller/v12hl640_2017.3_PLAYING.bin" <<'END' &
import math, socket, sys, time
udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
packet = open(sys.argv[1], "rb").read()
for i in range(60):
    for n, x, y, lamp, action, volts in ((1, 80, 300, 1, 0, 161), (2, 520 + 4 * i, 250, 1, 8, 148), (4, 420, 420 - 2 * i, 0, 3, 112)):
        distance, bearing = math.hypot(700 - x, 330 - y), -math.degrees(math.atan2(330 - y, 700 - x))
        fields = [n, x, y, 0, 9 + n, round(distance, 1), round(bearing, 1), 1, 1, 1, lamp, 1, action, 0.0, volts]
        udp.sendto((" ".join(map(str, fields)) + " OUT").encode(), ("127.0.0.1", 1240 + n))
    udp.sendto(packet, ("127.0.0.1", 3838))
    time.sleep(0.25)
END
  shoot live 12
}
plots() {
  studio --scenario match-3v3 --play-to 3600
  find "B1/TRUE_X"
  find "B1/BELIEF_X"
  drag 720 602 420
  shoot plots
}
replay() {
  recording
  studio --session match.mcap
  click 900 855 # a moment in the timeline
  shoot replay
}
experiments() {
  studio --scenario one-robot --paused
  find "Panels: Experiments"
  drag 720 521 330 # the panel has made room for itself
  click 1311 374 # Start: 4000 short runs
  sleep "${PITCHBOARD_EXPERIMENT_SECONDS:-60}"
  click 98 420   # Measured
  shoot experiments
}

video() {
  recording
  "$bin/pitchboard" --paint match.mcap --picture field.mp4 --from 2 --until 60 --rate 30 --size 1280x900 >/dev/null
  local way='x0=W*0.28:y0=H*0.12:x1=W*0.9:y1=H*0.2:x2=W*0.03:y2=H*0.72:x3=W*0.97:y3=H*0.95'
  ffmpeg -loglevel error -y -i field.mp4 -vf "perspective=$way:sense=destination,scale=1280:720" -c:v libx264 -g 30 north.mp4
  way='x0=W*0.05:y0=H*0.25:x1=W*0.7:y1=H*0.1:x2=W*0.1:y2=H*0.95:x3=W*0.98:y3=H*0.7'
  ffmpeg -loglevel error -y -i field.mp4 -vf "perspective=$way:sense=destination,scale=1280:720" -c:v libx264 -g 30 goal.mp4
  cat >match.mcap.notes.json <<'END'
{"version": 1, "bookmarks": [], "videos": [
  {"file": "north.mp4", "moments": [{"session": 2, "video": 0}], "points": [
    {"field_x": -4.5, "field_y": 3, "x": 0.306, "y": 0.167}, {"field_x": 4.5, "field_y": 3, "x": 0.858, "y": 0.245},
    {"field_x": 4.5, "field_y": -3, "x": 0.889, "y": 0.824}, {"field_x": -4.5, "field_y": -3, "x": 0.121, "y": 0.648}]},
  {"file": "goal.mp4", "moments": [{"session": 2, "video": 0}]}]}
END
  studio --session match.mcap
  find "Panels: Video"
  drag 720 470 400
  click 560 855
  shoot video 3
  rm match.mcap.notes.json
}
explore() {
  studio --scenario match-3v3 --seed 2 --cognition inline --play-to 6000 # red is about to score
  find "Explore from this moment"
  shoot explore 20
}
calibrate() {
  "$bin/pitchboard-cli" record --scenario calibration-drill --duration 1:30 -o drill.mcap >/dev/null
  terminal calibrate "pitchboard-cli calibrate drill.mcap --robot B1 -o b1.json --force"
}
learning() {
  "$bin/pitchboard-cli" record --scenario calibration-drill --duration 1:30 -o learn.mcap >/dev/null
  "$bin/pitchboard-cli" calibrate learn.mcap --robot B1 -o b1.json --force >/dev/null
  page learning.md our-team.json
  sed -i 's/"generations": 2/"generations": 6/' our-team.json
  "$bin/pitchboard-cli" learn our-team.json --out learned >/dev/null
  chart learned/report.html 0 learning
}
tutorial-compare() {
  page tutorial-compare.md compare.json
  "$bin/pitchboard-cli" experiment compare.json --out compared >/dev/null
  chart compared/report.html 0 tutorial-compare
}
tutorial-failing-test() {
  page tutorial-failing-test.md tests/keeper.json
  python3 -c 'import json; json.dump(json.load(open("keeper.json"))["scenario"], open("shot.json", "w"))'
  "$bin/pitchboard" --render-scenario shot.json --picture tutorial-failing-test.png --size 800x600
}
tutorial-review() {
  "$bin/pitchboard-cli" record --scenario match-3v3 --seed 7 --duration 40 -o 7.mcap >/dev/null
  "$bin/pitchboard" --paint 7.mcap --picture review.mp4 --from 20 --until 35 --rate 30 --size 1280x900 >/dev/null
  local way='x0=W*0.28:y0=H*0.12:x1=W*0.9:y1=H*0.2:x2=W*0.03:y2=H*0.72:x3=W*0.97:y3=H*0.95'
  ffmpeg -loglevel error -y -i review.mp4 -vf "perspective=$way:sense=destination,scale=1280:720" -c:v libx264 -g 30 camera.mp4
  cat >7.mcap.notes.json <<'END'
{"version": 1, "bookmarks": [], "videos": [{"file": "camera.mp4", "moments": [{"session": 20, "video": 0}]}], "drawn": [
  {"time": 25.9, "shape": "arrow", "place": "field", "from": [-0.5, 0.6], "to": [0.38, -0.18], "text": "did not turn round"},
  {"time": 25.9, "shape": "circle", "place": "video", "on": "camera.mp4", "from": [0.56, 0.47], "to": [0.64, 0.47]},
  {"time": 27.5, "shape": "arrow", "place": "plot", "on": "R3/TRUE_BALL_DIST", "unit": "cm", "from": [29.5, 110], "to": [27.5, 78], "text": "lost, and 70 cm away"}]}
END
  studio --session 7.mcap
  find "R3/VISION_LOST"
  find "R3/TRUE_BALL_DIST"
  find "Panels: Video"
  drag 720 470 400
  click 955 855 # 0:27
  shoot tutorial-review 3
}
tutorial-lost-ball() {
  recording
  studio --session match.mcap
  find "B1/VISION_BALL_DIST"
  find "B1/VISION_LOST"
  drag 720 602 420
  click 900 855 # B1 has lost the ball
  shoot tutorial-lost-ball
}
tutorial-rerun() {
  page tutorial-rerun.md ball_robot.py
  page tutorial-rerun.md team.json
  "$bin/pitchboard-cli" record --scenario one-robot --noise realistic --seed 7 --runtime B1=team.json --speed max --duration 1:00 -o match.mcap --force >/dev/null
  sed 's/return 3  *# turn right.*/return 2 if floats[PAN_DEG] > 0 else 3/' ball_robot.py >fixed_robot.py
  terminal tutorial-rerun "pitchboard-cli rerun match.mcap --robot B1 --process decision=fixed_robot.py"
}
rules() {
  recording
  page rules.md rules.json
  studio --session match.mcap --at 1:12
  find "Check rules"
  xdotool search --sync --onlyvisible --name "Open rules" windowfocus
  xdotool type --delay 20 "$work/rules.json" && sleep 0.5
  xdotool key Return
  shoot rules 3
}
statistics() {
  "$bin/pitchboard-cli" record --scenario match-3v3 --duration 40 -o match.mcap --force
  terminal statistics "pitchboard-cli statistics match.mcap --variables TRUE_X --robots B1,B2,R1 --against BELIEF_X --histogram 5"
}

library() {
  local seed
  mkdir -p Documents/Pitchboard
  for seed in 4 5 7 8 9 12; do
    "$bin/pitchboard-cli" record --scenario match-3v3 --seed $seed --duration 1:$((40 + seed)) -o "Documents/Pitchboard/training $seed.mcap" --force >/dev/null
  done
  echo '{"version": 1, "bookmarks": [{"time": 31, "note": "B2 lost its place after the fall"}]}' >"Documents/Pitchboard/training 7.mcap.notes.json"
  head -c 300000 "Documents/Pitchboard/training 9.mcap" >"Documents/Pitchboard/cut off.mcap"
  studio --scenario match-3v3 --paused
  find "File: Library"
  shoot library 5
}
plays() {
  "$bin/pitchboard-cli" record --scenario match-3v3 --duration 300 --seed 4 -o match.mcap --force
  studio --session match.mcap
  find "Play by play"
  drag 700 620 480
  shoot plays 3
}

tutorial-rerun-studio() {
  tutorial-rerun # its recording and its programs
  studio --session match.mcap
  find "Rerun with"
  xdotool search --onlyvisible --name "Rerun with a program" windowfocus
  xdotool key alt+p ctrl+a && xdotool type --delay 20 "$work/fixed_robot.py" && sleep 1 && xdotool key Return
  shoot tutorial-rerun-studio 12
}
tutorial-rerun-follow() {
  page tutorial-rerun.md duel.json
  "$bin/pitchboard-cli" record --scenario duel.json --seed 9 --duration 0:30 -o duel.mcap --force >/dev/null
  studio --session duel.mcap --at 4
  find "others follow"
  xdotool search --onlyvisible --name "others follow" windowfocus
  shoot tutorial-rerun-follow 2
}
tutorial-rerun-join() {
  rm -f live.mcap robot1.mcap
  "$bin/pitchboard-cli" record --live -o live.mcap &
  local live=$!
  "$bin/pitchboard-agent" --robot 1 --key 731100 --to 127.0.0.1 --record robot1.mcap &
  local agent=$!
  "$bin/pitchboard-cli" simulate --scenario match-3v3 --cognition separate --key-base 731000 --speed 1 --duration 60 >/dev/null
  kill $agent $live && wait $agent $live || true
  studio --session live.mcap
  find "Add recording of a robot"
  xdotool search --sync --onlyvisible --name "Add recording" windowfocus
  xdotool type --delay 20 "$work/robot1.mcap" && sleep 0.5 && xdotool key Return
  shoot tutorial-rerun-join 5
}
cli() { terminal cli "pitchboard-cli simulate --scenario match-3v3 --duration 60"; }
building() { terminal building "$root/build/release/tests/tests_simcore tst_referee_parameters"; }
performance() {
  ninja -C "$root/build/release" bench_match >/dev/null
  terminal performance "$root/build/release/benchmarks/bench_match 2>/dev/null"
}
continuous-integration() {
  mkdir -p robot situations ci
  for file in CMakeLists.txt robot/chase.cpp situations/walks-to-the-ball.json ci/situations.sh; do
    page continuous-integration.md $file
    [ ! -d "${file%/*}" ] || mv "${file##*/}" "$file"
  done
  terminal continuous-integration "sh ci/situations.sh"
}
conformance() { terminal conformance "pitchboard-cli conformance $root/tests/data/traces/i_action_08_B?.json | sed 's,.*/,,'"; }
file-formats() {
  recording
  terminal file-formats "pitchboard-cli inspect match.mcap"
}
worlds() {
  python3 - "$bin/pitchboard-cli" >worlds.svg <<'END'
# The ball in 64 worlds of match-3v3 that differ in their seeds, for 60 s, on a field of 9 m by 6 m, 80 pixels a metre.
import json, subprocess, sys

count = 64
worlds = subprocess.Popen([sys.argv[1], "simulate", "--stdio"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def ask(**request):
    worlds.stdin.write(json.dumps(request) + "\n")
    worlds.stdin.flush()
    return json.loads(worlds.stdout.readline())


ask(do="create", scenario="match-3v3", worlds=count, noise="realistic")
columns = [column[0] if isinstance(column, list) else column for column in ask(do="columns")["game"]]
names = [column["name"] if isinstance(column, dict) else column for column in columns]
ball = names.index("ball_x"), names.index("ball_y")
px = lambda x: 440 + 80 * x
py = lambda y: 320 - 80 * y
paths = [[] for _ in range(count)]
for _ in range(240):
    ask(do="step", ticks=15)
    for path, row in zip(paths, ask(do="read", what="game")["values"]):
        path.append("%g,%g" % (px(row[ball[0]]), py(row[ball[1]])))
worlds.stdin.close()
print('<svg xmlns="http://www.w3.org/2000/svg" width="880" height="640"><rect width="880" height="640" fill="#33453a"/>')
print('<g fill="none" stroke="#c3cec6" stroke-width="4"><rect x="80" y="80" width="720" height="480"/>')
print('<path d="M440 80v480"/><circle cx="440" cy="320" r="60"/></g>')
print('<g fill="none" stroke="#f0a35e" stroke-opacity="0.6" stroke-width="2">')
for path in paths:
    print('<polyline points="%s"/>' % " ".join(path))
print("</g></svg>")
END
  rsvg-convert worlds.svg -o worlds.png
}

[ $# -gt 0 ] || set -- first-minute studio-dark studio-light scenario referee drawings blackboard advisor behaviours agent other-robots map-topics align-recordings rollouts processes live plots replay experiments \
  explore calibrate learning tutorial-compare tutorial-failing-test tutorial-review tutorial-lost-ball tutorial-rerun tutorial-rerun-studio tutorial-rerun-follow tutorial-rerun-join building cli conformance continuous-integration file-formats library performance plays rules statistics video worlds
for name in "$@"; do
  "$name"
  if [ -f "$name.webp" ]; then
    mv "$name.webp" "$images/$name.webp"
    echo "docs/images/$name.webp"
    continue
  fi
  convert "$name.png" -colors 200 "png8:$name.8.png"
  optipng -quiet -o2 -strip all "$name.8.png"
  mv "$name.8.png" "$images/$name.png"
  echo "docs/images/$name.png"
done
