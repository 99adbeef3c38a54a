#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A recording in Python, and the same by the official readers of MCAP and ROS 2 messages, bit for bit:
tst_python_readers.py FOLDER_OF_PROGRAMS FOLDER_OF_READERS"""

import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

import numpy as np

import pitchboard

programs, readers = sys.argv[1:3]
script = pathlib.Path(readers, "read_session.mjs")
shutil.copy(pathlib.Path(__file__).resolve().parent.parent / "mcap_readers" / script.name, script)


def number(text):
    return float("nan") if text == "nan" else struct.unpack(">d", bytes.fromhex(text))[0]


with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "match.mcap")
    subprocess.run([os.path.join(programs, "pitchboard-cli"), "record", "--scenario", "match-3v3", "--duration", "10",
                    "--seed", "4", "-o", path], check=True, stdout=subprocess.DEVNULL)
    lines = subprocess.run(["node", str(script), path], check=True, capture_output=True, text=True).stdout.splitlines()
    fields, rows = {}, {}
    for line in lines:
        kind, topic, *rest = line.split(" ")
        if kind == "schema":
            fields[topic] = [field.split(":")[1] for field in rest[2:]]
        elif kind == "row":
            rows.setdefault(topic, []).append([number(text) for text in rest[3:]])
    compared = 0
    with pitchboard.open(path) as session:
        for name in session.values():
            topic = f"/robots/{name.name}/row" if name.name in session.robots else f"/{name.name}/row"
            table = np.array(rows.pop(topic)).T
            columns = dict(zip(fields[topic], table))
            first = next(iter(name.values()))
            np.testing.assert_array_equal(first.time, columns.pop("source_time"))
            for variable in name.values():
                expected = columns.pop(re.sub("[^a-z0-9]+", "_", variable.name.lower()).strip("_"))
                recorded = variable.recorded.astype(np.float64)
                same = recorded.view(np.uint64) == expected.view(np.uint64)
                assert (same | (np.isnan(recorded) & np.isnan(expected))).all(), f"{name.name}.{variable.name}"
                compared += len(expected)
            assert not columns, columns.keys()
    assert not rows, rows.keys()
    assert compared > 300_000, compared
    print(f"{compared} values are the same")
