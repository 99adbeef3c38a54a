# SPDX-License-Identifier: GPL-3.0-or-later
"""Experiments: many runs under several conditions, played by pitchboard-cli."""

import json
import os
import pathlib
import subprocess
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Union

from ._library import PitchboardError, program
from .table import Table, table_of, table_of_csv


class Experiment:
    """The results of an experiment, as tables."""

    def __init__(self, folder: pathlib.Path) -> None:
        """Reads a folder of results, such as one that `pitchboard-cli experiment` wrote."""
        try:
            self.runs: Table = table_of_csv(folder / "runs.csv")
            self.summary: Dict[str, Any] = json.loads(
                (folder / "summary.json").read_text(encoding="utf-8")
            )
        except (OSError, ValueError) as error:
            raise PitchboardError(f"{folder} has no results of an experiment: {error}") from None
        #: A row for each condition and metric: "n", "mean", "mean_95_low", "mean_95_high", "sd", ...
        self.conditions: Table = table_of(
            {"condition": condition["name"], "metric": metric, **_flat(values)}
            for condition in self.summary["conditions"]
            for metric, values in condition["metrics"].items()
        )
        #: Differences between two conditions, with intervals and p values.
        self.differences: Table = table_of(map(_flat, self.summary["differences"]))
        #: Comparisons with given figures, with intervals and p values.
        self.comparisons: Table = table_of(map(_flat, self.summary["comparisons"]))
        #: What was asserted, whether it "holds", and the measured "values".
        self.assertions: Table = table_of(self.summary["assertions"])
        #: Whether every assertion holds; True if there is none.
        self.holds: bool = self.summary["holds"]


def _flat(row: Mapping[str, Any], prefix: str = "") -> Dict[str, Any]:
    """Nested objects and intervals as one row: {"mean_95": [1, 2]} is mean_95_low and _high."""
    out: Dict[str, Any] = {}
    for key, value in row.items():
        name = prefix + key
        if isinstance(value, Mapping):
            out.update(_flat(value, name + "."))
        elif key.endswith("_95"):
            out[name + "_low"], out[name + "_high"] = value or (None, None)
        else:
            out[name] = value
    return out


def experiment(
    experiment: Union[str, "os.PathLike[str]", Mapping[str, Any]],
    out: Union[None, str, "os.PathLike[str]"] = None,
    *,
    runs: Optional[int] = None,
    seed: Optional[int] = None,
    jobs: Optional[int] = None,
    force: bool = False,
    resume: bool = False,
) -> Experiment:
    """Plays an experiment (docs/experiments.md) and returns its tables.

    experiment   a built-in name, the path of a file, or an experiment as a dictionary
    out          the folder of results; None: a temporary one that is removed
    runs, seed   runs per condition and seed of the first, instead of the experiment's
    jobs         how many runs are played at a time; None: one for each processor
    force        replaces the results in `out`; resume: continues them

    Assertions that do not hold are no error; see Experiment.holds. Raises PitchboardError with the
    sentence of pitchboard-cli if the experiment cannot be played.
    """
    with tempfile.TemporaryDirectory(prefix="pitchboard-") as temporary:
        folder = pathlib.Path(os.fspath(out)) if out is not None else pathlib.Path(temporary, "out")
        if isinstance(experiment, Mapping):
            named = pathlib.Path(temporary, "experiment.json")
            named.write_text(json.dumps(experiment), encoding="utf-8")
        else:
            named = pathlib.Path(os.fspath(experiment))
        command: List[str] = [program("pitchboard-cli"), "experiment", str(named)]
        command += ["--out", str(folder)]
        for option, value in (("--runs", runs), ("--seed", seed), ("--jobs", jobs)):
            command += [] if value is None else [option, str(value)]
        command += ["--force"] * force + ["--resume"] * resume
        played = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace"
        )
        if played.returncode not in (0, 1):
            said = played.stderr.strip().splitlines() or [f"exit code {played.returncode}"]
            raise PitchboardError("\n".join(said).replace("error: ", "", 1))
        return Experiment(folder)
