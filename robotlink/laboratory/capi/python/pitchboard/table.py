# SPDX-License-Identifier: GPL-3.0-or-later
"""Named columns of equal length."""

import csv
import importlib
import pathlib
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._library import PitchboardError, unknown_name


def pandas() -> Any:
    """The module pandas; raises PitchboardError if it is not installed."""
    try:
        return importlib.import_module("pandas")
    except ImportError:
        raise PitchboardError(
            "to_pandas() needs pandas, which is not installed (Debian: python3-pandas)."
        ) from None


class Table(Mapping[str, npt.NDArray[Any]]):
    """Columns by name, in order; each is an array of shape (rows,).

    Numbers are float64 (or the column's own type), NaN if a value is missing; text is an object
    array of str. `table["walked_m"]` is a column; an unknown name raises NotFoundError.
    """

    def __init__(self, columns: Mapping[str, npt.NDArray[Any]]) -> None:
        self._columns: Dict[str, npt.NDArray[Any]] = dict(columns)

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        if name not in self._columns:
            raise unknown_name("the table has no column", name, list(self._columns))
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def shape(self) -> Tuple[int, int]:
        """(rows, columns)."""
        rows = max((len(column) for column in self._columns.values()), default=0)
        return rows, len(self._columns)

    def rows(self) -> List[Dict[str, Any]]:
        """The rows as dictionaries."""
        names = list(self._columns)
        columns = [column.tolist() for column in self._columns.values()]
        return [dict(zip(names, row)) for row in zip(*columns)]

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with these columns. Raises PitchboardError without pandas."""
        return pandas().DataFrame(self._columns)

    def __repr__(self) -> str:
        rows, _ = self.shape
        return f"<Table of {rows} rows: {', '.join(self._columns)}>"


def column_of(cells: Iterable[Any]) -> npt.NDArray[Any]:
    """Numbers if all cells are, with NaN for None and for empty text; else objects."""
    values = list(cells)
    try:
        return np.array(
            [np.nan if value is None or value == "" else float(value) for value in values],
            dtype=np.float64,
        )
    except (TypeError, ValueError):
        out = np.empty(len(values), dtype=object)
        out[:] = values
        return out


def table_of(rows: Iterable[Mapping[str, Any]]) -> Table:
    """A table of rows that need not have the same keys."""
    listed = list(rows)
    names = dict.fromkeys(name for row in listed for name in row)
    return Table({name: column_of(row.get(name) for row in listed) for name in names})


def table_of_csv(path: Union[str, pathlib.Path]) -> Table:
    """A table of a CSV file whose first line has the names."""
    with open(path, encoding="utf-8", newline="") as file:
        lines = list(csv.reader(file))
    if not lines:
        return Table({})
    columns = zip(*lines[1:]) if len(lines) > 1 else [()] * len(lines[0])
    return Table({name: column_of(column) for name, column in zip(lines[0], columns)})
