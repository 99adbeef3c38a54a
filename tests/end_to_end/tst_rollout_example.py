#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The example for rollouts in docs/examples: tst_rollout_example.py EXAMPLE.py LIBRARY.so"""

import importlib.util
import json
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True  # nothing into the folder of the example
example_path, library = sys.argv[1:3]
specification = importlib.util.spec_from_file_location("pitchboard_rollout", example_path)
example = importlib.util.module_from_spec(specification)
specification.loader.exec_module(example)


def play(*arguments):
    command = [sys.executable, example_path, "--library", library, *arguments]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


class TestRolloutExample(unittest.TestCase):
    def test_threads_do_not_matter(self):
        alone, together = play("--count", "40"), play("--count", "40", "--threads", "3")
        for key in ("rollouts", "goal_left", "goal_right", "mean_ball_x"):
            self.assertEqual(alone[key], together[key], key)

    def test_a_ball_on_its_way_into_the_goal(self):
        rollouts = example.Rollouts("match", library=library)
        belief = rollouts.beginning()
        self.assertEqual(len(belief.robots), 8)
        belief.game.update(ball_x=4.2, ball_y=0.9, ball_vx=3.0)
        outcomes = rollouts.play(belief, count=20, seconds=2)
        self.assertEqual(len(outcomes.column("seed")), 20)
        self.assertGreater(outcomes.share("goals_left"), 0.5)
        self.assertEqual(outcomes.share("goals_right"), 0.0)
        rollouts.close()

    def test_a_refusal_is_an_exception_with_its_sentence(self):
        with self.assertRaisesRegex(example.PitchboardError, "no-such"):
            example.Rollouts("no-such", library=library)
        rollouts = example.Rollouts("match", library=library)
        belief = rollouts.beginning()
        belief.game["state"] = 17
        with self.assertRaisesRegex(example.PitchboardError, "state"):
            rollouts.play(belief, count=1)


unittest.main(argv=sys.argv[:1])
