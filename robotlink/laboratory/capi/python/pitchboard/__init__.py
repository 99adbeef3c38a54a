# SPDX-License-Identifier: GPL-3.0-or-later
"""Pitchboard in Python: recordings, simulated worlds and experiments of humanoid soccer robots.

    import pitchboard

    session = pitchboard.open("match.mcap")            # a recording: Session
    ball = session["B1"]["VISION_BALL_DIST"]           # ball.time in s, ball.values in ball.unit
    table = pitchboard.statistics(session[10:20], "BELIEF_ERROR")    # means with intervals: Table
    worlds = pitchboard.Worlds(num_envs=256)           # a Gymnasium vector environment
    result = pitchboard.experiment("paper-scenario-1", runs=10)

Arrays are numpy arrays. Whatever Pitchboard refuses is a PitchboardError with its sentence. pandas,
Gymnasium and PettingZoo are used where they are installed; none of them is needed.
"""

from ._library import ClosedError, NotFoundError, PitchboardError, version
from .experiments import Experiment, experiment
from .rollouts import Belief, Outcomes, Rollouts
from .session import Frame, Group, Row, Session, Variable, open
from .statistics import statistics
from .table import Table
from .worlds import Columns, ParallelWorlds, Snapshot, Worlds

__version__ = version()

__all__ = [
    "Belief",
    "ClosedError",
    "Columns",
    "Experiment",
    "Frame",
    "Group",
    "NotFoundError",
    "Outcomes",
    "ParallelWorlds",
    "PitchboardError",
    "Rollouts",
    "Row",
    "Session",
    "Snapshot",
    "Table",
    "Variable",
    "Worlds",
    "experiment",
    "open",
    "statistics",
]
