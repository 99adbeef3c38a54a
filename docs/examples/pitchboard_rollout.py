#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What may become of a situation: many short games from one belief, in Python.

Needs nothing but Python 3 and libpitchboard_sim (ctypes).

    rollouts = Rollouts("match")
    belief = rollouts.beginning()
    belief.game["ball_x"] = 3.0                    # where the ball was seen last, in metres
    belief.robots[1].update(x=2.5, y=0.2, sigma=0.15)
    outcomes = rollouts.play(belief, count=500, seconds=10)
    print(outcomes.share("goals_left"), outcomes.mean("ball_x"))

Run as a program it plays rollouts of a scenario's beginning and prints what came of them as JSON:

    python3 pitchboard_rollout.py --scenario match --count 500
"""

import argparse
import ctypes
import json
import os
import time
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_size_t, c_uint64, c_void_p

API_VERSION = 2
BELIEF_ROBOTS, BELIEF_GAME, OUTCOMES = 4, 5, 6


class RolloutOptions(ctypes.Structure):
    """pb_rollout_options of pitchboard_sim.h."""

    _fields_ = [
        ("size", c_size_t),
        ("scenario", c_char_p),
        ("text", c_char_p),
        ("noise", c_char_p),
        ("threads", c_int32),
        ("tick_rate", c_double),
    ]


class PlayOptions(ctypes.Structure):
    """pb_play_options of pitchboard_sim.h."""

    _fields_ = [
        ("size", c_size_t),
        ("seconds", c_double),
        ("look", c_double),
        ("go_on", c_int32),
    ]


class PitchboardError(Exception):
    """What the library refused, with its sentence."""


class Belief:
    """A dictionary for each robot, in the order of the scenario, and one for ball and game."""

    def __init__(self, robots, game):
        self.robots, self.game = robots, game


class Outcomes:
    """Rows of numbers with named columns, one for each rollout."""

    def __init__(self, columns, memory, count):
        self.columns, self.memory, self.count = columns, memory, count

    def column(self, name):
        return self.memory[self.columns.index(name) :: len(self.columns)]

    def mean(self, name):
        return sum(self.column(name)) / self.count

    def share(self, name):
        """The share of rollouts in which this number is greater than 0."""
        return sum(value > 0 for value in self.column(name)) / self.count


class Rollouts:
    """Rollouts of the robots of a scenario."""

    def __init__(self, scenario="match", noise=None, threads=1, tick_rate=20.0, library=None):
        path = library or os.environ.get("PITCHBOARD_SIM_LIBRARY") or "libpitchboard_sim.so.1"
        self._library = ctypes.CDLL(path)
        self._library.pb_last_error.restype = c_char_p
        self._library.pb_column_name.restype = c_char_p
        self._library.pb_column_name.argtypes = [c_int32, c_size_t]
        self._library.pb_column_count.restype = c_size_t
        self._library.pb_column_count.argtypes = [c_int32]
        if self._library.pb_api_version() < API_VERSION:
            raise PitchboardError("this library is older than the example")
        doubles = POINTER(c_double)
        self._library.pb_rollouts_destroy.argtypes = [c_void_p]
        self._library.pb_rollouts_robots.argtypes = [c_void_p, POINTER(c_int32)]
        self._library.pb_rollouts_beginning.argtypes = [c_void_p, doubles, c_size_t] + [
            doubles,
            c_size_t,
        ]
        self._library.pb_rollouts_play.argtypes = (
            [c_void_p, POINTER(PlayOptions), doubles, c_size_t, doubles, c_size_t]
            + [POINTER(c_uint64), c_size_t, doubles, c_size_t]
        )
        self._robot_columns = self._columns(BELIEF_ROBOTS)
        self._game_columns = self._columns(BELIEF_GAME)
        self._outcome_columns = self._columns(OUTCOMES)

        options = RolloutOptions()
        self._checked(
            self._library.pb_rollout_options_init(
                byref(options), c_size_t(ctypes.sizeof(options))
            )
        )
        options.scenario = scenario.encode()
        options.noise = noise.encode() if noise else None
        options.threads, options.tick_rate = threads, tick_rate
        self._rollouts = c_void_p()
        self._checked(self._library.pb_rollouts_create(byref(options), byref(self._rollouts)))
        count = c_int32()
        self._checked(self._library.pb_rollouts_robots(self._rollouts, byref(count)))
        self.robots = count.value

    def _columns(self, array):
        count = self._library.pb_column_count(array)
        return [self._library.pb_column_name(array, i).decode() for i in range(count)]

    def _checked(self, status):
        if status != 0:
            raise PitchboardError(self._library.pb_last_error().decode())

    def close(self):
        if self._rollouts:
            self._checked(self._library.pb_rollouts_destroy(self._rollouts))
            self._rollouts = None

    def beginning(self):
        """The scenario's beginning as a belief."""
        width = len(self._robot_columns)
        robots = (c_double * (self.robots * width))()
        game = (c_double * len(self._game_columns))()
        self._checked(
            self._library.pb_rollouts_beginning(
                self._rollouts, robots, len(robots), game, len(game)
            )
        )
        rows = [robots[i * width : (i + 1) * width] for i in range(self.robots)]
        return Belief(
            [dict(zip(self._robot_columns, row)) for row in rows],
            dict(zip(self._game_columns, game)),
        )

    def play(self, belief, count=500, seconds=10.0, look=5.0, seed=1, go_on=False):
        """Rollouts with the seeds seed, seed + 1, ...; what is left out is as at the beginning."""
        missing = float("nan")
        numbers = [row.get(name, missing) for row in belief.robots for name in self._robot_columns]
        robots = (c_double * len(numbers))(*numbers)
        game = (c_double * len(self._game_columns))(
            *[belief.game.get(name, missing) for name in self._game_columns]
        )
        seeds = (c_uint64 * count)(*range(seed, seed + count))
        outcomes = (c_double * (count * len(self._outcome_columns)))()
        options = PlayOptions()
        self._checked(
            self._library.pb_play_options_init(byref(options), c_size_t(ctypes.sizeof(options)))
        )
        options.seconds, options.look, options.go_on = seconds, look, int(go_on)
        self._checked(
            self._library.pb_rollouts_play(
                self._rollouts,
                byref(options),
                robots,
                len(robots),
                game,
                len(game),
                seeds,
                count,
                outcomes,
                len(outcomes),
            )
        )
        return Outcomes(self._outcome_columns, outcomes, count)


def main():
    parser = argparse.ArgumentParser(description="What may become of a scenario's beginning.")
    parser.add_argument("--scenario", default="match")
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--library")
    arguments = parser.parse_args()
    rollouts = Rollouts(arguments.scenario, threads=arguments.threads, library=arguments.library)
    belief = rollouts.beginning()
    begin = time.perf_counter()
    outcomes = rollouts.play(belief, arguments.count, arguments.seconds, seed=arguments.seed)
    took = time.perf_counter() - begin
    print(
        json.dumps(
            {
                "rollouts": outcomes.count,
                "goal_left": outcomes.share("goals_left"),
                "goal_right": outcomes.share("goals_right"),
                "mean_ball_x": round(outcomes.mean("ball_x"), 6),
                "times_real_time": round(sum(outcomes.column("time")) / took),
            }
        )
    )
    rollouts.close()


if __name__ == "__main__":
    main()
