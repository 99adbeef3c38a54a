#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The example for learning in docs/examples: tst_learning_example.py EXAMPLE.py LIBRARY.so"""

import importlib.util
import json
import math
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True  # nothing into the folder of the example
example_path, library = sys.argv[1:3]
specification = importlib.util.spec_from_file_location("pitchboard_env", example_path)
example = importlib.util.module_from_spec(specification)
specification.loader.exec_module(example)

WITHOUT_NUMPY = """
import runpy, sys
sys.modules["numpy"] = None
sys.argv = sys.argv[1:]
runpy.run_path(sys.argv[0], run_name="__main__")
"""


def make(**options):
    return example.ScoringEnv(library=library, **options)


def play(*arguments, without_numpy=False):
    command = [sys.executable]
    if without_numpy:
        command += ["-c", WITHOUT_NUMPY]
    command += [example_path, "--library", library, *arguments]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


class TestLearningExample(unittest.TestCase):
    def test_a_thousand_episodes(self):
        played = play("--episodes", "1000", "--threads", "2")
        self.assertGreaterEqual(played["episodes"], 1000)
        self.assertGreater(played["goals"], 0)
        self.assertLess(played["goals"], played["episodes"])
        alone = play("--episodes", "1000", without_numpy=True)
        self.assertFalse(alone["numpy"])
        for key in ("episodes", "goals", "mean_reward", "steps", "last_hash"):
            self.assertEqual(alone[key], played[key], key)

    def test_a_seed_repeats_and_another_does_not(self):
        env = make(num_envs=3)
        runs = []
        for seed in (5, 5, 6):
            env.reset(seed=seed)
            for k in range(40):
                env.step([1, 2, k % 9])
            runs.append(env.hashes())
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])
        self.assertEqual(len(set(runs[0])), 3)
        env.close()
        env.close()

    def test_observations_lie_in_their_space(self):
        env = make(num_envs=2, seed=3)
        observations, _ = env.reset()
        self.assertEqual(observations[0, 0], 1.0)
        sighted = 0
        for _ in range(100):
            observations, *_ = env.step([2, 3])
            for i in range(2):
                row = [observations[i, k] for k in range(5)]
                self.assertTrue(env.single_observation_space.contains(row), row)
                sighted += row[0] == 0.0
        self.assertGreater(sighted, 0)

    def test_an_episode_that_is_over_begins_anew_in_the_same_step(self):
        env = make(num_envs=2, seed=1, seconds=1.0)
        env.reset()
        for step in range(1, 31):
            _, _, terminations, truncations, infos = env.step([0, 0])
            self.assertEqual(list(truncations), [step % 10 == 0] * 2)
            self.assertEqual(list(terminations), [False, False])
            self.assertEqual("final_obs" in infos, step % 10 == 0)

    def test_a_goal_is_rewarded(self):
        env = make(num_envs=1, seed=1)
        env.reset()
        env._api.place_ball(env._worlds, 0, 3.0, 0.0, 6.0, 0.0)
        env._balls[0] = 3.0
        rewards, over = [], False
        while not over:
            _, reward, terminations, _, _ = env.step([0])
            rewards.append(float(reward[0]))
            over = terminations[0]
        # Some of the 1.5 m to the goal line before the step with the goal, which gives ten.
        self.assertEqual(rewards[-1], 10.0)
        self.assertGreater(sum(rewards), 10.3)
        self.assertLess(sum(rewards), 11.5)

    def test_the_memory_is_shared(self):
        env = make(num_envs=2, seed=1)
        observations, _ = env.reset()
        self.assertEqual(observations[1, 0], 1.0)
        for _ in range(50):
            env.actions[1] = 2
            env.step(env.actions)
        self.assertEqual(observations[1, 4], 2.0)  # CONTROL_ACTION, in the array of the beginning
        env._observation_memory[0] = 0.25
        self.assertEqual(observations[0, 0], 0.25)
        if example.numpy is not None:
            self.assertIsInstance(observations, example.numpy.ndarray)
            self.assertFalse(observations.flags.owndata)

    def test_a_refusal_is_an_exception_with_its_sentence(self):
        with self.assertRaisesRegex(example.PitchboardError, "noise"):
            make(num_envs=1, noise="loud")
        with self.assertRaisesRegex(example.PitchboardError, "worlds"):
            make(num_envs=0)
        env = make(num_envs=1)
        env.close()
        with self.assertRaises(example.PitchboardError):
            env.reset()

    def test_the_rule_of_the_example(self):
        self.assertEqual(example.chase([1, 100, 0]), example.LEFT)
        self.assertEqual(example.chase([0, 100, -20]), example.RIGHT)
        self.assertEqual(example.chase([0, 100, math.pi]), example.FORWARD)
        self.assertEqual(example.chase([0, 15, 0]), example.KICK)


unittest.main(argv=sys.argv[:1])
