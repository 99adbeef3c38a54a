# SPDX-License-Identifier: GPL-3.0-or-later
"""libpitchboard_sim by ctypes: its functions, its errors as exceptions, its memory as arrays.

Private; pitchboard_sim.h and pitchboard_session.h describe the functions. ctypes lets other Python
threads run during each call.
"""

import ctypes
import difflib
import os
import pathlib
import shutil
import sysconfig
from ctypes import POINTER, c_char_p, c_double, c_int32, c_size_t, c_uint64, c_void_p
from typing import Any, Dict, Iterable, List, NoReturn, Optional, Sequence, Type

import numpy as np
import numpy.typing as npt

API_VERSION = 4
SONAME = "libpitchboard_sim.so.1"
NOT_FOUND, STALE = 2, 7


class PitchboardError(Exception):
    """Something that Pitchboard refused, with its sentence."""


class NotFoundError(PitchboardError, KeyError):
    """A file, robot, variable or scenario does not exist."""

    __str__ = Exception.__str__  # KeyError would put it in quotes


class ClosedError(PitchboardError, ValueError):
    """A session, worlds or rollouts were used after close()."""


class Options(ctypes.Structure):
    """pb_options."""

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


class Shape(ctypes.Structure):
    """pb_shape."""

    _fields_ = [
        ("size", c_size_t),
        ("worlds", c_int32),
        ("robots", c_int32),
        ("tick_rate", c_double),
    ]


class RolloutOptions(ctypes.Structure):
    """pb_rollout_options."""

    _fields_ = [
        ("size", c_size_t),
        ("scenario", c_char_p),
        ("text", c_char_p),
        ("noise", c_char_p),
        ("threads", c_int32),
        ("tick_rate", c_double),
    ]


class PlayOptions(ctypes.Structure):
    """pb_play_options."""

    _fields_ = [
        ("size", c_size_t),
        ("seconds", c_double),
        ("look", c_double),
        ("go_on", c_int32),
    ]


class Span(ctypes.Structure):
    """pb_span."""

    _fields_ = [
        ("size", c_size_t),
        ("type", c_int32),
        ("values", c_void_p),
        ("count", c_size_t),
    ]


class Mean(ctypes.Structure):
    """pb_mean."""

    _fields_ = [
        ("size", c_size_t),
        ("effective", c_double),
        ("low", c_double),
        ("high", c_double),
    ]


#: The numpy type of each pb_type.
DTYPES: List[npt.DTypeLike] = [np.uint8, np.int32, np.float32, np.float64]

_HANDLE, _OUT = c_void_p, POINTER(c_void_p)
_ARRAY = c_void_p  # the address of a numpy array

_FUNCTIONS: Dict[str, List[Any]] = {
    "pb_options_init": [POINTER(Options), c_size_t],
    "pb_create": [POINTER(Options), _OUT],
    "pb_destroy": [_HANDLE],
    "pb_get_shape": [_HANDLE, POINTER(Shape)],
    "pb_robot_ids": [_HANDLE, _ARRAY, c_size_t],
    "pb_set_behaviour": [_HANDLE, c_int32, c_char_p],
    "pb_step": [_HANDLE, c_int32],
    "pb_read": [_HANDLE, c_int32, _ARRAY, c_size_t],
    "pb_read_hashes": [_HANDLE, _ARRAY, c_size_t],
    "pb_find_variable": [c_char_p, POINTER(c_int32)],
    "pb_read_variables": [_HANDLE, _ARRAY, c_size_t, _ARRAY, c_size_t],
    "pb_write_variables": [_HANDLE, _ARRAY, c_size_t, _ARRAY, c_size_t],
    "pb_write_commands": [_HANDLE, _ARRAY, c_size_t],
    "pb_write_actions": [_HANDLE, _ARRAY, c_size_t],
    "pb_take_snapshot": [_HANDLE, c_int32, _OUT],
    "pb_restore": [_HANDLE, c_int32, _HANDLE],
    "pb_destroy_snapshot": [_HANDLE],
    "pb_reset_some": [_HANDLE, _ARRAY, _ARRAY, c_size_t],
    "pb_restore_seeded": [_HANDLE, _ARRAY, _ARRAY, c_size_t, _HANDLE],
    "pb_place_robots": [_HANDLE, _ARRAY, c_size_t, c_int32, _ARRAY],
    "pb_place_balls": [_HANDLE, _ARRAY, c_size_t, _ARRAY],
    "pb_rollout_options_init": [POINTER(RolloutOptions), c_size_t],
    "pb_play_options_init": [POINTER(PlayOptions), c_size_t],
    "pb_rollouts_create": [POINTER(RolloutOptions), _OUT],
    "pb_rollouts_destroy": [_HANDLE],
    "pb_rollouts_robots": [_HANDLE, POINTER(c_int32)],
    "pb_rollouts_beginning": [_HANDLE, _ARRAY, c_size_t, _ARRAY, c_size_t],
    "pb_rollouts_play": [_HANDLE, POINTER(PlayOptions)] + [_ARRAY, c_size_t] * 4,
    "pb_session_open": [c_char_p, _OUT],
    "pb_session_close": [_HANDLE],
    "pb_session_describe": [_HANDLE, _OUT],
    "pb_session_group": [_HANDLE, c_char_p, POINTER(c_int32)],
    "pb_session_events": [_HANDLE, c_double, c_double, _OUT],
    "pb_session_rows": [_HANDLE, c_int32, _ARRAY, c_size_t, c_double, c_double, c_int32, _OUT],
    "pb_session_frame": [_HANDLE, c_double, _OUT],
    "pb_mean_interval": [_ARRAY, c_size_t, POINTER(Mean)],
    "pb_data_span": [_HANDLE, c_size_t, POINTER(Span)],
    "pb_data_free": [_HANDLE],
}


