#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""import_speed.py BENCH_IMPORT NODE_FOLDER [MEGABYTES [TIMES]]: how many times as fast a ROS 2 recording is imported as
the official packages decode its messages (decode_recording.mjs), one after the other in one run, and how much memory the
import takes. NODE_FOLDER has the packages of tests/recordings/package.json."""
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).parent.parent / "recordings" / "decode_recording.mjs"


def seconds(output: str) -> float:
    return float(re.search(r"([0-9.]+) s, ", output).group(1))


def main() -> int:
    bench, node = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    megabytes = sys.argv[3] if len(sys.argv) > 3 else "1000"
    times = int(sys.argv[4]) if len(sys.argv) > 4 else 5
    imports, decodes, memory = [], [], 0
    script = node / "decode_speed.mjs"
    shutil.copyfile(SCRIPT, script)  # the packages are found beside the script
    with tempfile.TemporaryDirectory() as folder:
        file = str(pathlib.Path(folder) / "recording.mcap")
        subprocess.run([bench, "make", file, megabytes], check=True)
        for _ in range(times):
            ours = subprocess.run([bench, "run", file], check=True, capture_output=True, text=True).stdout
            theirs = subprocess.run(["node", script, file], check=True, capture_output=True, text=True).stdout
            imports.append(seconds(ours))
            decodes.append(seconds(theirs))
            memory = max(memory, int(re.search(r"peak memory (\d+) MB", ours).group(1)))
    script.unlink()
    ours, theirs = statistics.median(imports), statistics.median(decodes)
    print(f"import {ours:.3f} s, official packages {theirs:.3f} s: {theirs / ours:.1f} times as fast, "
          f"peak memory {memory} MB (medians of {times})")
    return 0


if __name__ == "__main__":
    sys.exit(main())
