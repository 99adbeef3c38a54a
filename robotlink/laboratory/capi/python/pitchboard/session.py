# SPDX-License-Identifier: GPL-3.0-or-later
"""Recorded sessions: MCAP files of simulated matches and of live robots."""

import ctypes
import json
import math
import os
import threading
from ctypes import byref, c_int32, c_void_p
from typing import (
    Any,
    Dict,
    Iterable,
    Iterator,
    List,
    Mapping,
    NoReturn,
    Optional,
    Sequence,
    Tuple,
    Union,
    overload,
)

import numpy as np
import numpy.typing as npt

from ._library import (
    DTYPES,
    NOT_FOUND,
    ClosedError,
    Data,
    address,
    check,
    lib,
    refuse_pickle,
    unknown_name,
)
from .table import Table, pandas

_UNKNOWN_NAN, _UNKNOWN_OLD = 0, 1


def open(path: Union[str, "os.PathLike[str]"]) -> "Session":
    """Opens a recording.

    A file that is truncated, damaged or still being recorded opens as far as it goes;
    `session.notes` says what is missing. Raises NotFoundError if there is no such file, and
    PitchboardError if it cannot be read or is not an MCAP file.
    """
    handle = c_void_p()
    check(lib.pb_session_open(os.fsencode(os.fspath(path)), byref(handle)))
    return Session(_File(handle, os.fspath(path)), (-math.inf, math.inf))


def _data(status: int, handle: c_void_p) -> Data:
    check(status)
    return Data(handle)


class _File:
    """An open file, which sessions, groups and variables share."""

    def __init__(self, handle: c_void_p, path: str) -> None:
        self.path = path
        self._handle: Optional[c_void_p] = handle
        self._lock = threading.Lock()
        description = self.describe()
        self.groups: Dict[str, Dict[str, Any]] = {}
        for group in description.pop("groups"):
            # Two live robots may have had the same name one after the other.
            name, number = group["name"], 2
            while name in self.groups:
                name, number = f"{group['name']} ({number})", number + 1
            self.groups[name] = group
        #: The place of each variable of each group.
        self.places: Dict[str, Dict[str, int]] = {
            name: {column["name"]: i for i, column in enumerate(group["columns"])}
            for name, group in self.groups.items()
        }
        self.info: Dict[str, Any] = description

    @property
    def handle(self) -> c_void_p:
        handle = self._handle
        if handle is None:
            raise ClosedError(f"The session {self.path} is closed; open it again.")
        return handle

    def close(self) -> None:
        with self._lock:
            handle, self._handle = self._handle, None
        if handle is not None:
            check(lib.pb_session_close(handle))

    def __del__(self) -> None:
        handle = getattr(self, "_handle", None)
        if handle is not None:
            lib.pb_session_close(handle)

    def describe(self) -> Dict[str, Any]:
        out = c_void_p()
        described = _data(lib.pb_session_describe(self.handle, byref(out)), out)
        return dict(json.loads(described.text()))

    def present_name(self, former: str) -> str:
        """The name of the group that had this one earlier."""
        index = c_int32()
        status = lib.pb_session_group(self.handle, former.encode(), byref(index))
        if status == NOT_FOUND:
            raise unknown_name("the session has no robot", former, list(self.groups))
        check(status)
        return next(name for name, group in self.groups.items() if group["index"] == index.value)

    def rows(
        self, group: int, columns: Sequence[int], within: Tuple[float, float], unknown: int
    ) -> List[npt.NDArray[Any]]:
        """Times and the columns, over the library's memory."""
        wanted = np.array(columns, dtype=np.int32)
        out = c_void_p()
        status = lib.pb_session_rows(
            self.handle, group, address(wanted), len(wanted), *within, unknown, byref(out)
        )
        data = _data(status, out)
        return [data.array(i) for i in range(len(wanted) + 1)]


