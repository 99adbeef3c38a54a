#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Peak memory and file size of `record --live` while robots send ever new names or texts.

    live_growth.py names|texts ROBOTS PITCHBOARD_CLI FILE.mcap

names: agents (PB2) whose 1000 variables appear one by one, 20 messages a second.
texts: messages in JSON with 128 texts that differ in every message, 64 times.
Prints one line. The file must not exist."""
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

PORTS, VARIABLES = 21240, 22240


def peak(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        for line in status:
            if line.startswith("VmHWM"):
                return int(line.split()[1]) / 1024
    return 0.0


def names(send, robots):
    begin = time.monotonic()
    for i in range(1000):
        values = " ".join(f"N{j:04d}={j}" for j in range(max(0, i - 20), i + 1))
        now = int(1000 * time.monotonic())
        for robot in range(1, robots + 1):
            send(f"PB2 {robot} {i + 1} {now} {values} OUT", VARIABLES + robot)
        time.sleep(max(0.0, begin + 0.05 * (i + 1) - time.monotonic()))


def texts(send, robots):
    begin = time.monotonic()
    for i in range(80):
        for robot in range(1, robots + 1):
            fields = {f"k{j}": f"text {robot} {j} {i}" for j in range(128)}
            send(json.dumps({"robot": robot, **fields}), PORTS + robot)
        time.sleep(max(0.0, begin + 0.1 * (i + 1) - time.monotonic()))


def main():
    kind, robots, program, path = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4]
    fields = [{"name": "NUMBER", "key": "robot", "type": "int", "meaning": "robot"}]
    fields += [{"name": f"K{j}", "key": f"k{j}", "type": "text"} for j in range(98)]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as profile:
        json.dump({"name": "texts", "format": "json", "fields": fields}, profile)
        profile.flush()
        command = [program, "record", "--live", "-o", path, "--bind", "127.0.0.1", "--robots", "16",
                   "--port-base", str(PORTS), "--variables-port-base", str(VARIABLES)]
        command += ["--profile", profile.name] if kind == "texts" else []
        recorder = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        time.sleep(2)
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)

        def send(text, port):
            sender.sendto(text.encode(), ("127.0.0.1", port))

        (names if kind == "names" else texts)(send, robots)
        time.sleep(1.5)
        memory, begin = peak(recorder.pid), time.monotonic()
        recorder.send_signal(signal.SIGINT)
        recorder.wait(timeout=300)
        print(f"{kind}, {robots} robots: {memory:.0f} MiB at most, {os.path.getsize(path) / 1e6:.1f} MB, "
              f"ended in {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    main()
