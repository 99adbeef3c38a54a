#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pitchboard-agent costs: scripts/agent_cost.py [PROGRAM]

Starts the agent on a blackboard of its own, lets variables change, and prints two tables: what recording costs, and what
sending costs, with bandwidth including IP and UDP headers. PROGRAM: build/release/bin/pitchboard-agent unless given.
"""
import ctypes
import os
import random
import socket
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORDS, FLOAT_OFFSET = 512, 125
HEADERS = 28  # bytes of IP and UDP


class Segment:
    """A blackboard that nobody else uses."""

    def __init__(self, key):
        self.libc = ctypes.CDLL(None, use_errno=True)
        self.libc.shmat.restype = ctypes.c_void_p
        self.libc.shmat.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_int]
        self.key = key
        self.shmid = self.libc.shmget(key, 4 * WORDS, 0o3600)  # IPC_CREAT | IPC_EXCL | 0600
        if self.shmid < 0:
            raise OSError(ctypes.get_errno(), "cannot create blackboard %d" % key)
        self.words = (ctypes.c_uint32 * WORDS).from_address(self.libc.shmat(self.shmid, None, 0))

    def wake(self, word):
        futex, wake = {"x86_64": 202, "aarch64": 98}[os.uname().machine], 1
        self.libc.syscall(futex, ctypes.c_void_p(ctypes.addressof(self.words) + 4 * word), wake, 2**31 - 1, None, None, 0)

    def remove(self):
        self.libc.shmctl(self.shmid, 0, None)


def listener():
    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    out.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
    out.bind(("127.0.0.1", 0))
    return out


def own_key():
    return 100 * (10_000_000 + os.getpid())


def cpu_seconds(process):
    fields = Path("/proc/%d/stat" % process).read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measure(program, names, rate, changing, seconds=6.0, limit=None):
    segment, ears = Segment(own_key()), listener()
    agent = None
    try:
        command = [str(program), "--robot", "1", "--key", str(segment.key), "--rate", str(rate),
                   "--to", "127.0.0.1:%d" % ears.getsockname()[1]] + names
        agent = subprocess.Popen(command + (["--limit", str(limit)] if limit else []), stderr=subprocess.DEVNULL)
        total = datagrams = 0
        begin, cpu = time.monotonic() + 2.0, None
        step = 1.0 / rate
        while True:
            now = time.monotonic()
            if cpu is None and now >= begin:
                cpu, total, datagrams = cpu_seconds(agent.pid), 0, 0
            if now >= begin + seconds:
                break
            for word in range(WORDS):
                if random.random() < changing:
                    number = random.uniform(-300, 300)
                    segment.words[word] = (int(number) & 0xffffffff if word < FLOAT_OFFSET else
                                           struct.unpack("I", struct.pack("f", number))[0])
            ears.settimeout(step)
            until = now + step
            while time.monotonic() < until:
                ears.settimeout(max(until - time.monotonic(), 1e-4))
                try:
                    total += len(ears.recv(2000)) + HEADERS
                    datagrams += 1
                except socket.timeout:
                    break
        cpu = cpu_seconds(agent.pid) - cpu
        status = Path("/proc/%d/status" % agent.pid).read_text()
        memory = int(status.split("VmHWM:")[1].split()[0])
        return total * 8 / 1000 / seconds, datagrams / seconds, 100 * cpu / seconds, memory
    finally:
        if agent:
            agent.kill()
            agent.wait()
        segment.remove()


def boards(changing, count=400):
    """Contents of a blackboard one after the other, in which a share of the words changes each time."""
    numbers, words = random.Random(44), [0] * WORDS
    for _ in range(count):
        for word in range(WORDS):
            if numbers.random() < changing:
                number = numbers.uniform(-300, 300)
                words[word] = (int(number) & 0xffffffff if word < FLOAT_OFFSET else
                               struct.unpack("I", struct.pack("f", number))[0])
        yield (ctypes.c_uint32 * WORDS)(*words)


def measure_record(program, rate, changing, announces=False, seconds=60.0):
    """CPU in % of a core, memory in KB, and MB an hour of a recording without sending. `announces`: a program announces
    the beginning and the end of its cycles, 50 a second at 100 Hz."""
    cycle = 460
    segment, contents = Segment(own_key()), list(boards(changing))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "flight.mcap"
        agent = subprocess.Popen([str(program), "--robot", "1", "--key", str(segment.key), "--to", "none", "--record",
                                  str(path), "--record-rate", str(rate)] +
                                 (["--record-cycles", "decision=%d" % cycle] if announces else []),
                                 stderr=subprocess.DEVNULL)
        try:
            # The first seconds have the descriptions of all variables.
            begin, cpu, tick, due = time.monotonic() + 5.0, None, 0, time.monotonic()
            while time.monotonic() < begin + seconds:
                if cpu is None and time.monotonic() >= begin:
                    cpu, size = cpu_seconds(agent.pid), path.stat().st_size
                ctypes.memmove(segment.words, contents[tick % len(contents)], 4 * WORDS)
                tick += 1
                if announces:
                    segment.words[cycle] = (tick // 2 if tick % 2 else -(tick // 2)) & 0xffffffff
                    segment.wake(cycle)
                due += 1.0 / rate
                time.sleep(max(0.0, due - time.monotonic()))
            cpu = cpu_seconds(agent.pid) - cpu
            memory = int(Path("/proc/%d/status" % agent.pid).read_text().split("VmHWM:")[1].split()[0])
            return 100 * cpu / seconds, memory, (path.stat().st_size - size) / 1e6 / seconds * 3600
        finally:
            agent.terminate()
            agent.wait()
            segment.remove()


def main():
    program = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/release/bin/pitchboard-agent"
    print("| changing at each tick | rate | CPU of a core | memory | MB/h |")
    print("|---|---|---|---|---|")
    for rate, changing, announces in ((100, 0.0, False), (100, 0.1, False), (100, 1.0, False), (100, 0.1, True),
                                      (500, 0.1, False), (500, 1.0, False)):
        cpu, memory, size = measure_record(program, rate, changing, announces)
        print("| %d %% | %d Hz%s | %.1f %% | %.1f MB | %.0f |" % (
            100 * changing, rate, " and 50 announced cycles a second" if announces else "", cpu, memory / 1024, size),
              flush=True)
    print()
    few = ["--variables", "LOCALIZATION_X,LOCALIZATION_Y,LOCALIZATION_THETA,VISION_BALL_DIST,VISION_BALL_ANGLE,"
           "DECISION_ACTION_?,IMU_EULER_?,VOLTAGE"]
    print("| variables | changing at each tick | rate | limit | kbit/s | datagrams/s | CPU of a core | memory |")
    print("|---|---|---|---|---|---|---|---|")
    for names, label in ((few, "11"), ([], "205")):
        for rate in (5, 20, 50):
            for changing in (0.0, 0.1, 1.0):
                kbit, datagrams, cpu, memory = measure(program, names, rate, changing)
                print("| %s | %d %% | %d Hz | none | %.0f | %.0f | %.1f %% | %.1f MB |" %
                      (label, 100 * changing, rate, kbit, datagrams, cpu, memory / 1024), flush=True)
    kbit, datagrams, cpu, memory = measure(program, [], 20, 1.0, limit=200)
    print("| 205 | 100 %% | 20 Hz | 200 | %.0f | %.0f | %.1f %% | %.1f MB |" % (kbit, datagrams, cpu, memory / 1024))


if __name__ == "__main__":
    main()
