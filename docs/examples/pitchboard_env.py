#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A robot that learns to score, as a vector environment in the shape of Gymnasium's.

Needs nothing but Python 3 and libpitchboard_sim (ctypes). Where numpy is installed, observations,
actions, rewards and flags are numpy arrays over the memory that the library reads and writes;
without it they are lists of rows or memoryviews over the same memory.

    env = ScoringEnv(num_envs=64, seed=1)
    observations, infos = env.reset()
    while True:
        observations, rewards, terminations, truncations, infos = env.step(actions)

An environment that is over begins again in the same step (Gymnasium's "same-step" autoreset): the
observation is already that of the new episode, and infos["final_obs"][i] is the last one of the old.

Run as a program it plays episodes with a simple rule and prints what came of them:

    python3 pitchboard_env.py --episodes 1000
"""

import argparse
import ctypes
import json
import math
import os
import random
import time
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_size_t, c_uint64, c_void_p

try:
    import numpy
except ImportError:
    numpy = None

API_VERSION = 1
ALL = -1
GAME = 2


class Options(ctypes.Structure):
    """pb_options of pitchboard_sim.h."""

    _fields_ = [
        ("size", c_size_t),
        ("scenario", c_char_p),
        ("text", c_char_p),
        ("worlds", c_int32),
        ("threads", c_int32),
        ("has_seed", c_int32),
        ("seed", c_uint64),
        ("duration", c_double),
        ("noise", c_char_p),
        ("physics", c_char_p),
        ("particles", c_int32),
    ]


class PitchboardError(Exception):
    """What the library refused, with its sentence."""


class Library:
    """The functions of libpitchboard_sim that this example uses; a refusal is an exception."""

    def __init__(self, path=None):
        path = path or os.environ.get("PITCHBOARD_SIM_LIBRARY") or "libpitchboard_sim.so.1"
        self._library = ctypes.CDLL(path)
        self._library.pb_last_error.restype = c_char_p
        self._library.pb_version.restype = c_char_p
        self._library.pb_column_name.restype = c_char_p
        self._library.pb_column_name.argtypes = [c_int32, c_size_t]
        self._library.pb_column_count.restype = c_size_t
        self._library.pb_column_count.argtypes = [c_int32]
        handle, doubles = c_void_p, POINTER(c_double)
        arguments = {
            "pb_options_init": [POINTER(Options), c_size_t],
            "pb_create": [POINTER(Options), POINTER(handle)],
            "pb_destroy": [handle],
            "pb_set_behaviour": [handle, c_int32, c_char_p],
            "pb_reset": [handle, c_int32, c_uint64],
            "pb_step": [handle, c_int32],
            "pb_read": [handle, c_int32, doubles, c_size_t],
            "pb_find_variable": [c_char_p, POINTER(c_int32)],
            "pb_read_variables": [handle, POINTER(c_int32), c_size_t, doubles, c_size_t],
            "pb_write_variables": [handle, POINTER(c_int32), c_size_t, doubles, c_size_t],
            "pb_write_actions": [handle, POINTER(c_int32), c_size_t],
            "pb_place_robot": [handle, c_int32, c_int32, c_double, c_double, c_double],
            "pb_place_ball": [handle, c_int32, c_double, c_double, c_double, c_double],
            "pb_read_hashes": [handle, POINTER(c_uint64), c_size_t],
        }
        for name, types in arguments.items():
            function = getattr(self._library, name)
            function.argtypes = types
            function.restype = c_int32
            setattr(self, name[3:], self._checked(function))
        if self._library.pb_api_version() < API_VERSION:
            raise PitchboardError("this library is older than the example")

    def _checked(self, function):
        def call(*arguments):
            if function(*arguments) != 0:
                raise PitchboardError(self._library.pb_last_error().decode())

        return call

    def column(self, array, name):
        """The place of a column by its name, and how many there are."""
        count = self._library.pb_column_count(array)
        names = [self._library.pb_column_name(array, i).decode() for i in range(count)]
        return names.index(name), count


class Box:
    """Numbers between bounds, as gymnasium.spaces.Box."""

    def __init__(self, low, high, dtype="float64"):
        self.low, self.high, self.shape, self.dtype = list(low), list(high), (len(low),), dtype

    def contains(self, row):
        return len(row) == len(self.low) and all(
            low <= value <= high for low, value, high in zip(self.low, row, self.high)
        )


class Discrete:
    """Whole numbers from 0, as gymnasium.spaces.Discrete."""

    def __init__(self, n):
        self.n, self.shape, self.dtype = n, (), "int32"


def shared(buffer, rows, columns=None):
    """The library's memory as a numpy array, or as a memoryview with the same shape."""
    if numpy is not None:
        array = numpy.frombuffer(buffer, dtype=buffer._type_)
        return array if columns is None else array.reshape(rows, columns)
    view = memoryview(buffer).cast("B").cast("d" if buffer._type_ is c_double else "i")
    return view if columns is None else view.cast("B").cast("d", (rows, columns))


class ScoringEnv:
    """One blue robot and a ball on every field; the robot is to bring the ball into the right goal.

    Observation: five variables of the robot's blackboard as its own processes read them.
    Action: a code of DECISION_ACTION_A, held for `ticks_per_action` ticks.
    Reward: metres that the ball came nearer to the goal line; 10 for a goal, after which the ball
    lies on the centre mark.
    Terminated: a goal or the ball out. Truncated: after `seconds`.
    """

    metadata = {"autoreset_mode": "same-step"}
    VARIABLES = ["VISION_LOST", "VISION_BALL_DIST", "VISION_BALL_ANGLE", "IMU_EULER_Z", "CONTROL_ACTION"]
    single_observation_space = Box(
        [0, 0, -180, -math.pi, 0],  # 1 = lost; cm; degrees, left positive; rad; code
        [1, 1e4, 180, math.pi, 22],
    )
    single_action_space = Discrete(23)
    GOAL, DURATION = 1, 3  # of the column "finished"

    def __init__(self, num_envs=64, seed=1, threads=1, seconds=20.0, noise="paper",
                 ticks_per_action=6, library=None):
        self.num_envs = num_envs
        self._api = Library(library)
        self._worlds = c_void_p()
        self._ticks = ticks_per_action
        self._random = random.Random(seed)
        self._next_seed = seed
        scenario = {
            "version": 1,
            "name": "scoring",
            "noise": noise,
            "ball": {"x": 0, "y": 0},
            "robots": [{"team": "blue", "number": 1, "x": -1, "y": 0, "heading": 0,
                        "behaviour": "none"}],
            "stop": {"duration": seconds, "goal": True, "ball_out": True},
        }
        text = json.dumps(scenario).encode()
        options = Options()
        self._api.options_init(byref(options), ctypes.sizeof(options))
        options.text = text
        options.worlds, options.threads = num_envs, threads
        self._api.create(byref(options), byref(self._worlds))
        columns = len(self.VARIABLES)
        self._variables = (c_int32 * columns)()
        for i, name in enumerate(self.VARIABLES):
            number = c_int32()
            self._api.find_variable(name.encode(), byref(number))
            self._variables[i] = number
        self._finished, game_columns = self._api.column(GAME, "finished")
        self._ball_x, _ = self._api.column(GAME, "ball_x")
        self._scored, _ = self._api.column(GAME, "score_left")
        # The library fills these; what the caller sees are views of them.
        self._observation_memory = (c_double * (num_envs * columns))()
        self._game_memory = (c_double * (num_envs * game_columns))()
        self._action_memory = (c_int32 * num_envs)()
        self._start_memory = (c_double * (num_envs * columns))()
        self._reward_memory = (c_double * num_envs)()
        self._observations = shared(self._observation_memory, num_envs, columns)
        self._game = shared(self._game_memory, num_envs, game_columns)
        self._rewards = shared(self._reward_memory, num_envs)
        self.actions = shared(self._action_memory, num_envs)
        self._balls = [0.0] * num_envs

    def close(self):
        if self._worlds:
            self._api.destroy(self._worlds)
            self._worlds = c_void_p()

    def reset(self, *, seed=None, options=None):
        del options
        if seed is not None:
            self._next_seed = seed
            self._random = random.Random(seed)
        self._begin(range(self.num_envs))
        self._read()
        return self._observations, {}

    def step(self, actions):
        """`actions`: a code for each environment; self.actions itself costs no copy."""
        if actions is not self.actions:
            self._action_memory[:] = [int(action) for action in actions]
        api, count = self._api, self.num_envs
        api.write_actions(self._worlds, self._action_memory, count)
        api.step(self._worlds, self._ticks)
        self._read()
        terminations, truncations, over = [False] * count, [False] * count, []
        for i in range(count):
            row = self._game_memory[i * len(self._game_memory) // count:
                                    (i + 1) * len(self._game_memory) // count]
            ball, finished = row[self._ball_x], int(row[self._finished])
            self._rewards[i] = ball - self._balls[i]
            self._balls[i] = ball
            if finished:
                over.append(i)
                truncations[i] = finished == self.DURATION
                terminations[i] = not truncations[i]
                if finished == self.GOAL:
                    self._rewards[i] = 10.0 if row[self._scored] > 0 else 0.0
        infos = {}
        if over:
            columns = len(self.VARIABLES)
            infos["final_obs"] = {
                i: self._observation_memory[i * columns:(i + 1) * columns] for i in over}
            self._begin(over)
            self._read()
        if numpy is not None:
            terminations, truncations = numpy.array(terminations), numpy.array(truncations)
        return self._observations, self._rewards, terminations, truncations, infos

    def hashes(self):
        """Equal states have equal hashes; for tests that a run repeats."""
        out = (c_uint64 * self.num_envs)()
        self._api.read_hashes(self._worlds, out, self.num_envs)
        return list(out)

    def _begin(self, worlds):
        columns = len(self.VARIABLES)
        self._start_memory[:] = [math.nan] * len(self._start_memory)
        for i in worlds:
            self._api.reset(self._worlds, i, self._next_seed)
            self._next_seed += 1
            draw = self._random.uniform
            x, y = draw(2.5, 3.5), draw(-1.0, 1.0)
            self._balls[i] = x
            self._api.place_ball(self._worlds, i, x, y, 0.0, 0.0)
            # Behind the ball, near enough to see it.
            self._api.place_robot(self._worlds, i, 1, x - draw(0.5, 2.0), y + draw(-0.5, 0.5),
                                  draw(-0.5, 0.5))
            self._start_memory[i * columns] = 1.0  # nothing has been seen yet
        self._api.write_variables(self._worlds, self._variables, columns, self._start_memory,
                                  len(self._start_memory))

    def _read(self):
        self._api.read_variables(self._worlds, self._variables, len(self.VARIABLES),
                                 self._observation_memory, len(self._observation_memory))
        self._api.read(self._worlds, GAME, self._game_memory, len(self._game_memory))


STOP, FORWARD, LEFT, RIGHT, KICK = 0, 1, 2, 3, 4


def chase(observation):
    """Turns to the ball, walks to it and kicks: what a learned policy has to beat."""
    lost, distance_cm, angle_deg = observation[0], observation[1], observation[2]
    if lost:
        return LEFT
    if angle_deg > 12:
        return LEFT
    if angle_deg < -12:
        return RIGHT
    return KICK if distance_cm < 22 else FORWARD


def main():
    parser = argparse.ArgumentParser(description="Plays episodes and prints what came of them.")
    parser.add_argument("--episodes", type=int, default=1000)
    parser.add_argument("--envs", type=int, default=64)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--library", help="libpitchboard_sim.so; default: the installed one")
    arguments = parser.parse_args()
    env = ScoringEnv(arguments.envs, arguments.seed, arguments.threads, library=arguments.library)
    began = time.perf_counter()
    observations, _ = env.reset()
    episodes = goals = steps = 0
    total = 0.0
    while episodes < arguments.episodes:
        for i in range(env.num_envs):
            row = [observations[i, k] for k in range(3)]
            env.actions[i] = chase(row)
        observations, rewards, terminations, truncations, _ = env.step(env.actions)
        steps += env.num_envs
        for i in range(env.num_envs):
            total += float(rewards[i])
            if terminations[i] or truncations[i]:
                episodes += 1
                goals += int(rewards[i] > 5.0)
    took = time.perf_counter() - began
    print(json.dumps({
        "episodes": episodes,
        "goals": goals,
        "mean_reward": round(total / episodes, 6),
        "steps": steps,
        "steps_per_second": round(steps / took),
        "numpy": numpy is not None,
        "last_hash": f"0x{env.hashes()[0]:016x}",
    }))
    env.close()


if __name__ == "__main__":
    main()
