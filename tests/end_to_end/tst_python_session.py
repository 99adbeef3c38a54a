#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings and experiments in Python: tst_python_session.py FOLDER_OF_PROGRAMS"""

import copy
import csv
import gc
import io
import json
import math
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import pitchboard

PROGRAMS = sys.argv[1]
DATA = pathlib.Path(__file__).resolve().parent.parent / "data" / "sessions"


def cli(*arguments):
    return subprocess.run([os.path.join(PROGRAMS, "pitchboard-cli"), *arguments], check=True,
                          capture_output=True, text=True).stdout


class TestPythonSession(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.path = cls.folder / "match.mcap"
        cli("record", "--scenario", "match-3v3", "--duration", "20", "--seed", "3", "-o", str(cls.path))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.session = pitchboard.open(self.path)
        self.addCleanup(self.session.close)

    def test_every_value_is_that_of_the_wide_table(self):
        """CSV has the shortest text that gives the same number again."""
        with open(self.folder / "wide.csv", "w", encoding="utf-8") as file:
            file.write(cli("export", str(self.path), "--to", "csv-wide"))
        with open(self.folder / "wide.csv", encoding="utf-8", newline="") as file:
            lines = csv.reader(file)
            head = next(lines)
            columns = dict(zip(head, zip(*lines)))
        times = np.array([float(time) for time in columns.pop("time")])
        self.assertGreater(len(columns), 6 * 100)
        compared = 0
        for name in self.session:
            group = self.session[name]
            recorded = {variable: group[variable].recorded for variable in group}
            np.testing.assert_array_equal(group[next(iter(group))].time, times)
            for variable, values in recorded.items():
                cells = columns.pop(f"{name}.{variable}")
                if group[variable].kind == "text":
                    continue
                expected = np.array([math.nan if cell == "" else float(cell) for cell in cells])
                np.testing.assert_array_equal(
                    values, expected.astype(values.dtype), f"{name}.{variable}")
                compared += len(values)
        self.assertEqual(columns, {})
        self.assertGreater(compared, 500_000)

    def test_unknown_values_are_nan(self):
        robot = self.session["B1"]
        table = robot[["VISION_LOST", "VISION_BALL_DIST"]].read()
        lost = table["VISION_LOST"] == 1
        self.assertTrue(lost.any() and (~lost).any())
        self.assertTrue(np.isnan(table["VISION_BALL_DIST"][lost]).all())
        distance = robot["VISION_BALL_DIST"]
        known = np.isfinite(distance.values)
        self.assertTrue(known.any())
        np.testing.assert_array_equal(distance.values[known], distance.recorded[known])
        self.assertTrue(np.isfinite(distance.recorded[lost]).all())
        self.assertEqual((distance.unit, distance.dtype), ("cm", np.float32))
        self.assertEqual(robot["VISION_LOST"].dtype, np.int32)
        self.assertEqual(robot["TRUE_X"].dtype, np.float64)
        with self.assertRaises(ValueError):
            distance.values[0] = 1.0

    def test_labels_of_codes(self):
        action = self.session["B1"]["DECISION_ACTION_A"]
        self.assertEqual(action.kind, "enumeration")
        for code, text in zip(action.values[::100], action.texts[::100]):
            self.assertEqual(text, action.labels.get(int(code)))
        self.assertTrue(any(action.texts))

    def test_parts_of_time(self):
        whole = self.session["B1"]["TRUE_X"]
        for part in (self.session[5:6]["B1"]["TRUE_X"], self.session["B1"][5:6]["TRUE_X"],
                     self.session[4:][:6]["B1"][5:]["TRUE_X"]):
            chosen = (whole.time >= 5) & (whole.time <= 6)
            self.assertGreater(chosen.sum(), 50)
            np.testing.assert_array_equal(part.time, whole.time[chosen])
            np.testing.assert_array_equal(part.values, whole.values[chosen])
        self.assertEqual(len(self.session["B1"][100:]["TRUE_X"]), 0)
        self.assertEqual((self.session[5:6].begin, self.session[5:6].end), (5, 6))
        for wrong in (slice(6, 5), slice(0, 1, 0.1), slice(math.nan, 1)):
            with self.assertRaises(ValueError):
                self.session[wrong]

    def test_frames(self):
        robot = self.session["B1"].read()
        for frame in self.session.frames([0.5, 3.21, 19.0]):
            row = np.flatnonzero(robot["time"] <= frame.time)[-1]
            self.assertEqual(frame["B1"].time, robot["time"][row])
            for name in self.session["B1"]:
                np.testing.assert_equal(frame["B1"][name], float(robot[name][row]), name)
        times = [frame.time for frame in self.session.frames(step=5)]
        np.testing.assert_allclose(np.diff(times), 5)
        self.assertTrue(math.isnan(self.session.at(-5)["B1"].time))
        with self.assertRaises(ValueError):
            next(self.session.frames(step=0))

    def test_robots_events_and_game(self):
        self.assertEqual(self.session.robots, ["B1", "B2", "B3", "R1", "R2", "R3"])
        self.assertEqual((self.session.info["source"], self.session.info["seed"]), ("simulation", 3))
        self.assertEqual(self.session.notes, [])
        self.assertIn("BALL_X", self.session.game)
        events = self.session.events
        self.assertTrue(events)
        printed = cli("inspect", str(self.path), "--json", "--events")
        self.assertEqual(events, json.loads(printed)["events"])
        part = self.session[: events[0]["time"]].events
        self.assertEqual(part, [one for one in events if one["time"] <= events[0]["time"]])

    def test_wrong_names_list_near_ones(self):
        with self.assertRaisesRegex(pitchboard.NotFoundError, 'no robot "B4".*B1'):
            self.session["B4"]
        with self.assertRaisesRegex(KeyError, "did you mean.*VISION_BALL_DIST"):
            self.session["B1"]["VISION_BAL_DIST"]
        with self.assertRaisesRegex(KeyError, "TRUE_X"):
            self.session.at(1)["B1"]["TRUEX"]
        self.assertNotIn("B4", self.session)
        with self.assertRaises(TypeError):
            self.session[3]

    def test_bad_files_say_what_the_command_line_says(self):
        bad = self.folder / "bad.mcap"
        bad.write_bytes(b"no recording at all, but some text" * 10)
        for path in (bad, self.folder / "missing.mcap", self.folder):
            said = subprocess.run([os.path.join(PROGRAMS, "pitchboard-cli"), "export", str(path), "--to",
                                   "csv-wide"], capture_output=True, text=True).stderr
            with self.assertRaises(pitchboard.PitchboardError) as raised:
                pitchboard.open(path)
            self.assertIn(str(raised.exception), said)
        with self.assertRaises(pitchboard.NotFoundError):
            pitchboard.open(self.folder / "missing.mcap")

    def test_a_truncated_file_opens_as_far_as_it_goes(self):
        cut = self.folder / "cut.mcap"
        cut.write_bytes(self.path.read_bytes()[: self.path.stat().st_size // 2])
        with pitchboard.open(cut) as session:
            self.assertFalse(session.info["complete"])
            self.assertTrue(session.notes)
            whole, part = self.session["B1"]["TRUE_X"], session["B1"]["TRUE_X"]
            self.assertTrue(0 < len(part) < len(whole))
            np.testing.assert_array_equal(part.values, whole.values[: len(part)])

    def test_older_and_foreign_files(self):
        for name in ("rolling_0.8.mcap", "advisor_0.21.mcap", "small.mcap", "plain_broken_off.mcap"):
            with pitchboard.open(DATA / name) as session:
                for group in session.values():
                    table = group.read()
                    self.assertEqual({len(column) for column in table.values()}, {len(table["time"])})

    def test_arrays_stay_when_the_session_is_closed(self):
        values = self.session["B1"]["TRUE_X"].values
        before = values.copy()
        variable = self.session["B1"]["TRUE_Y"]
        self.session.close()
        self.session.close()
        gc.collect()
        np.testing.assert_array_equal(values, before)
        for use in (lambda: self.session["B1"], lambda: self.session.events, lambda: variable.values,
                    lambda: self.session.at(1), lambda: self.session.notes):
            with self.assertRaisesRegex(pitchboard.ClosedError, "closed"):
                use()

    def test_pickling_is_refused_with_what_to_do(self):
        for thing in (self.session, self.session["B1"], self.session["B1"]["TRUE_X"]):
            for refused in (pickle.dumps, copy.deepcopy):
                with self.assertRaisesRegex(TypeError, "pickle"):
                    refused(thing)
        pickle.dumps(self.session["B1"]["TRUE_X"].values)

    def test_threads_share_a_session(self):
        expected = self.session["B1"]["TRUE_X"].values
        wrong = []

        def read(name):
            for begin in range(10):
                got = self.session[begin:20][name]["TRUE_X"].values
                if name == "B1" and not np.array_equal(got, expected[len(expected) - len(got):]):
                    wrong.append(begin)

        threads = [threading.Thread(target=read, args=(name,)) for name in ("B1", "B2", "B1", "R3")]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_memory_is_that_of_what_was_asked_for(self):
        from pitchboard._library import lib
        held = self.session["B1"]["TRUE_X"]
        self.assertEqual(held.values.nbytes, 8 * len(held.time))
        self.assertFalse(held.values.flags.owndata)  # the library's memory
        freed = []
        free = lib.pb_data_free
        try:
            lib.pb_data_free = lambda handle: freed.append(1) or free(handle)
            del held
            gc.collect()
        finally:
            lib.pb_data_free = free
        self.assertEqual(freed, [1])

    def test_pandas(self):
        robot = self.session["B1"][["TRUE_X", "VISION_BALL_DIST"]]
        try:
            import pandas
        except ImportError:
            with self.assertRaisesRegex(pitchboard.PitchboardError, "pandas"):
                robot.to_pandas()
            return
        frame = robot.to_pandas()
        self.assertEqual((frame.index.name, list(frame.columns)), ("time", list(robot)))
        np.testing.assert_array_equal(frame.loc[5:6, "TRUE_X"], robot[5:6]["TRUE_X"].values)
        self.assertIsInstance(robot["TRUE_X"].to_pandas(), pandas.Series)

    def test_statistics(self):
        table = pitchboard.statistics([self.session[5:10], self.session], ["TRUE_X", "DECISION_ACTION_A"], ["B1", "R2"])
        rows = {(row["session"], row["robot"], row["variable"], row["label"]): row for row in table.rows()}
        for number, part in enumerate((self.session[5:10], self.session)):
            for robot in ("B1", "R2"):
                row, values = rows[number, robot, "TRUE_X", ""], part[robot]["TRUE_X"].values
                self.assertEqual((row["n"], row["unit"], row["share"]), (len(values), part[robot]["TRUE_X"].unit, 1.0))
                self.assertAlmostEqual(row["mean"], values.mean(dtype=float), 9)
                self.assertAlmostEqual(row["p95"], float(np.percentile(values.astype(float), 95)), 9)
                self.assertLessEqual(1, row["n_effective"])
                self.assertLess(row["n_effective"], len(values) / 5)  # a robot does not jump
                if row["n_effective"] >= 2:
                    self.assertTrue(row["mean_95_low"] < row["mean"] < row["mean_95_high"])
                else:  # a robot that only walks away says nothing about its mean
                    self.assertTrue(math.isnan(row["mean_95_low"]) and math.isnan(row["mean_95_high"]))
                action = part[robot]["DECISION_ACTION_A"]
                states = [row for key, row in rows.items() if key[:3] == (number, robot, action.name) and key[3]]
                self.assertEqual({row["value"]: row["label"] for row in states},
                                 {float(code): action.labels[code] for code in np.unique(action.values)})
                self.assertAlmostEqual(sum(row["share"] for row in states), 1.0, 9)
        unseen = pitchboard.statistics(self.session, "VISION_BALL_DIST", "B1").rows()[0]
        values = self.session["B1"]["VISION_BALL_DIST"].values
        self.assertEqual(unseen["n"], np.isfinite(values).sum())
        self.assertAlmostEqual(unseen["share"], np.isfinite(values).mean(), 2)
        self.assertGreater(pitchboard.statistics(self.session).shape[0], 6 * 50)
        self.assertEqual(pitchboard.statistics(self.session[5:5.001], "TRUE_X").shape[0], 6)
        with self.assertRaisesRegex(pitchboard.NotFoundError, 'no session has a robot "B9"'):
            pitchboard.statistics(self.session, "TRUE_X", ["B1", "B9"])
        with self.assertRaisesRegex(pitchboard.NotFoundError, '"TRUE_Q"; did you mean TRUE_'):
            pitchboard.statistics(self.session, "TRUE_Q")
        self.assertEqual(pitchboard.statistics(self.path, "TRUE_X")["mean"].tolist(),
                         pitchboard.statistics(self.session, "TRUE_X")["mean"].tolist())
        with self.assertRaisesRegex(pitchboard.PitchboardError, "at least one session"):
            pitchboard.statistics([])
        with self.assertRaises(pitchboard.NotFoundError):
            pitchboard.statistics(self.folder / "none.mcap")

    def test_the_command_line_computes_what_numpy_does(self):
        table = list(csv.DictReader(io.StringIO(cli(
            "statistics", str(self.path), "--variables", "TRUE_X,DECISION_ACTION_A", "--robots", "B1", "--against",
            "BELIEF_X", "--histogram", "7", "--csv"))))
        robot = self.session["B1"]
        x, row = robot["TRUE_X"].values.astype(float), table[0]
        expected = {"n": x.size, "mean": x.mean(), "sd": x.std(ddof=1), "rms": np.sqrt((x * x).mean()), "min": x.min(),
                    "max": x.max(), "min_time": robot["TRUE_X"].time[x.argmin()],
                    "max_time": robot["TRUE_X"].time[x.argmax()]}
        expected.update({name: np.percentile(x, share) for name, share in
                         (("p05", 5), ("p25", 25), ("median", 50), ("p75", 75), ("p95", 95))})
        error = x - robot["BELIEF_X"].values.astype(float)
        known = np.isfinite(error)
        expected.update(error_n=known.sum(), bias=error[known].mean(), error_rms=np.sqrt((error[known] ** 2).mean()),
                        largest_error=error[known][np.abs(error[known]).argmax()])
        for name, value in expected.items():
            self.assertAlmostEqual(float(row[name]), float(value), 7, name)
        self.assertEqual([int(one) for one in row["histogram"].split()], np.histogram(x, 7)[0].tolist())
        both = robot["BELIEF_X"].values.astype(float)
        self.assertAlmostEqual(float(row["correlation"]), np.corrcoef(x[known], both[known])[0, 1], 6)
        python = pitchboard.statistics(self.session, ["TRUE_X", "DECISION_ACTION_A"], "B1").rows()
        self.assertAlmostEqual(float(row["n_effective"]), python[0]["n_effective"], 6)
        self.assertEqual([(one["label"], round(float(one["share"]), 9)) for one in table],
                         [(one["label"], round(one["share"], 9)) for one in python])

    def test_intervals_hold_for_samples_that_follow_each_other(self):
        """Series whose samples are alike, with mean 0: the interval has to contain it in 95 of 100."""
        from pitchboard.statistics import _numbers
        random = np.random.default_rng(47)
        for alike in (0.0, 0.5, 0.8, 0.9, 0.95):
            series = np.zeros((1000, 2300))
            noise = random.normal(size=series.shape)
            for i in range(1, series.shape[1]):
                series[:, i] = alike * series[:, i - 1] + noise[:, i]
            held = 0
            for one in series[:, 300:]:
                row = _numbers(one, False)
                held += row["mean_95_low"] < 0 < row["mean_95_high"]
            self.assertTrue(920 <= held <= 970, f"{held} of 1000 with {alike}")

    def test_an_experiment(self):
        described = {
            "version": 1, "name": "small", "scenario": "one-robot", "runs": 4,
            "conditions": [{"name": "quiet", "set": {"noise": "none"}},
                           {"name": "noisy", "set": {"noise": "paper"}}],
            "stop": {"duration": 5}, "assertions": ["mean(time_s) >= 0", "mean(walked_m) > 1000"],
        }
        out = self.folder / "results"
        result = pitchboard.experiment(described, out, jobs=2)
        self.assertEqual(result.runs.shape[0], 8)
        self.assertEqual(list(result.runs["condition"]), ["quiet"] * 4 + ["noisy"] * 4)
        for number, row in enumerate(result.conditions.rows()):
            runs = result.runs[row["metric"]][result.runs["condition"] == row["condition"]]
            self.assertAlmostEqual(row["mean"], float(np.nanmean(runs)), 9, str(row))
        self.assertGreater(number, 10)
        self.assertEqual(set(result.differences["of"]), {"noisy"})
        self.assertFalse(result.holds)
        self.assertEqual(set(result.assertions["holds"]), {0.0, 1.0})
        again = pitchboard.experiment(described, jobs=1)
        self.assertEqual(list(again.runs["state_hash"]), list(result.runs["state_hash"]))
        with self.assertRaisesRegex(pitchboard.PitchboardError, "results"):
            pitchboard.experiment(described, out)
        with self.assertRaisesRegex(pitchboard.PitchboardError, "no-such"):
            pitchboard.experiment("no-such")


os.environ["PATH"] = PROGRAMS + os.pathsep + os.environ["PATH"]
unittest.main(argv=sys.argv[:1])
