# SPDX-License-Identifier: GPL-3.0-or-later
"""Many simulated matches, stepped together: an environment for learning."""

import ctypes
import importlib
import json
import math
import os
from ctypes import byref, c_int32, c_void_p
from typing import (
    Any,
    Callable,
    Dict,
    Iterator,
    List,
    Mapping,
    NoReturn,
    Optional,
    Sequence,
    Tuple,
    Union,
)

import numpy as np
import numpy.typing as npt

from ._library import (
    ClosedError,
    Options,
    PitchboardError,
    Shape,
    address,
    check,
    column_names,
    encoded,
    lib,
    refuse_pickle,
    unknown_name,
)

Doubles = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

PERCEPTS, ROBOTS, GAME, COMMANDS = 0, 1, 2, 3
KEEP = -(2**31)
ALL = -1
#: Codes of DECISION_ACTION_A: 0 to 22 (docs/blackboard.md).
ACTIONS = 23
#: What a robot observes if nothing else is asked for: 1 = lost; cm; degrees, left positive; rad; code.
OBSERVE = ("VISION_LOST", "VISION_BALL_DIST", "VISION_BALL_ANGLE", "IMU_EULER_Z", "CONTROL_ACTION")
#: One blue robot and a ball: Worlds() without a scenario.
SCORING = {
    "version": 1,
    "name": "scoring",
    "ball": {"x": 3, "y": 0},
    "robots": [{"team": "blue", "number": 1, "x": -1, "y": 0, "heading": 0, "behaviour": "none"}],
    "stop": {"duration": 20, "goal": True, "ball_out": True},
}
_GOAL, _DURATION = 1, 3  # of the column "finished"


def _optional(module: str, name: str) -> Any:
    """A class of a package that need not be installed; else None."""
    try:
        return getattr(importlib.import_module(module), name, None)
    except ImportError:
        return None


class Box:
    """Numbers between bounds; as gymnasium.spaces.Box, which is used where it is installed."""

    def __init__(
        self, low: float, high: float, shape: Tuple[int, ...], dtype: Any = np.float64
    ) -> None:
        self.low = np.full(shape, low, dtype)
        self.high = np.full(shape, high, dtype)
        self.shape = shape
        self.dtype: "np.dtype[Any]" = np.dtype(dtype)
        self._random = np.random.default_rng()

    def seed(self, seed: Optional[int] = None) -> None:
        self._random = np.random.default_rng(seed)

    def sample(self) -> npt.NDArray[Any]:
        numbers: npt.NDArray[Any] = self._random.normal(size=self.shape)
        return np.clip(numbers, self.low, self.high).astype(self.dtype)

    def contains(self, x: Any) -> bool:
        x = np.asarray(x)
        return x.shape == self.shape and bool(np.all((x >= self.low) & (x <= self.high)))


class MultiDiscrete:
    """Whole numbers from 0; as gymnasium.spaces.MultiDiscrete, which is used where it is installed."""

    def __init__(self, nvec: npt.NDArray[Any]) -> None:
        self.nvec = np.asarray(nvec, dtype=np.int64)
        self.shape = self.nvec.shape
        self.dtype: "np.dtype[Any]" = np.dtype(np.int64)
        self._random = np.random.default_rng()

    def seed(self, seed: Optional[int] = None) -> None:
        self._random = np.random.default_rng(seed)

    def sample(self) -> npt.NDArray[np.int64]:
        return np.asarray(self._random.integers(self.nvec), dtype=np.int64)

    def contains(self, x: Any) -> bool:
        x = np.asarray(x)
        return x.shape == self.shape and bool(np.all((x >= 0) & (x < self.nvec)))


class Discrete(MultiDiscrete):
    """A whole number from 0; as gymnasium.spaces.Discrete, which is used where it is installed."""

    def __init__(self, n: int) -> None:
        super().__init__(np.array(n))
        self.n = n


def _box(shape: Tuple[int, ...]) -> Any:
    real = _optional("gymnasium.spaces", "Box")
    return (real or Box)(-math.inf, math.inf, shape, np.float64)


def _multi_discrete(shape: Tuple[int, ...]) -> Any:
    real = _optional("gymnasium.spaces", "MultiDiscrete")
    return (real or MultiDiscrete)(np.full(shape, ACTIONS))


