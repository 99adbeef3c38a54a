#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares `pitchboard-cli find` with an export of the same columns that awk filters.

find_speed.py PITCHBOARD_CLI [FOLDER]: FOLDER has sessions of match-3v3; without it, four of ten minutes are recorded.
Both search the same files for the same conditions in turn, three times each; prints the medians, their ratio, and
how many moments each of them found. The files are in the memory of the system: reading the disk costs both the same.
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

CLI = sys.argv[1]
# What is asked, and the condition in awk over a robot's three columns. A table has the old distance of a ball that is
# not seen, so both ask for VISION_LOST, too.
QUESTIONS = [
    ("nearly never", "BELIEF_ERROR > 500 && VISION_BALL_DIST < 100 && VISION_LOST == 0", "a > 500 && b < 100 && c == 0"),
    ("sometimes", "BELIEF_ERROR > 50 && VISION_BALL_DIST < 100 && VISION_LOST == 0", "a > 50 && b < 100 && c == 0"),
    ("often; no summary rules it out", "BELIEF_ERROR + 0 > 10 && VISION_BALL_DIST + 0 < 300 && VISION_LOST + 0 == 0",
     "a > 10 && b < 300 && c == 0"),
]
# Columns stand robot beside robot: first BELIEF_ERROR of all, then the others. An empty cell is unknown.
AWK = """NR == 1 { robots = (NF - 1) / 3; next }
{ for (i = 2; i <= 1 + robots; ++i) {
    a = $i; b = $(i + robots); c = $(i + 2 * robots); holds = a != "" && b != "" && (%s)
    if (holds && !held[i]) ++count; held[i] = holds } }
END { print count + 0 }"""


def seconds(run):
    begin = time.perf_counter()
    result = run()
    return time.perf_counter() - begin, result


def exported(files, condition):
    count = 0
    for file in files:
        with subprocess.Popen([CLI, "export", file, "--to", "csv-wide", "--variables", "BELIEF_ERROR,VISION_BALL_DIST,VISION_LOST"],
                              stdout=subprocess.PIPE) as export:
            awk = subprocess.run(["awk", "-F,", AWK % condition], stdin=export.stdout, check=True, capture_output=True)
        count += int(awk.stdout)
    return count


def found(files, condition):
    return subprocess.run([CLI, "find", *files, condition], capture_output=True).stdout.count(b"\n")


with tempfile.TemporaryDirectory() as temporary:
    folder = sys.argv[2] if len(sys.argv) > 2 else temporary
    if folder == temporary:
        for number in range(4):
            subprocess.run([CLI, "record", "--scenario", "match-3v3", "--seed", str(number), "--duration", "10:00",
                            "-o", f"{folder}/{number}.mcap"], check=True, capture_output=True)
    names = sorted(str(path) for path in pathlib.Path(folder).glob("*.mcap"))
    size = sum(pathlib.Path(name).stat().st_size for name in names)
    print(f"{len(names)} sessions, {size / 1e6:.0f} MB")
    for title, condition, filtered in QUESTIONS:
        times = [[], []]
        for _ in range(3):
            slow, of_awk = seconds(lambda: exported(names, filtered))
            quick, of_find = seconds(lambda: found(names, condition))
            times[0].append(slow)
            times[1].append(quick)
        slow, quick = map(statistics.median, times)
        print(f"{title}: export and awk {slow:.2f} s ({of_awk} moments), find {quick:.2f} s ({of_find}): "
              f"{slow / quick:.1f} times as fast")
