#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a robot's program waits when it prints much: `record` with a program that prints lines all the time.

    program_output.py PITCHBOARD_CLI FILE.mcap [LINES_A_SECOND] [SECONDS]

Prints how many lines the program wrote, its longest wait for one write of a millisecond's lines, and how many
lines are in the recording or were counted as left out. The file must not exist."""
import json
import os
import re
import subprocess
import sys
import tempfile

PROGRAM = """#!/usr/bin/env python3
import os, time
lines = ({each} * ("decision: the ball is 83.2 cm away, 12 degrees left" + chr(10))).encode()
begin, longest, count = time.monotonic(), 0.0, 0
while True:
    before, data = time.monotonic(), lines
    while data:
        data = data[os.write(1, data):]
    longest = max(longest, time.monotonic() - before)
    count += {each}
    if count % {rate} < {each}:
        with open("{result}.new", "w") as out:
            out.write(f"{{count}} {{longest}}")
        os.rename("{result}.new", "{result}")
    time.sleep(max(0.0, begin + count / {rate} - time.monotonic()))
"""


def main():
    program, path = sys.argv[1], sys.argv[2]
    rate = int(sys.argv[3]) if len(sys.argv) > 3 else 100_000
    seconds = int(sys.argv[4]) if len(sys.argv) > 4 else 10
    with tempfile.TemporaryDirectory() as folder:
        result, script = os.path.join(folder, "result"), os.path.join(folder, "prints.py")
        with open(script, "w", encoding="utf-8") as out:
            out.write(PROGRAM.format(each=max(1, rate // 1000), rate=rate, result=result))
        os.chmod(script, 0o755)
        subprocess.run([program, "record", "--scenario", "one-robot", "--duration", str(seconds), "--speed", "1",
                        "--runtime", "B1=program=" + script, "-o", path], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        with open(result, encoding="utf-8") as numbers:
            count, longest = numbers.read().split()
    lines = subprocess.run([program, "export", path, "--to", "jsonl"], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    logged = [json.loads(line)["message"]["message"] for line in lines if '"stream":"log"' in line]
    left_out = sum(int(found[1]) for text in logged if (found := re.match(r"(\d+) lines? (was|were) ", text)))
    kept = sum(text.startswith("decision:") for text in logged)
    print(f"{count} lines printed, longest wait {1000 * float(longest):.1f} ms; {kept} recorded, {left_out} left out")


if __name__ == "__main__":
    main()