def _discrete() -> Any:
    real = _optional("gymnasium.spaces", "Discrete")
    return (real or Discrete)(ACTIONS)


class Columns(Mapping[str, Doubles]):
    """An array whose last index has names: columns["ball_x"] is a view of array[..., i].

    NaN is a value that is unknown, such as a percept that the last tick did not write.
    """

    def __init__(self, names: Sequence[str], array: Doubles) -> None:
        #: float64, shape (worlds, columns) or (worlds, robots, columns).
        self.array = array
        self._places = {name: i for i, name in enumerate(names)}

    def __getitem__(self, name: str) -> Doubles:
        if name not in self._places:
            raise unknown_name("the array has no column", name, list(self._places))
        column: Doubles = self.array[..., self._places[name]]
        return column

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)

    def __repr__(self) -> str:
        return f"<Columns {self.array.shape}: {', '.join(self._places)}>"


class Snapshot:
    """The exact state of a world: Worlds.snapshot() makes it, Worlds.restore() uses it."""

    def __init__(self, handle: c_void_p) -> None:
        self._handle = handle

    def __del__(self) -> None:
        lib.pb_destroy_snapshot(self._handle)

    def __reduce__(self) -> NoReturn:
        refuse_pickle(self, "it belongs to this process.")


_VectorEnv: Any = _optional("gymnasium.vector", "VectorEnv") or object
_ParallelEnv: Any = _optional("pettingzoo", "ParallelEnv") or object
_AutoresetMode: Any = _optional("gymnasium.vector", "AutoresetMode")


