# SPDX-License-Identifier: GPL-3.0-or-later
"""Rollouts: what may become of a situation, from many short games."""

import ctypes
import json
import os
from ctypes import byref, c_int32, c_void_p
from typing import Any, Dict, List, Mapping, NoReturn, Optional, Union

import numpy as np
import numpy.typing as npt

from ._library import (
    ClosedError,
    PlayOptions,
    RolloutOptions,
    address,
    check,
    column_names,
    encoded,
    lib,
    refuse_pickle,
    unknown_name,
)
from .table import Table

BELIEF_ROBOTS, BELIEF_GAME, OUTCOMES = 4, 5, 6


class Belief:
    """What is believed: `robots`, a dictionary for each robot in the order of the scenario, and
    `game`, one for ball and game. Units: m, m/s, s, rad; the names are those of docs/rollouts.md.
    What is left out is as at the beginning of the scenario."""

    def __init__(self, robots: List[Dict[str, float]], game: Dict[str, float]) -> None:
        self.robots = robots
        self.game = game


class Outcomes(Table):
    """A row for each rollout: outcomes["ball_x"] is float64 of shape (rollouts,)."""

    def mean(self, name: str) -> float:
        """The mean of a column."""
        return float(self[name].mean())

    def share(self, name: str) -> float:
        """The share of rollouts in which a number is above 0, such as "goals_left"."""
        return float((self[name] > 0.0).mean())


class Rollouts:
    """Rollouts of the robots of a scenario.

        rollouts = pitchboard.Rollouts("match")
        belief = rollouts.beginning()
        belief.game["ball_x"] = 3.0
        belief.robots[1].update(x=2.5, y=0.2, sigma=0.15)
        outcomes = rollouts.play(belief, count=500, seconds=10)
        outcomes.share("goals_left"), outcomes.mean("ball_x")

    scenario: a built-in name, the path of a file, or a scenario as a dictionary. tick_rate: ticks
    per second, a multiple of 10 up to 120. Results do not depend on the number of threads.
    """

    def __init__(
        self,
        scenario: Union[str, "os.PathLike[str]", Mapping[str, Any]] = "match",
        noise: Optional[str] = None,
        threads: int = 1,
        tick_rate: float = 20.0,
    ) -> None:
        self._handle: Optional[c_void_p] = None
        options = RolloutOptions()
        check(lib.pb_rollout_options_init(byref(options), ctypes.sizeof(options)))
        if isinstance(scenario, Mapping):
            options.text = json.dumps(scenario).encode()
        else:
            options.scenario = os.fsencode(os.fspath(scenario))
        options.noise = encoded(noise)
        options.threads, options.tick_rate = threads, tick_rate
        handle = c_void_p()
        check(lib.pb_rollouts_create(byref(options), byref(handle)))
        self._handle = handle
        count = c_int32()
        check(lib.pb_rollouts_robots(handle, byref(count)))
        #: The number of robots.
        self.robots: int = count.value
        self._robot_names = column_names(BELIEF_ROBOTS)
        self._game_names = column_names(BELIEF_GAME)
        self._outcome_names = column_names(OUTCOMES)

    def beginning(self) -> Belief:
        """The beginning of the scenario as a belief, which you may change."""
        robots = np.empty((self.robots, len(self._robot_names)))
        game = np.empty(len(self._game_names))
        check(
            lib.pb_rollouts_beginning(
                self._open(), address(robots), robots.size, address(game), game.size
            )
        )
        rows = [dict(zip(self._robot_names, row)) for row in robots.tolist()]
        return Belief(rows, dict(zip(self._game_names, game.tolist())))

    def play(
        self,
        belief: Belief,
        count: int = 500,
        seconds: float = 10.0,
        look: float = 5.0,
        seed: int = 1,
        go_on: bool = False,
    ) -> Outcomes:
        """Plays `count` rollouts of at most `seconds`, with the seeds seed, seed + 1, ...

        The columns look_x and look_y are the ball's position after `look` seconds. A goal or a ball
        that is out ends a rollout, unless go_on.
        """
        robots = np.array(
            [self._row("robot", row, self._robot_names) for row in belief.robots], dtype=np.float64
        )
        game = np.array(self._row("game", belief.game, self._game_names), dtype=np.float64)
        seeds = np.arange(seed, seed + count, dtype=np.uint64)
        outcomes = np.empty((count, len(self._outcome_names)))
        options = PlayOptions()
        check(lib.pb_play_options_init(byref(options), ctypes.sizeof(options)))
        options.seconds, options.look, options.go_on = seconds, look, int(go_on)
        check(
            lib.pb_rollouts_play(
                self._open(),
                byref(options),
                address(robots),
                robots.size,
                address(game),
                game.size,
                address(seeds),
                seeds.size,
                address(outcomes),
                outcomes.size,
            )
        )
        columns: Dict[str, npt.NDArray[Any]] = {
            name: outcomes[:, i] for i, name in enumerate(self._outcome_names)
        }
        return Outcomes(columns)

    def close(self) -> None:
        """Frees them. Later calls raise ClosedError; a second close() does nothing."""
        handle, self._handle = self._handle, None
        if handle is not None:
            check(lib.pb_rollouts_destroy(handle))

    def __del__(self) -> None:
        self.close()

    def __enter__(self) -> "Rollouts":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> NoReturn:
        refuse_pickle(self, "make them in the process that plays them.")

    def _open(self) -> c_void_p:
        if self._handle is None:
            raise ClosedError("These rollouts are closed.")
        return self._handle

    @staticmethod
    def _row(what: str, values: Mapping[str, float], names: List[str]) -> List[float]:
        for name in values:
            if name not in names:
                raise unknown_name(f"the belief of a {what} has no value", name, names)
        return [values.get(name, np.nan) for name in names]
