# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables (.csv) of a run as arrays."""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import TYPE_CHECKING, Collection, Dict, Optional, Sequence, Union

from .errors import InputError

if TYPE_CHECKING:
    import numpy as np

Table = Dict[str, "np.ndarray"]
PathLike = Union[str, "os.PathLike[str]"]


def _rows(path: Path) -> list[list[str]]:
    """Reads the cells of a table. An incomplete last row of an interrupted run is left out."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row]
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}.") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path} cannot be read: it is no table ({getattr(error, 'reason', error)}).") from None
    if len(rows) > 1 and len(rows[-1]) < len(rows[0]):
        rows.pop()
    for number, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise InputError(f"{path} is damaged: line {number} has {len(row)} values for {len(rows[0])} columns. Repeat the run.")
    return rows


def read_table(path: PathLike, text_columns: Optional[Collection[str]] = None) -> Table:
    """Reads the columns of a table by name; throws InputError for a missing or damaged file.

    @param text_columns: columns of text; all others must hold numbers. None: columns of numbers where all values are numbers."""
    import numpy as np  # takes a quarter of a second to load, which commands without tables need not wait for

    def array(name: str, texts: Sequence[str]) -> np.ndarray:
        try:
            return np.array(texts) if name in (text_columns or ()) else np.array(texts, dtype=float)
        except ValueError as error:
            if text_columns is None:
                return np.array(texts)
            raise InputError(f"{path} is damaged: {error}. Repeat the run.") from error

    rows = _rows(Path(path))
    return {name.strip(): array(name.strip(), [row[i] for row in rows[1:]]) for i, name in enumerate(rows[0] if rows else [])}
