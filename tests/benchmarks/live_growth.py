#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Peak memory, processor time and file size of `record --live` while robots send many names or texts.

    live_growth.py names|texts|agents-205|agents-1000 ROBOTS PITCHBOARD_CLI FILE.mcap

names: agents (PB2) whose 1000 variables appear one by one, 20 messages a second.
texts: messages in JSON with 128 texts that differ in every message, 80 times.
agents-N: agents (PB2) that send N variables that change all the time, 20 times a second.
Prints one line. Agents send for ten seconds: what takes 5 s of a core is half a core. The file must not exist."""
import json
import os
import resource
import signal
import socket
import subprocess
import sys
import tempfile
import time

PORTS, VARIABLES = 21240, 22240
SECONDS = 10
IN_A_DATAGRAM = 100  # which has at most 1400 bytes


def peak(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        for line in status:
            if line.startswith("VmHWM"):
                return int(line.split()[1]) / 1024
    return 0.0


def agents(send, robots, variables):
    begin = time.monotonic()
    sequence = 0
    for i in range(20 * SECONDS):
        now = int(1000 * time.monotonic())  # one time for all datagrams of a sample
        for first in range(0, variables, IN_A_DATAGRAM):
            last = min(first + IN_A_DATAGRAM, variables)
            values = " ".join(f"N{j:04d}={(i + 1) * j % 1000}" for j in range(first, last))
            sequence += 1
            for robot in range(1, robots + 1):
                send(f"PB2 {robot} {sequence} {now} {values} OUT", VARIABLES + robot)
        time.sleep(max(0.0, begin + 0.05 * (i + 1) - time.monotonic()))


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
        command = [program, "record", "--live", "-o", path, "--bind", "127.0.0.1", "--robots", "64",
                   "--port-base", str(PORTS), "--variables-port-base", str(VARIABLES)]
        command += ["--profile", profile.name] if kind == "texts" else []
        recorder = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        time.sleep(2)
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)

        def send(text, port):
            sender.sendto(text.encode(), ("127.0.0.1", port))

        if kind.startswith("agents-"):
            agents(send, robots, int(kind.removeprefix("agents-")))
        else:
            (names if kind == "names" else texts)(send, robots)
        time.sleep(1.5)
        memory, begin = peak(recorder.pid), time.monotonic()
        recorder.send_signal(signal.SIGINT)
        recorder.wait(timeout=300)
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        print(f"{kind}, {robots} robots: {memory:.0f} MiB at most, {used.ru_utime + used.ru_stime:.2f} s of a core, "
              f"{os.path.getsize(path) / 1e6:.1f} MB, "
              f"ended in {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    main()
