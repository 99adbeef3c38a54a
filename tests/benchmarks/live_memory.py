#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Peak memory of a program that listens while strangers send what they like: valid messages of
robots and fields that nobody has.

    live_memory.py [--messages N] [--robots N] [--rate N] --port-base P -- PROGRAM ARGUMENTS...

The program must listen at 127.0.0.1 on P + 1. It is ended by SIGINT. Prints one line."""
import argparse
import os
import random
import signal
import socket
import subprocess
import time


def memory(pid, key):
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        for line in status:
            if line.startswith(key):
                return int(line.split()[1]) / 1024
    return 0.0


def message(number, robots, rng):
    extras = " ".join(f"{rng.uniform(-1e6, 1e6):.3f}" for _ in range(number % 100))
    robot = 1 + number % robots
    values = " ".join(str(rng.randrange(1000)) for _ in range(3))
    return f"{robot} {values} 20.5 80.1 5.2 1 1 1 1 1 8 0.5 120 {extras} OUT".encode()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--messages", type=int, default=100_000)
    parser.add_argument("--rate", type=float, default=2000, help="messages a second")
    parser.add_argument("--robots", type=int, default=64000, help="different numbers")
    parser.add_argument("--port-base", type=int, required=True)
    parser.add_argument("--wait", type=float, default=3, help="seconds until the program listens")
    parser.add_argument("program", nargs="+")
    options = parser.parse_args()
    program = subprocess.Popen(options.program)
    time.sleep(options.wait)  # it says in ways of its own when it listens
    before = memory(program.pid, "VmRSS")
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    rng = random.Random(1)
    begin = time.monotonic()
    for number in range(options.messages):
        sender.sendto(message(number, options.robots, rng), ("127.0.0.1", options.port_base + 1))
        ahead = begin + number / options.rate - time.monotonic()
        if ahead > 0.005:
            time.sleep(ahead)
    time.sleep(2)
    peak = memory(program.pid, "VmHWM")
    print(f"{options.messages} messages: {before:.0f} MiB before, {peak:.0f} MiB at most")
    os.kill(program.pid, signal.SIGINT)
    program.wait(timeout=60)


if __name__ == "__main__":
    main()