def _near(places: Iterable[str]) -> List[pathlib.Path]:
    """The files of these patterns, below the prefix or the checkout in which this package stands."""
    here = pathlib.Path(__file__).resolve().parent
    found: List[pathlib.Path] = []
    for top in here.parents[:5]:
        for place in places:
            found += sorted(top.glob(place))
    return found


def _load() -> ctypes.CDLL:
    named = os.environ.get("PITCHBOARD_SIM_LIBRARY")
    # Debian has the libraries of several processors side by side.
    places = [f"build/release/lib/{SONAME}", f"lib/{SONAME}"]
    processor = sysconfig.get_config_var("MULTIARCH")
    places += [f"lib/{processor}/{SONAME}"] if processor else []
    beside = _near(places)
    path = named or (str(beside[0]) if beside else SONAME)
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(
            f"Cannot load {path}: {error}. Install Pitchboard, build it with ./run --build-only, or "
            "set PITCHBOARD_SIM_LIBRARY to its library."
        ) from None
    library.pb_version.restype = c_char_p
    if library.pb_api_version() < API_VERSION:
        raise ImportError(
            f"{path} is of version {library.pb_version().decode()}, older than this package. Use "
            "the library of the same version."
        )
    library.pb_last_error.restype = c_char_p
    library.pb_column_name.restype = c_char_p
    library.pb_column_name.argtypes = [c_int32, c_size_t]
    library.pb_column_count.restype = c_size_t
    library.pb_column_count.argtypes = [c_int32]
    for name, arguments in _FUNCTIONS.items():
        function = getattr(library, name)
        function.argtypes = arguments
        function.restype = c_int32
    return library


lib = _load()


def version() -> str:
    """Returns the version of the library, such as "0.23.0"."""
    return str(lib.pb_version().decode())


def check(status: int) -> None:
    """Raises the error of the call that returned this status, if it failed."""
    if status == 0:
        return
    kind: Type[PitchboardError] = PitchboardError
    if status == NOT_FOUND:
        kind = NotFoundError
    elif status == STALE:
        kind = ClosedError
    raise kind(lib.pb_last_error().decode(errors="replace") or f"status {status}")


def program(name: str) -> str:
    """Returns the path of one of Pitchboard's programs: of this checkout or prefix, else in PATH."""
    beside = _near([f"build/release/bin/{name}", f"bin/{name}"])
    found = str(beside[0]) if beside else shutil.which(name)
    if found is None:
        raise NotFoundError(f"There is no program {name} in PATH. Install or build Pitchboard.")
    return found


def column_names(array: int) -> List[str]:
    """Returns the names of the columns of a pb_array."""
    return [lib.pb_column_name(array, i).decode() for i in range(lib.pb_column_count(array))]


def unknown_name(sentence: str, name: object, known: Sequence[str]) -> NotFoundError:
    """An error such as `B1 has no variable "VISION_BAL"; did you mean VISION_BALL_DIST?`"""
    near = difflib.get_close_matches(str(name).upper(), [one.upper() for one in known], 5)
    meant = dict.fromkeys(one for wanted in near for one in known if one.upper() == wanted)
    if meant:
        return NotFoundError(f'{sentence} "{name}"; did you mean {", ".join(meant)}?')
    some = ", ".join(known[:10]) + (", ..." if len(known) > 10 else "")
    return NotFoundError(f'{sentence} "{name}"; known are {some or "none"}')


def refuse_pickle(what: object, instead: str) -> NoReturn:
    raise TypeError(f"{type(what).__name__} objects cannot be pickled or copied; {instead}")


class Data:
    """A pb_data. Its arrays are the library's memory and keep it for as long as they exist."""

    def __init__(self, handle: c_void_p) -> None:
        self._handle = handle

    def __del__(self) -> None:
        lib.pb_data_free(self._handle)

    def array(self, index: int) -> npt.NDArray[Any]:
        """Returns an array without copying it; it is read-only."""
        span = Span(size=ctypes.sizeof(Span))
        check(lib.pb_data_span(self._handle, index, ctypes.byref(span)))
        dtype: "np.dtype[Any]" = np.dtype(DTYPES[span.type])
        if span.count == 0:
            return np.empty(0, dtype)
        memory = (ctypes.c_char * (span.count * dtype.itemsize)).from_address(span.values)
        memory.owner = self  # numpy keeps the buffer, and the buffer keeps the data
        array: npt.NDArray[Any] = np.frombuffer(memory, dtype)
        array.flags.writeable = False
        return array

    def text(self) -> str:
        """Returns array 0 of a pb_data that is text."""
        return self.array(0).tobytes().decode(errors="replace")


def address(array: npt.NDArray[Any]) -> int:
    """The address of an array's memory, which must be contiguous."""
    assert array.flags.c_contiguous
    where: int = array.__array_interface__["data"][0]  # quicker than array.ctypes
    return where


def encoded(text: Optional[str]) -> Optional[bytes]:
    return None if text is None else text.encode()