def _part(within: Tuple[float, float], wanted: "slice") -> Tuple[float, float]:
    """The intersection of a range with another one."""
    if wanted.step is not None:
        raise ValueError(
            "A range of time has no step; use frames(step=...) for moments at equal distances."
        )
    begin = -math.inf if wanted.start is None else float(wanted.start)
    end = math.inf if wanted.stop is None else float(wanted.stop)
    if math.isnan(begin) or math.isnan(end):
        raise ValueError("A time must be a number of seconds, not NaN.")
    if begin > end:
        raise ValueError(f"The range ends before it begins: from {begin:g} s until {end:g} s.")
    begin, end = max(within[0], begin), min(within[1], end)
    if begin > end:
        raise ValueError(
            f"The range from {begin:g} s is outside of this part of the session, which ends at "
            f"{end:g} s."
        )
    return begin, end


class Variable:
    """A variable of a robot or of the match. Nothing is read before `time` or `values` is used."""

    def __init__(self, group: "Group", index: int, description: Dict[str, Any]) -> None:
        self._group = group
        self._index = index
        self.name: str = description["name"]
        #: "cm", "°", "m/s"; empty if there is none.
        self.unit: str = description["unit"]
        #: The group in lists: "Vision", "Truth".
        self.category: str = description["category"]
        #: "number", "flag", "enumeration" or "text".
        self.kind: str = description["kind"]
        #: The texts of codes, of an enumeration or a text: {1: "walk forward, fast"}.
        self.labels: Dict[int, str] = {int(k): v for k, v in description["labels"].items()}
        #: int32, float32 or float64.
        self.dtype: "np.dtype[Any]" = np.dtype(DTYPES[description["type"]])
        self._read: Optional[List[npt.NDArray[Any]]] = None

    def _arrays(self) -> List[npt.NDArray[Any]]:
        if self._read is None:
            self._read = self._group._rows([self._index], _UNKNOWN_NAN)
        return self._read

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Seconds of the session: float64, shape (n,), read-only."""
        return self._arrays()[0]

    @property
    def values(self) -> npt.NDArray[Any]:
        """In `unit`: `dtype`, shape (n,), read-only. NaN where the value is unknown, such as the
        distance of a ball that is not seen, or was not recorded."""
        return self._arrays()[1]

    @property
    def recorded(self) -> npt.NDArray[Any]:
        """As `values`, but an unknown value is the old one that the file has."""
        return self._group._rows([self._index], _UNKNOWN_OLD)[1]

    @property
    def texts(self) -> npt.NDArray[np.object_]:
        """The labels of the values: object, shape (n,); None where the value is unknown or has no
        label."""
        values = self.values
        out = np.empty(len(values), dtype=object)
        for code in np.unique(values[np.isfinite(values)]):
            out[values == code] = self.labels.get(int(code))
        return out

    def to_pandas(self) -> Any:
        """A pandas.Series with the time (s) as index. Raises PitchboardError without pandas."""
        module = pandas()
        return module.Series(self.values, module.Index(self.time, name="time"), name=self.name)

    def __len__(self) -> int:
        return len(self.time)

    def __array__(self, dtype: Any = None, copy: Any = None) -> npt.NDArray[Any]:
        return np.array(self.values, dtype=dtype) if dtype or copy else self.values

    def __repr__(self) -> str:
        unit = f" [{self.unit}]" if self.unit else ""
        return f"<Variable {self._group.name}.{self.name}{unit}, {self.kind}, {self.dtype}>"

    def __reduce__(self) -> NoReturn:
        refuse_pickle(self, "pickle its arrays `time` and `values`.")


class Group(Mapping[str, Variable]):
    """The variables of a robot ("B1"), of a link ("B1 link") or of the match, by name.

    group["VISION_BALL_DIST"]    a Variable
    group[["TRUE_X", "TRUE_Y"]]  a Group with these variables only
    group[10:20]                 a Group of the time from 10 s to 20 s, both included
    """

    def __init__(
        self, file: _File, name: str, within: Tuple[float, float], columns: Sequence[int]
    ) -> None:
        self._file = file
        self._within = within
        self._about = file.groups[name]
        self._columns = list(columns)
        self._places = {self._about["columns"][c]["name"]: c for c in columns}
        self.name = name
        #: Further facts as text: "robot" (number of the blackboard), "team", "number" (on the shirt).
        self.attributes: Dict[str, str] = dict(self._about["attributes"])

    def _rows(self, columns: Sequence[int], unknown: int) -> List[npt.NDArray[Any]]:
        return self._file.rows(self._about["index"], columns, self._within, unknown)

    @overload
    def __getitem__(self, key: str) -> Variable: ...
    @overload
    def __getitem__(self, key: Union[List[str], "slice"]) -> "Group": ...
    def __getitem__(
        self, key: Union[str, List[str], "slice"]
    ) -> Union[Variable, "Group"]:
        if isinstance(key, slice):
            within = _part(self._within, key)
            return Group(self._file, self.name, within, self._columns)
        if isinstance(key, list):
            return Group(self._file, self.name, self._within, [self._place(one) for one in key])
        place = self._place(key)
        return Variable(self, place, self._about["columns"][place])

    def _place(self, name: object) -> int:
        if not isinstance(name, str):
            raise TypeError(
                f"{self.name}[...] takes the name of a variable, a list of names, or a range of "
                f"time such as 10:20, not {type(name).__name__}."
            )
        if name not in self._places:
            raise unknown_name(f"{self.name} has no variable", name, list(self._places))
        return self._places[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)

    def read(self) -> Table:
        """Reads all variables at once: "time" (s) and a column for each, as Variable.values.

        Shape (n,) each. To read some of them, write group[["TRUE_X", "TRUE_Y"]].read().
        """
        arrays = self._rows(self._columns, _UNKNOWN_NAN)
        return Table(dict(zip(["time", *self._places], arrays)))

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with the time (s) as index. Raises PitchboardError without pandas."""
        frame = self.read().to_pandas()
        return frame.set_index("time")

    def __repr__(self) -> str:
        return f"<Group {self.name} of {len(self)} variables>"

    def __reduce__(self) -> NoReturn:
        refuse_pickle(self, "pickle what read() or to_pandas() returns.")


