#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much longer a step of 256 worlds takes in Python than in C: python_worlds.py BENCH_CAPI

Both play the same task with the same rule, one after the other, five times; the fastest of each counts. CPU time of one
core. The module and the library are those of this checkout.
"""
import json
import pathlib
import subprocess
import sys
import time

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "robotlink/laboratory/capi/python"))
import pitchboard  # noqa: E402

STEPS = 400


def chase(seen):
    lost, distance, angle = seen[:, 0], seen[:, 1], seen[:, 2]
    return np.where((lost > 0) | (angle > 12), 2, np.where(angle < -12, 3, np.where(distance < 22, 4, 1)))


def in_python():
    with pitchboard.Worlds(num_envs=256, seed=1) as worlds:
        seen, _ = worlds.reset()
        begin = time.process_time()
        for _ in range(STEPS):
            seen, *_ = worlds.step(chase(seen))
        return (time.process_time() - begin) / STEPS * 1e3


def in_c():
    said = subprocess.run([sys.argv[1], "--benchmark_filter=^learning$", "--benchmark_format=json"], check=True,
                          capture_output=True, text=True).stdout
    return json.loads(said)["benchmarks"][0]["cpu_time"]


times = [(in_c(), in_python()) for _ in range(5)]
c, python = (min(column) for column in zip(*times))
print(f"a step of 256 worlds: {c:.2f} ms in C, {python:.2f} ms in Python, {python / c:.2f} times")
