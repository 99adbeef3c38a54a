#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Worlds and rollouts in Python: tst_python_worlds.py"""

import copy
import inspect
import math
import pickle
import sys
import threading
import unittest

import numpy as np

import pitchboard
from pitchboard.worlds import KEEP


def chase(observations):
    """Turns to the ball, walks to it and kicks."""
    lost, distance_cm, angle_deg = observations[:, 0], observations[:, 1], observations[:, 2]
    return np.where((lost > 0) | (angle_deg > 12), 2,
                    np.where(angle_deg < -12, 3, np.where(distance_cm < 22, 4, 1)))


class TestPythonWorlds(unittest.TestCase):
    def test_a_thousand_episodes(self):
        results = []
        for threads in (1, 3):
            with pitchboard.Worlds(num_envs=64, seed=1, threads=threads) as worlds:
                observations, _ = worlds.reset()
                episodes = goals = 0
                while episodes < 1000:
                    observations, rewards, terminations, truncations, _ = worlds.step(chase(observations))
                    episodes += int((terminations | truncations).sum())
                    goals += int((rewards > 5.0).sum())
                self.assertTrue(0 < goals < episodes)
                results.append((episodes, goals, worlds.hashes().tolist()))
        self.assertEqual(results[0], results[1])

    def test_a_seed_repeats_and_another_does_not(self):
        with pitchboard.Worlds(num_envs=3) as worlds:
            runs = []
            for seed in (5, 5, 6):
                worlds.reset(seed=seed)
                for k in range(40):
                    worlds.step([1, 2, k % 9])
                runs.append(worlds.hashes().tolist())
            self.assertEqual(runs[0], runs[1])
            self.assertNotEqual(runs[0], runs[2])
            self.assertEqual(len(set(runs[0])), 3)

    def test_the_shape_of_a_vector_environment(self):
        """What gymnasium.vector.VectorEnv has, and what its wrappers and learners use."""
        with pitchboard.Worlds(num_envs=4, seed=2) as worlds:
            parameters = inspect.signature(worlds.reset).parameters
            self.assertEqual([p.kind for p in parameters.values()], [inspect.Parameter.KEYWORD_ONLY] * 2)
            self.assertEqual(list(parameters), ["seed", "options"])
            for name in ("num_envs", "observation_space", "action_space", "single_observation_space",
                         "single_action_space", "metadata", "render_mode", "closed"):
                self.assertTrue(hasattr(worlds, name), name)
            observations, infos = worlds.reset(seed=3, options=None)
            self.assertEqual((observations.shape, observations.dtype, infos), ((4, 5), np.float64, {}))
            self.assertEqual(worlds.observation_space.shape, (4, *worlds.single_observation_space.shape))
            self.assertEqual(worlds.single_action_space.n, 23)
            for _ in range(50):
                actions = worlds.action_space.sample()
                self.assertTrue(worlds.action_space.contains(actions))
                observations, rewards, terminations, truncations, infos = worlds.step(actions)
                self.assertTrue(worlds.observation_space.contains(observations))
                for array, dtype in ((rewards, np.float64), (terminations, np.bool_), (truncations, np.bool_)):
                    self.assertEqual((array.shape, array.dtype), ((4,), dtype))
                self.assertIsInstance(infos, dict)
            try:
                from gymnasium.vector import VectorEnv
                self.assertIsInstance(worlds, VectorEnv)
            except ImportError:
                self.assertIn(worlds.metadata["autoreset_mode"], ("SameStep",))

    def test_an_episode_that_is_over_begins_anew_in_the_same_step(self):
        for autoreset in (True, False):
            worlds = pitchboard.Worlds(num_envs=2, duration=1.0, autoreset=autoreset)
            worlds.reset()
            for step in range(1, 21):
                _, _, terminations, truncations, infos = worlds.step([0, 0])
                over = step % 10 == 0 if autoreset else step >= 10
                self.assertEqual(truncations.tolist(), [over] * 2)
                self.assertEqual(terminations.tolist(), [False, False])
                self.assertEqual("final_obs" in infos, over)
                if over:
                    self.assertEqual(infos["_final_obs"].tolist(), [True, True])
                    self.assertEqual(infos["final_obs"].shape, (2, 5))
            worlds.close()

    def test_reset_by_mask(self):
        worlds = pitchboard.Worlds(num_envs=3, seed=1)
        worlds.reset(seed=1)
        for _ in range(5):
            worlds.step([1, 1, 1])
        before = worlds.hashes()
        mask = np.array([False, True, False])
        worlds.reset(options={"reset_mask": mask})
        self.assertEqual((worlds.hashes() != before).tolist(), mask.tolist())
        alone = worlds.hashes()[1]
        worlds.reset(seed=[None, 4, None], options={"reset_mask": mask})
        worlds.reset(seed=[None, 4, None], options={"reset_mask": mask})
        self.assertNotEqual(worlds.hashes()[1], alone)
        for wrong in ([True, False], [0.5, 1.0, 0.0]):
            with self.assertRaises(ValueError):
                worlds.reset(options={"reset_mask": wrong})
        worlds.close()

    def test_a_goal_is_rewarded(self):
        worlds = pitchboard.Worlds(num_envs=1)
        worlds.reset()
        worlds.place_ball((3.0, 0.0), (6.0, 0.0))
        rewards, over = [], False
        while not over:
            _, reward, terminations, _, _ = worlds.step([0])
            rewards.append(float(reward[0]))
            over = bool(terminations[0])
        # Some of the 1.5 m to the goal line before the step with the goal, which gives ten.
        self.assertEqual(rewards[-1], 10.0)
        self.assertTrue(10.3 < sum(rewards) < 11.5, rewards)
        worlds.close()

    def test_own_rewards_and_beginnings(self):
        began = []

        def begin(worlds, which, random):
            began.append(which.tolist())
            worlds.place_ball((1.0, 0.5), where=which)

        worlds = pitchboard.Worlds("one-robot", 3, begin=begin, reward=lambda w: w.game["ball_x"])
        worlds.reset()
        self.assertEqual(began, [[0, 1, 2]])
        _, rewards, *_ = worlds.step([0, 0, 0])
        np.testing.assert_allclose(rewards, 1.0, atol=0.05)
        wrong = pitchboard.Worlds(num_envs=3, reward=lambda w: np.zeros(2))
        wrong.reset()
        with self.assertRaisesRegex(ValueError, "shape"):
            wrong.step([0, 0, 0])

    def test_memory_is_copied_unless_asked(self):
        for copied in (True, False):
            worlds = pitchboard.Worlds(num_envs=2, copy=copied)
            observations, _ = worlds.reset()
            before = observations.copy()
            for _ in range(50):
                worlds.step([1, 2])
            self.assertEqual(np.array_equal(observations, before), copied)
            worlds.close()

    def test_arrays_of_the_library(self):
        worlds = pitchboard.Worlds("match-3v3", 2, control=[1, 2])
        observations, _ = worlds.reset()
        self.assertEqual(observations.shape, (2, 2, 5))
        robots, game, percepts = (worlds.read(what) for what in ("robots", "game", "percepts"))
        self.assertEqual(robots["id"][0].tolist(), worlds.robots)
        self.assertEqual(percepts.array.shape[:2], (2, 6))
        self.assertEqual(game["ball_x"].shape, (2,))
        worlds.place_robot(2, [[-1.0, 0.5, 0.1], [-2.0, 0.25, 0.2]])
        self.assertEqual(worlds.read("robots")["x"][:, 1].tolist(), [-1.0, -2.0])
        worlds.set_variables({"DECISION_ACTION_A": [[1.0] + [math.nan] * 5]}, where=[1])
        written = worlds.variables(["DECISION_ACTION_A"])["DECISION_ACTION_A"]
        self.assertEqual(written[1, 0], 1.0)
        commands = np.full((2, 6, len(worlds.command_names())), KEEP)
        worlds.write_commands(commands)
        worlds.advance(6)
        self.assertEqual(worlds.game["tick"].tolist(), [6.0, 6.0])
        worlds.step([[1, 2], [3, 1]])
        written = worlds.variables(["DECISION_ACTION_A"])["DECISION_ACTION_A"]
        self.assertEqual(written[:, :2].tolist(), [[1.0, 2.0], [3.0, 1.0]])
        worlds.close()

    def test_snapshots(self):
        worlds = pitchboard.Worlds(num_envs=3, seed=9)
        worlds.reset()
        for _ in range(10):
            worlds.step([1, 1, 1])
        saved, snapshot = worlds.hashes(), worlds.snapshot(1)
        for _ in range(10):
            worlds.step([2, 2, 2])
        later = worlds.hashes()[1]
        worlds.restore(snapshot)
        self.assertEqual(worlds.hashes().tolist(), [saved[1]] * 3)
        for _ in range(10):
            worlds.step([2, 2, 2])
        self.assertEqual(worlds.hashes().tolist(), [later] * 3)
        worlds.restore(snapshot, [True, True, False], seeds=[1, 2])
        for _ in range(10):
            worlds.step([2, 2, 2])
        self.assertEqual(len(set(worlds.hashes().tolist())), 3)
        with self.assertRaises(ValueError):
            worlds.restore(snapshot, seeds=[1, 2])
        worlds.close()

    def test_the_shape_of_a_parallel_environment(self):
        """What PettingZoo's parallel_api_test() asks for."""
        world = pitchboard.ParallelWorlds("match-3v3", control=[1, 2, 3], duration=1.0)
        self.assertEqual(world.possible_agents, ["1", "2", "3"])
        self.assertIs(world.unwrapped, world)
        for agent in world.possible_agents:
            self.assertIs(world.observation_space(agent), world.observation_space(agent))
            self.assertIs(world.action_space(agent), world.action_space(agent))
        for attempt in range(2):
            observations, infos = world.reset(seed=attempt)
            self.assertEqual(world.agents, world.possible_agents)
            self.assertIsNot(world.agents, world.possible_agents)
            self.assertEqual(set(observations), set(world.agents))
            self.assertEqual(set(infos), set(world.agents))
            steps = 0
            while world.agents:
                agents = list(world.agents)
                results = world.step({agent: world.action_space(agent).sample() for agent in agents})
                for part in results:
                    self.assertEqual(set(part), set(agents))
                for agent in agents:
                    self.assertTrue(world.observation_space(agent).contains(results[0][agent]))
                    self.assertIsInstance(results[2][agent], bool)
                steps += 1
            self.assertEqual(steps, 10)
            self.assertTrue(all(results[3].values()))
            with self.assertRaisesRegex(pitchboard.PitchboardError, "reset"):
                world.step({})
        world.reset()
        with self.assertRaises(pitchboard.NotFoundError):
            world.step({"4": 1})
        try:
            from pettingzoo.test import parallel_api_test
            parallel_api_test(world, num_cycles=30)
        except ImportError:
            pass
        world.close()

    def test_each_team_is_rewarded_for_its_goal(self):
        scenario = {"version": 1, "name": "two", "ball": {"x": 3, "y": 0}, "robots": [
            {"team": "blue", "number": 1, "x": -1, "y": 2, "heading": 0},
            {"team": "red", "number": 1, "x": -2, "y": -2, "heading": 0}], "stop": {"goal": True}}
        world = pitchboard.ParallelWorlds(scenario)
        world.reset(seed=1)
        world.worlds.place_ball((3.0, 0.0), (6.0, 0.0))
        last = {}
        while world.agents:
            last = world.step({agent: 0 for agent in world.agents})[1]
        self.assertEqual(sorted(last.values()), [-10.0, 10.0])
        world.close()

    def test_wrong_calls_are_refused(self):
        for options, words in (({"noise": "loud"}, "loud"), ({"num_envs": 0}, "worlds"),
                               ({"scenario": "no-such"}, "no-such"), ({"control": [9]}, "9"),
                               ({"observe": ["VISION_LOSS"]}, "VISION_LOST")):
            with self.assertRaisesRegex(pitchboard.PitchboardError, words):
                pitchboard.Worlds(**options)
        worlds = pitchboard.Worlds(num_envs=2)
        with self.assertRaisesRegex(pitchboard.PitchboardError, "reset"):
            worlds.step([0, 0])
        worlds.reset()
        for actions, error in (([0], ValueError), ([[0, 0]], ValueError), ([0.5, 1.0], TypeError)):
            with self.assertRaises(error):
                worlds.step(actions)
        with self.assertRaisesRegex(pitchboard.NotFoundError, "ball_x"):
            worlds.game["ballx"]
        for thing in (worlds, worlds.snapshot()):
            for refused in (pickle.dumps, copy.copy):
                with self.assertRaisesRegex(TypeError, "pickle"):
                    refused(thing)
        worlds.close()
        worlds.close()
        for use in (worlds.reset, worlds.hashes, lambda: worlds.step([0, 0]), worlds.snapshot):
            with self.assertRaises(pitchboard.ClosedError):
                use()

    def test_worlds_of_several_threads(self):
        hashes = [None] * 4

        def play(i):
            with pitchboard.Worlds(num_envs=8, seed=3) as worlds:
                worlds.reset()
                for _ in range(30):
                    worlds.step(np.ones(8, dtype=np.int32))
                hashes[i] = worlds.hashes().tolist()

        threads = [threading.Thread(target=play, args=(i,)) for i in range(len(hashes))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertIsNotNone(hashes[0])
        self.assertEqual(hashes, [hashes[0]] * 4)

    def test_rollouts(self):
        results = []
        for threads in (1, 3):
            with pitchboard.Rollouts("match", threads=threads) as rollouts:
                belief = rollouts.beginning()
                self.assertEqual((rollouts.robots, len(belief.robots)), (8, 8))
                belief.game.update(ball_x=4.2, ball_y=0.9, ball_vx=3.0)
                outcomes = rollouts.play(belief, count=20, seconds=2)
                self.assertEqual(outcomes["seed"].shape, (20,))
                self.assertGreater(outcomes.share("goals_left"), 0.5)
                self.assertEqual(outcomes.share("goals_right"), 0.0)
                results.append({name: outcomes[name].tolist() for name in outcomes})
        np.testing.assert_equal(results[0], results[1])
        with self.assertRaises(pitchboard.ClosedError):
            rollouts.beginning()
        rollouts = pitchboard.Rollouts("match")
        belief = rollouts.beginning()
        belief.game["state"] = 17
        with self.assertRaisesRegex(pitchboard.PitchboardError, "state"):
            rollouts.play(belief, count=1)
        belief.game["bal_x"] = 1
        with self.assertRaisesRegex(pitchboard.NotFoundError, "ball_x"):
            rollouts.play(belief, count=1)
        with self.assertRaisesRegex(pitchboard.PitchboardError, "no-such"):
            pitchboard.Rollouts("no-such")


unittest.main(argv=sys.argv[:1])
