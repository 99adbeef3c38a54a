# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of recordings, with intervals that know that neighbouring samples are alike."""

import ctypes
import math
import os
from typing import Any, Dict, Iterable, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._library import Mean, PitchboardError, address, check, lib, unknown_name
from .session import Session, Variable, open
from .table import Table, table_of

_Recording = Union[Session, str, "os.PathLike[str]"]
_PERCENTILES = {"p05": 5.0, "p25": 25.0, "median": 50.0, "p75": 75.0, "p95": 95.0}


def statistics(
    sessions: Union[_Recording, Iterable[_Recording]],
    variables: Union[None, str, Iterable[str]] = None,
    robots: Union[None, str, Iterable[str]] = None,
) -> Table:
    """Describes variables of robots in one or several sessions, or in parts of them.

    sessions    a Session, a part such as session[10:20], the path of a file, or several of these
    variables   names; None: every variable that is not text
    robots      names of groups, such as "B1" or "match"; None: every robot that has the variables

    Returns a Table with a row for each session, robot and variable, and for enumerations and flags
    one more for each value that occurs:

    session     number of the session, from 0 (float64)
    robot, variable, unit   str
    value, label            of a value that occurs: its code (float64) and label (str); else NaN, ""
    share       share of the known time with that value; for the variable itself, share of the time in
                which it is known
    n           number of known samples; unknown ones (NaN) count nowhere
    n_effective     as many independent samples would say as much: neighbouring samples are alike
    mean, mean_95_low, mean_95_high     with the 95 % interval that n_effective gives; NaN where it is
                below 2
    sd, min, p05, p25, median, p75, p95, max    in `unit`; NaN without samples, and for codes

    Raises NotFoundError for a file that does not exist, a robot that no session has, or a variable that no chosen robot has.
    docs/python.md has an example.
    """
    given = [sessions] if isinstance(sessions, (Session, str, os.PathLike)) else list(sessions)
    chosen = [one if isinstance(one, Session) else open(one) for one in given]
    if not chosen:
        raise PitchboardError("statistics() needs at least one session: pitchboard.statistics(session).")
    names = _names(variables)
    wanted = _names(robots)
    rows: List[Dict[str, Any]] = []
    found: Tuple[Dict[str, None], Dict[str, None]] = ({}, {})  # robots, variables
    known: Tuple[Dict[str, None], Dict[str, None]] = ({}, {})
    for number, session in enumerate(chosen):
        known[0].update(dict.fromkeys(session))
        for robot in session.robots if wanted is None else wanted:
            if robot not in session:
                continue
            found[0][robot] = None
            group = session[robot]
            known[1].update(dict.fromkeys(group))
            for name in group if names is None else names:
                if name not in group or group[name].kind == "text":
                    continue
                found[1][name] = None
                rows += _rows_of(number, robot, group[name])
    for missing in (one for one in wanted or () if one not in found[0]):
        raise unknown_name("no session has a robot", missing, list(known[0]))
    for missing in (one for one in names or () if one not in found[1]):
        raise unknown_name("no robot has a variable of numbers", missing, list(known[1]))
    return table_of(rows)


def _names(given: Union[None, str, Iterable[str]]) -> Optional[List[str]]:
    return given if given is None else [given] if isinstance(given, str) else list(given)


def _rows_of(session: int, robot: str, variable: Variable) -> List[Dict[str, Any]]:
    values = np.asarray(variable.values, dtype=np.float64)
    there = np.isfinite(values)
    some = values[there]
    lasting = _durations(variable.time)
    of_codes = variable.kind in ("enumeration", "flag")
    row: Dict[str, Any] = {
        "session": session,
        "robot": robot,
        "variable": variable.name,
        "unit": variable.unit,
        "value": None,
        "label": "",
        "share": _share(lasting, there),
        "n": some.size,
    }
    row.update(_numbers(values, of_codes))
    rows = [row]
    for code in np.unique(some) if of_codes else ():
        share = _share(lasting[there], some == code)
        label = variable.labels.get(int(code), "")
        rows.append(dict(row, value=code, label=label, share=share, n=int((some == code).sum())))
        rows[-1].update(_numbers(some[:0], True))
    return rows


def _numbers(values: npt.NDArray[np.float64], of_codes: bool) -> Dict[str, float]:
    """Of all samples in their order: unknown ones (NaN) are not neighbours of one another."""
    out = dict.fromkeys(
        ["n_effective", "mean", "mean_95_low", "mean_95_high", "sd", "min", *_PERCENTILES, "max"],
        math.nan,
    )
    some = values[np.isfinite(values)]
    if some.size == 0 or of_codes:
        return out
    mean = _mean_95(values)
    out.update(n_effective=mean.effective, mean_95_low=mean.low, mean_95_high=mean.high)
    out.update(mean=float(some.mean()), min=float(some.min()), max=float(some.max()))
    out.update(zip(_PERCENTILES, np.percentile(some, list(_PERCENTILES.values())).tolist()))
    if some.size > 1:
        out["sd"] = float(some.std(ddof=1))
    return out


def _durations(time: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """A value holds until the next sample, at most 10 s; the last one as long as samples usually do."""
    if time.size < 2:
        return np.ones(time.size)
    steps = np.minimum(np.diff(time), 10.0)
    return np.append(steps, np.median(steps))


def _share(lasting: npt.NDArray[np.float64], which: npt.NDArray[np.bool_]) -> float:
    whole = float(lasting.sum())
    return float(lasting[which].sum()) / whole if whole > 0 else math.nan


def _mean_95(values: npt.NDArray[np.float64]) -> Mean:
    """The effective samples and the interval of the mean, as every program of Pitchboard computes them."""
    given = np.ascontiguousarray(values, dtype=np.float64)
    mean = Mean(size=ctypes.sizeof(Mean))
    check(lib.pb_mean_interval(address(given), given.size, ctypes.byref(mean)))
    return mean