class Worlds(_VectorEnv):  # type: ignore[misc]
    """Many worlds of a scenario, stepped together: a Gymnasium vector environment.

        worlds = pitchboard.Worlds(num_envs=256, seed=1)
        observations, infos = worlds.reset()
        observations, rewards, terminations, truncations, infos = worlds.step(actions)

    scenario    a built-in name, the path of a file, or a scenario as a dictionary
                (docs/scenarios.md). None: one robot that learns to bring the ball into the right
                goal, with ball and robot in new places at each beginning
    control     ids of the robots that the actions steer; None: all. The others are played by the
                behaviours of the scenario
    observe     variables of the blackboard that make up an observation
    reward      reward(worlds) -> rewards, shape (worlds,) or (worlds, controlled robots), after
                each step; it can read worlds.game and worlds.game_before. None: metres that the
                ball came nearer to the opponents' goal line; 10 for a goal in the step of the goal,
                -10 for one against. The first robot's team plays to the right
    begin       begin(worlds, which, random): places ball and robots of the worlds `which` (int32,
                shape (n,)) at the beginning of an episode; `random` is a numpy.random.Generator
    ticks_per_action   how long an action is held
    seed, threads, duration (s), noise, physics, particles   as in pitchboard_sim.h
    autoreset   True: a world that is over begins again in the same step
    copy        False: observations are views of memory that the next step overwrites

    With one controlled robot, observations have the shape (worlds, variables) and actions (worlds,);
    with several (worlds, robots, variables) and (worlds, robots). Observations are float64 in the
    units of the blackboard, actions are codes of DECISION_ACTION_A (0 to 22). Rewards are float64,
    terminations and truncations bool, all of shape (worlds,); with several robots a reward is the
    mean of theirs, and `robot_rewards` has each. Terminated: a goal, ball out or full time;
    truncated: the duration is over. If worlds are over, infos has "final_obs" (all observations of
    the step) and "_final_obs" (bool: whose are the last of an episode).

    Where worlds are chosen (`where`), None is all of them, and a mask (bool, shape (worlds,)) or
    different numbers of worlds (int, shape (n,)) some.

    The same seed gives the same bits on every computer and with any number of threads. Any thread
    may call, one at a time.
    """

    metadata: Dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(
        self,
        scenario: Union[None, str, "os.PathLike[str]", Mapping[str, Any]] = None,
        num_envs: int = 64,
        *,
        control: Optional[Sequence[int]] = None,
        observe: Sequence[str] = OBSERVE,
        reward: Optional[Callable[["Worlds"], Doubles]] = None,
        begin: Optional[Callable[["Worlds", npt.NDArray[np.int32], Any], None]] = None,
        ticks_per_action: int = 6,
        seed: int = 1,
        threads: int = 1,
        duration: float = 0.0,
        noise: Optional[str] = None,
        physics: Optional[str] = None,
        particles: int = 0,
        autoreset: bool = True,
        copy: bool = True,
    ) -> None:
        self._handle: Optional[c_void_p] = None
        self.closed = True
        options = Options()
        check(lib.pb_options_init(byref(options), ctypes.sizeof(options)))
        if scenario is None:
            begin = begin or scatter
            noise = noise or "paper"
            scenario = SCORING
        if isinstance(scenario, Mapping):
            options.text = json.dumps(scenario).encode()
        else:
            options.scenario = os.fsencode(os.fspath(scenario))
        options.worlds, options.threads = num_envs, threads
        options.has_seed, options.seed = 1, seed
        options.duration, options.particles = duration, particles
        options.noise, options.physics = encoded(noise), encoded(physics)
        handle = c_void_p()
        check(lib.pb_create(byref(options), byref(handle)))
        self._handle = handle
        self.closed = False

        shape = Shape(size=ctypes.sizeof(Shape))
        check(lib.pb_get_shape(handle, byref(shape)))
        self.num_envs: int = shape.worlds
        #: Ticks per simulated second.
        self.tick_rate: float = shape.tick_rate
        ids = np.empty(shape.robots, dtype=np.int32)
        check(lib.pb_robot_ids(handle, address(ids), len(ids)))
        #: Ids of all robots, in the order of arrays.
        self.robots: List[int] = ids.tolist()
        self.observe: Tuple[str, ...] = tuple(observe)
        self._numbers = self._variables(self.observe)
        self._numbers_address = address(self._numbers)
        self._names = [column_names(array) for array in (PERCEPTS, ROBOTS, GAME)]
        #: Ids of the robots that actions steer.
        self.control: List[int] = self._controlled(control)
        self._rows = self._rows_of(self.control)

        count, robots = self.num_envs, len(self.robots)
        self._seen = np.zeros((count, robots, len(self.observe)))
        self._seen_address = address(self._seen)
        self._actions = np.full((count, robots), KEEP, dtype=np.int32)
        self._actions_address = address(self._actions)
        #: Ball, clock and score after the last step, and before it (or at the beginning).
        self.game, self.game_before = (
            Columns(self._names[GAME], np.zeros((count, len(self._names[GAME])))) for _ in range(2)
        )
        #: float64, shape (worlds, controlled robots): rewards of the last step.
        self.robot_rewards: Doubles = np.zeros((count, len(self.control)))
        goals = self._names[GAME].index("score_left")
        assert self._names[GAME][goals : goals + 3] == ["score_left", "score_right", "ball_x"]
        self._scored = slice(goals, goals + 3)  # what progress() reads
        first = self.read("robots")["team"][0]
        self._direction = np.where(first == first[0], 1.0, -1.0)[self._rows]

        single = len(self.control) == 1
        inner: Tuple[int, ...] = () if single else (len(self.control),)
        self._single = single
        self.single_observation_space = _box((*inner, len(self.observe)))
        self.observation_space = _box((count, *inner, len(self.observe)))
        self.single_action_space = _discrete() if single else _multi_discrete(inner)
        self.action_space = _multi_discrete((count, *inner))
        if _AutoresetMode is not None:
            mode: Any = _AutoresetMode.SAME_STEP if autoreset else _AutoresetMode.DISABLED
        else:
            mode = "SameStep" if autoreset else "Disabled"
        self.metadata = {**type(self).metadata, "autoreset_mode": mode}

        self._reward = reward or progress
        self._begin = begin
        self._ticks = ticks_per_action
        self._autoreset = autoreset
        self._copy = copy
        self._next_seed = seed
        self._random = np.random.default_rng(seed)
        self._has_begun = False
        self._is_beginning = False  # then one look at the worlds follows

    # The environment.

    def reset(
        self,
        *,
        seed: Union[None, int, Sequence[Optional[int]]] = None,
        options: Optional[Mapping[str, Any]] = None,
    ) -> Tuple[Doubles, Dict[str, Any]]:
        """Begins episodes and returns (observations, {}).

        seed: world i begins with seed + i, or with seed[i] if it is a sequence (None in it: the
        next one). Without a seed every episode has the next one. options["reset_mask"] (bool, shape
        (worlds,)): only these worlds begin again.
        """
        mask = (options or {}).get("reset_mask")
        which = self._which(mask)
        seeds: Optional[npt.NDArray[np.uint64]] = None
        if isinstance(seed, (int, np.integer)):
            self._next_seed = int(seed)
            self._random = np.random.default_rng(int(seed))
        elif seed is not None:
            if len(seed) != self.num_envs:
                raise ValueError(f"A list of seeds needs {self.num_envs}, not {len(seed)}.")
            seeds = self._seeds(len(which))
            given = [seed[i] for i in which]
            for i, one in enumerate(given):
                if one is not None:
                    seeds[i] = one
            self._random = np.random.default_rng([0 if one is None else int(one) for one in given])
        self._start(which, seeds)
        self._has_begun = True
        return self._observations(), {}

    def step(
        self, actions: npt.ArrayLike
    ) -> Tuple[Doubles, Doubles, Mask, Mask, Dict[str, Any]]:
        """Holds the actions for `ticks_per_action` ticks; returns (observations, rewards,
        terminations, truncations, infos). The action KEEP (-2**31) keeps the one before."""
        if not self._has_begun:
            self._open()
            raise PitchboardError("Call reset() before step().")
        given = np.asarray(actions)
        if given.dtype.kind not in "iu":
            raise TypeError(f"Actions must be whole numbers, not {given.dtype}.")
        if given.shape != self.action_space.shape:
            raise ValueError(
                f"Actions must have the shape {self.action_space.shape}, not {given.shape}."
            )
        self._actions[:, self._rows] = given[:, np.newaxis] if self._single else given
        handle = self._open()
        check(lib.pb_write_actions(handle, self._actions_address, self._actions.size))
        check(lib.pb_step(handle, self._ticks))
        self.game, self.game_before = self.game_before, self.game
        self._look()

        rewards = np.asarray(self._reward(self), dtype=np.float64)
        if rewards.shape == self.robot_rewards.shape:
            self.robot_rewards = rewards
            rewards = rewards[:, 0] if self._single else rewards.mean(axis=1)
        elif rewards.shape == (self.num_envs,):
            self.robot_rewards = np.repeat(rewards[:, np.newaxis], len(self.control), axis=1)
        else:
            raise ValueError(
                f"reward() must return an array of shape {(self.num_envs,)} or "
                f"{self.robot_rewards.shape}, not {rewards.shape}."
            )
        finished = self.game["finished"]
        over = finished != 0.0
        infos: Dict[str, Any] = {}
        if over.any():
            truncations: Mask = finished == _DURATION
            terminations: Mask = over & ~truncations
            infos = {"final_obs": self._observations(True), "_final_obs": over}
            if self._autoreset:
                self._start(np.flatnonzero(over).astype(np.int32), None)
        else:
            terminations, truncations = over, over.copy()
        return self._observations(), rewards, terminations, truncations, infos

    def close(self, **_: Any) -> None:
        """Frees the worlds. Later calls raise ClosedError; a second close() does nothing."""
        handle, self._handle = getattr(self, "_handle", None), None
        self.closed = True
        if handle is not None:
            check(lib.pb_destroy(handle))

    def __del__(self) -> None:
        self.close()

    def __enter__(self) -> "Worlds":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> NoReturn:
        refuse_pickle(self, "make them in the process that steps them.")

    def __repr__(self) -> str:
        return f"<Worlds: {self.num_envs} of {len(self.robots)} robots, {self.control} controlled>"

    # The worlds themselves.

    def read(self, what: str) -> Columns:
        """Reads "percepts" (units of the blackboard) or "robots" (the truth: m, s, rad), shape
        (worlds, robots, columns), or "game", shape (worlds, columns)."""
        arrays = ["percepts", "robots", "game"]
        if what not in arrays:
            raise unknown_name("there is no array", what, arrays)
        array = arrays.index(what)
        names = self._names[array]
        robots = [] if array == GAME else [len(self.robots)]
        out = np.empty((self.num_envs, *robots, len(names)))
        check(lib.pb_read(self._open(), array, address(out), out.size))
        return Columns(names, out)

    def variables(self, names: Sequence[str]) -> Columns:
        """Reads variables of the blackboards: float64, shape (worlds, robots, variables)."""
        numbers = self._variables(names)
        out = np.empty((self.num_envs, len(self.robots), len(names)))
        check(
            lib.pb_read_variables(
                self._open(), address(numbers), len(numbers), address(out), out.size
            )
        )
        return Columns(names, out)

    def set_variables(self, values: Mapping[str, npt.ArrayLike], where: Any = None) -> None:
        """Writes variables of the blackboards of the worlds `where`. A value is anything that fits
        the shape (n, robots) for n worlds; NaN keeps what is there."""
        numbers = self._variables(list(values))
        new = np.full((self.num_envs, len(self.robots), len(values)), np.nan)
        which = self._which(where)
        for i, value in enumerate(values.values()):
            new[which, :, i] = value
        check(
            lib.pb_write_variables(
                self._open(), address(numbers), len(numbers), address(new), new.size
            )
        )

    def write_commands(self, commands: npt.ArrayLike) -> None:
        """Writes all commands of all robots: int32, shape (worlds, robots, 6); the columns are
        Worlds.command_names(). KEEP (-2**31) keeps a value."""
        new = np.ascontiguousarray(commands, dtype=np.int32)
        check(lib.pb_write_commands(self._open(), address(new), new.size))

    @staticmethod
    def command_names() -> List[str]:
        """The columns of write_commands()."""
        return column_names(COMMANDS)

    def advance(self, ticks: int) -> None:
        """Advances all worlds by ticks, with the actions that they have; nothing begins again."""
        check(lib.pb_step(self._open(), ticks))
        self._look()

    def place_ball(
        self, position: npt.ArrayLike, velocity: npt.ArrayLike = (0.0, 0.0), where: Any = None
    ) -> None:
        """Places the ball of the worlds `where`: x and y in m, velocity in m/s; shape (2,), or
        (n, 2) for n worlds."""
        which = self._which(where)
        balls = np.empty((len(which), 4))
        balls[:, :2], balls[:, 2:] = position, velocity
        check(lib.pb_place_balls(self._open(), address(which), len(which), address(balls)))
        self._look()

    def place_robot(self, robot: int, pose: npt.ArrayLike, where: Any = None) -> None:
        """Places a robot (its id) in the worlds `where`: x and y in m, yaw in rad; shape (3,), or
        (n, 3) for n worlds."""
        which = self._which(where)
        poses = np.empty((len(which), 3))
        poses[:] = pose
        check(
            lib.pb_place_robots(self._open(), address(which), len(which), robot, address(poses))
        )
        self._look()

    def snapshot(self, world: int = 0) -> Snapshot:
        """Saves the exact state of a world with its blackboards."""
        handle = c_void_p()
        check(lib.pb_take_snapshot(self._open(), world, byref(handle)))
        return Snapshot(handle)

    def restore(
        self, snapshot: Snapshot, where: Any = None, seeds: Optional[npt.ArrayLike] = None
    ) -> Doubles:
        """Puts a snapshot into the worlds `where` and returns the observations. Without seeds they
        all continue as the saved world would; with seeds (uint64, shape (n,) for n worlds) each
        continues with noise of its own."""
        which = self._which(where)
        if seeds is None:
            for world in which.tolist():
                check(lib.pb_restore(self._open(), world, snapshot._handle))
        else:
            own = np.ascontiguousarray(seeds, dtype=np.uint64)
            if own.shape != which.shape:
                raise ValueError(f"{len(which)} worlds need as many seeds, not {own.shape}.")
            check(
                lib.pb_restore_seeded(
                    self._open(), address(which), address(own), len(which), snapshot._handle
                )
            )
        self._look()
        self._has_begun = True
        return self._observations()

    def hashes(self) -> npt.NDArray[np.uint64]:
        """A hash of each world's state: uint64, shape (worlds,). Equal states have equal hashes."""
        out = np.empty(self.num_envs, dtype=np.uint64)
        check(lib.pb_read_hashes(self._open(), address(out), len(out)))
        return out

    # How it works.

    def _open(self) -> c_void_p:
        if self._handle is None:
            raise ClosedError("These worlds are closed.")
        return self._handle

    def _which(self, where: Any) -> npt.NDArray[np.int32]:
        """The numbers of the worlds that are meant."""
        if where is None:
            return np.arange(self.num_envs, dtype=np.int32)
        chosen = np.asarray(where)
        if chosen.dtype == np.bool_ and chosen.shape == (self.num_envs,):
            return np.flatnonzero(chosen).astype(np.int32)
        if chosen.dtype.kind not in "iu" or chosen.ndim != 1:
            raise ValueError(
                f"Worlds are chosen by a mask (bool, shape {(self.num_envs,)}) or by their numbers, "
                f"not by {chosen.dtype} of shape {chosen.shape}."
            )
        return np.ascontiguousarray(chosen, dtype=np.int32)

    def _variables(self, names: Sequence[str]) -> npt.NDArray[np.int32]:
        numbers = []
        for name in names:
            number = c_int32()
            check(lib.pb_find_variable(name.encode(), byref(number)))
            numbers.append(number.value)
        return np.array(numbers, dtype=np.int32)

    def _controlled(self, control: Optional[Sequence[int]]) -> List[int]:
        chosen = list(self.robots if control is None else control)
        for robot in chosen:
            if robot not in self.robots:
                raise unknown_name("the scenario has no robot", robot, [str(one) for one in self.robots])
        if not chosen or len(set(chosen)) != len(chosen):
            raise ValueError("`control` must be different ids of robots, at least one.")
        for robot in chosen:
            check(lib.pb_set_behaviour(self._open(), robot, b"none"))
        return chosen

    def _rows_of(self, robots: Sequence[int]) -> Any:
        """The rows of these robots in arrays; a slice if it can be one, because it needs no copy."""
        rows = [self.robots.index(robot) for robot in robots]
        if rows == list(range(rows[0], rows[0] + len(rows))):
            return slice(rows[0], rows[0] + len(rows))
        return rows

    def _seeds(self, count: int) -> npt.NDArray[np.uint64]:
        seeds = np.arange(self._next_seed, self._next_seed + count, dtype=np.uint64)
        self._next_seed += count
        return seeds

    def _start(
        self, which: npt.NDArray[np.int32], seeds: Optional[npt.NDArray[np.uint64]]
    ) -> None:
        seeds = self._seeds(len(which)) if seeds is None else seeds
        check(lib.pb_reset_some(self._open(), address(which), address(seeds), len(which)))
        if self._begin is not None and len(which) > 0:
            self._is_beginning = True
            try:
                self._begin(self, which, self._random)
            finally:
                self._is_beginning = False
        self._look()
        self.game_before.array[which] = self.game.array[which]

    def _look(self) -> None:
        if self._is_beginning:
            return
        handle = self._open()
        check(
            lib.pb_read_variables(
                handle,
                self._numbers_address,
                self._numbers.size,
                self._seen_address,
                self._seen.size,
            )
        )
        game = self.game.array
        check(lib.pb_read(handle, GAME, address(game), game.size))

    def _observations(self, copy: bool = False) -> Doubles:
        seen: Doubles = self._seen[:, self._rows]
        if self._single:
            seen = seen[:, 0]
        return seen.copy() if copy or self._copy else seen