class Row(Mapping[str, float]):
    """The values of a robot or of the match at a moment, as float; NaN if unknown."""

    def __init__(self, names: Mapping[str, int], values: npt.NDArray[np.float64], what: str) -> None:
        self._names = names
        self._what = what
        #: The row's own time in s, at or before that of the frame; NaN if there was no row yet.
        self.time = float(values[0])
        #: All of them: float64, shape (variables,), read-only.
        self.array: npt.NDArray[np.float64] = values[1:]

    def __getitem__(self, name: str) -> float:
        if name not in self._names:
            raise unknown_name(f"{self._what} has no variable", name, list(self._names))
        return float(self.array[self._names[name]])

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


class Frame(Mapping[str, Row]):
    """A moment: the last row of every group at or before `time` (s). frame["B1"]["TRUE_X"]"""

    def __init__(self, time: float, rows: Dict[str, Row]) -> None:
        self.time = time
        self._rows = rows

    def __getitem__(self, name: str) -> Row:
        if name not in self._rows:
            raise unknown_name("the session has no robot", name, list(self._rows))
        return self._rows[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def __repr__(self) -> str:
        return f"<Frame at {self.time:g} s of {', '.join(self._rows)}>"


class Session(Mapping[str, Group]):
    """A recording: groups of variables by name. pitchboard.open() makes one.

    session["B1"]    a Group: a robot, by its name or one that it had earlier
    session[10:20]   a Session of the time from 10 s to 20 s, both included, as pandas' .loc

    Only what is used is read from the file, and of a part only that part. Any thread may use a
    session; calls wait for one another. Use it in a `with` statement, or call close(); arrays that
    were read stay. Times are seconds of the session.
    """

    def __init__(self, file: _File, within: Tuple[float, float]) -> None:
        self._file = file
        self._within = within

    @overload
    def __getitem__(self, key: str) -> Group: ...
    @overload
    def __getitem__(self, key: "slice") -> "Session": ...
    def __getitem__(self, key: Union[str, "slice"]) -> Union[Group, "Session"]:
        self._file.handle  # raises if it is closed
        if isinstance(key, slice):
            return Session(self._file, _part(self._within, key))
        if not isinstance(key, str):
            raise TypeError(
                "session[...] takes the name of a robot or a range of time such as 10:20, not "
                f"{type(key).__name__}."
            )
        name = key if key in self._file.groups else self._file.present_name(key)
        columns = range(len(self._file.groups[name]["columns"]))
        return Group(self._file, name, self._within, columns)

    def __iter__(self) -> Iterator[str]:
        return iter(self._file.groups)

    def __len__(self) -> int:
        return len(self._file.groups)

    @property
    def robots(self) -> List[str]:
        """The names of the groups that belong to robots, in the order of lists."""
        return [
            name
            for name, group in self._file.groups.items()
            if {"robot", "live"} & set(group["attributes"]) and "link" not in group["attributes"]
        ]

    @property
    def game(self) -> Group:
        """Ball, clock, score and referee: the group "match". NotFoundError if there is none."""
        return self["match"]

    @property
    def info(self) -> Dict[str, Any]:
        """What the file says about itself: "program", "source" ("simulation" or "live"), "title",
        "seed", "start_ns" and "created_ns" (wall time, ns since 1970), "complete", "recording",
        "damaged", "more"."""
        return {k: v for k, v in self._file.info.items() if k not in ("notes", "from", "until")}

    @property
    def begin(self) -> float:
        """Time of the first row or message in s; NaN if there is none."""
        return max(self._within[0], float(self._file.info.get("from", math.nan)))

    @property
    def end(self) -> float:
        """Time of the last row or message in s; NaN if there is none."""
        return min(self._within[1], float(self._file.info.get("until", math.nan)))

    @property
    def notes(self) -> List[str]:
        """Sentences that say what is missing or damaged, as far as the file was read."""
        return list(self._file.describe()["notes"])

    @property
    def events(self) -> List[Dict[str, Any]]:
        """Goals, kicks, falls, bookmarks ..., in order of time: dictionaries with "time" (s),
        "kind", "text" and the other keys of docs/sessions.md#events."""
        out = c_void_p()
        status = lib.pb_session_events(self._file.handle, *self._within, byref(out))
        return list(json.loads(_data(status, out).text()))

    def at(self, time: float) -> Frame:
        """The frame at a time in s."""
        out = c_void_p()
        data = _data(lib.pb_session_frame(self._file.handle, float(time), byref(out)), out)
        rows = {
            name: Row(self._file.places[name], data.array(group["index"]), name)
            for name, group in self._file.groups.items()
        }
        return Frame(float(time), rows)

    def frames(
        self, times: Optional[Iterable[float]] = None, *, step: float = 1.0
    ) -> Iterator[Frame]:
        """Frames, one at a time: at these times (s), or every `step` seconds from begin to end."""
        if times is None:
            if not step > 0.0:
                raise ValueError(f"The step must be above 0 s, not {step}.")
            if math.isnan(self.begin):
                return
            count = int(math.floor((self.end - self.begin) / step + 1e-9)) + 1
            times = (self.begin + i * step for i in range(count))
        for time in times:
            yield self.at(time)

    def close(self) -> None:
        """Closes the file. Later reading raises ClosedError; a second call does nothing."""
        self._file.close()

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Session {self._file.path}: {', '.join(self._file.groups)}>"

    def __reduce__(self) -> NoReturn:
        refuse_pickle(self, "open the file again in the other process.")