def progress(worlds: Worlds) -> Doubles:
    """The reward of Worlds without a `reward`; shape (worlds, controlled robots)."""
    change = worlds.game.array[:, worlds._scored] - worlds.game_before.array[:, worlds._scored]
    rewards = change[:, 2]
    if change[:, :2].any():
        scored = change[:, 0] - change[:, 1]
        rewards = np.where(scored != 0.0, 10.0 * scored, rewards)
    rewards_of_robots: Doubles = rewards[:, np.newaxis] * worlds._direction
    return rewards_of_robots


def scatter(worlds: Worlds, which: npt.NDArray[np.int32], random: Any) -> None:
    """The beginning of Worlds without a `scenario`: the ball in front of the right goal, and the
    robot behind it, near enough to see it."""
    drawn = random.random((len(which), 5))
    ball = (2.5, -1.0) + drawn[:, :2] * (1.0, 2.0)
    pose = np.empty((len(which), 3))
    pose[:] = (-2.0, -0.5, -0.5) + drawn[:, 2:] * (1.5, 1.0, 1.0)
    pose[:, :2] += ball
    worlds.place_ball(ball, where=which)
    worlds.place_robot(1, pose, which)
    worlds.set_variables({"VISION_LOST": 1.0}, which)  # nothing has been seen yet


class ParallelWorlds(_ParallelEnv):  # type: ignore[misc]
    """One world with an agent for each controlled robot: a PettingZoo parallel environment.

        world = pitchboard.ParallelWorlds("match-3v3", control=[1, 2, 3])
        observations, infos = world.reset(seed=1)
        observations, rewards, terminations, truncations, infos = world.step({"1": 2, "2": 2})

    Takes the arguments of Worlds but num_envs. An agent has the robot's id as text. Observations
    are float64 of shape (variables,), an action is a code of DECISION_ACTION_A; an agent without
    one keeps the action before. All agents end together; then `agents` is empty until reset().
    """

    metadata: Dict[str, Any] = {"name": "pitchboard", "render_modes": [], "is_parallelizable": True}
    render_mode = None

    def __init__(
        self,
        scenario: Union[None, str, "os.PathLike[str]", Mapping[str, Any]] = None,
        **options: Any,
    ) -> None:
        #: The one world; its methods place, read and save it.
        self.worlds = Worlds(scenario, 1, autoreset=False, **options)
        self.possible_agents: List[str] = [str(robot) for robot in self.worlds.control]
        self.agents: List[str] = []
        self.observation_spaces = {
            agent: _box((len(self.worlds.observe),)) for agent in self.possible_agents
        }
        self.action_spaces = {agent: _discrete() for agent in self.possible_agents}

    def observation_space(self, agent: str) -> Any:
        """The space of an agent's observations."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        """The space of an agent's actions."""
        return self.action_spaces[agent]

    @property
    def num_agents(self) -> int:
        """How many agents play; 0 when the episode is over."""
        return len(self.agents)

    @property
    def max_num_agents(self) -> int:
        """How many agents play at the beginning of an episode."""
        return len(self.possible_agents)

    @property
    def unwrapped(self) -> "ParallelWorlds":
        """This environment."""
        return self

    def reset(
        self, seed: Optional[int] = None, options: Optional[Mapping[str, Any]] = None
    ) -> Tuple[Dict[str, Doubles], Dict[str, Dict[str, Any]]]:
        """Begins an episode; returns ({agent: observation}, {agent: {}})."""
        del options
        observations, _ = self.worlds.reset(seed=seed)
        self.agents = list(self.possible_agents)
        return self._each(observations), {agent: {} for agent in self.agents}

    def step(self, actions: Mapping[str, Any]) -> Tuple[
        Dict[str, Doubles],
        Dict[str, float],
        Dict[str, bool],
        Dict[str, bool],
        Dict[str, Dict[str, Any]],
    ]:
        """Steps the world; returns observations, rewards, terminations, truncations and infos by
        agent."""
        if not self.agents:
            raise PitchboardError("The episode is over or has not begun; call reset().")
        for agent in actions:
            if agent not in self.agents:
                raise unknown_name("there is no agent", agent, self.agents)
        given = np.array([int(actions.get(agent, KEEP)) for agent in self.agents])
        shape = self.worlds.action_space.shape
        observations, _, terminations, truncations, _ = self.worlds.step(given.reshape(shape))
        agents = self.agents
        rewards = dict(zip(agents, self.worlds.robot_rewards[0].tolist()))
        over, cut = bool(terminations[0]), bool(truncations[0])
        if over or cut:
            self.agents = []
        return (
            self._each(observations),
            rewards,
            {agent: over for agent in agents},
            {agent: cut for agent in agents},
            {agent: {} for agent in agents},
        )

    def close(self) -> None:
        """Frees the world."""
        self.worlds.close()

    def _each(self, observations: Doubles) -> Dict[str, Doubles]:
        rows = observations.reshape(len(self.possible_agents), -1)
        return {agent: rows[i].copy() for i, agent in enumerate(self.possible_agents)}
