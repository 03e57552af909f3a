# SPDX-License-Identifier: GPL-3.0-or-later
"""The program voussoir: finds it, runs it, and turns its errors into exceptions."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
from functools import lru_cache
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, Mapping, Optional, Union

from .errors import ComputationError, InputError
from .prm import read_entries
from .results import Results
from .tables import PathLike

Settings = Union[Mapping[str, Any], Iterable[str], None]


def find_program(program: Optional[PathLike] = None) -> str:
    """Returns the first program of: @p program, environment variable VOUSSOIR_PROGRAM, PATH, build directory of these sources."""
    build = Path(__file__).resolve().parent.parent.parent / "build" / "voussoir"
    found = program or os.environ.get("VOUSSOIR_PROGRAM") or shutil.which("voussoir") or (build if build.is_file() else None)
    if found is None:
        raise InputError("The program voussoir was not found. Name it in the environment variable VOUSSOIR_PROGRAM.")
    return os.fspath(found)


def set_options(entries: Settings) -> list[str]:
    """Returns the options --set of entries: a mapping "Section/Entry" -> value, or texts "Section/Entry=value"."""
    if isinstance(entries, Mapping):
        entries = [f"{entry}={str(value).lower() if isinstance(value, bool) else value}" for entry, value in entries.items()]
    return [word for text in entries or () for word in ("--set", text)]


def start(*arguments: Any, program: Optional[PathLike] = None, threads: Optional[int] = None) -> subprocess.CompletedProcess[str]:
    """Runs the program; returns its status, output and errors. InputError if the program cannot be started."""
    environment = dict(os.environ) if threads is None else {**os.environ, "OMP_NUM_THREADS": str(threads)}
    found = find_program(program)
    try:
        return subprocess.run([found, *map(str, arguments)], capture_output=True, text=True, env=environment, check=False)
    except OSError as error:
        raise InputError(f"{found} cannot be started: {error.strerror}.") from None


def message_of(text: str, status: int) -> str:
    """Returns the last message about a failure in the output of the program, without warnings; else the last line."""
    lines = [line for line in text.splitlines() if line.strip()]
    for prefix in ("voussoir: error: ", "voussoir: failed: ", "voussoir: "):
        for line in reversed(lines):
            if line.startswith(prefix) and not line.startswith("voussoir: warning"):
                return line[len(prefix):]
    return f"voussoir ended with status {status}" + (f": {lines[-1]}" if lines else " and printed nothing.")


def call(*arguments: Any, program: Optional[PathLike] = None, threads: Optional[int] = None) -> str:
    """Runs the program; returns its output. InputError or ComputationError with the message of a failure."""
    result = start(*arguments, program=program, threads=threads)
    if result.returncode != 0:
        raise (InputError if result.returncode == 2 else ComputationError)(message_of(result.stderr, result.returncode))
    return result.stdout


@lru_cache(maxsize=None)
def program_key() -> str:
    """Returns what identifies the program, for digests of runs: version and revision, of uncommitted sources also a digest of its file."""
    version = call("--version").strip()
    if "unknown" in version or "dirty" in version:
        version += hashlib.sha256(Path(find_program()).resolve().read_bytes()).hexdigest()
    return version


def run(scene: PathLike, output: PathLike, settings: Settings = None, *, resume: bool = False, overwrite: bool = False,
        threads: Optional[int] = None, program: Optional[PathLike] = None) -> Results:
    """Runs a scene ("Section/Entry" -> value in @p settings) and returns its results. The output is in log.txt.

    InputError and ComputationError carry the message of the program. After a failed computation load() reads the files so far."""
    flags = [flag for flag, given in (("--resume", resume), ("--overwrite", overwrite)) if given]
    call(scene, "--output", output, *flags, *set_options(settings), program=program, threads=threads)
    return Results(output)


def entries_of(file: PathLike, settings: Settings = None, *, program: Optional[PathLike] = None) -> Dict[str, str]:
    """Returns every entry of a scene with its value as text, defaults included: "Section/Entry" -> value."""
    text = call("scene", file, *set_options(settings), program=program)
    return {entry: value for entry, (value, _) in read_entries(text).items()}


def declarations(program: Optional[PathLike] = None) -> Dict[str, Dict[str, Any]]:
    """Returns the declaration of every entry: "Section/Entry" -> default, pattern and documentation."""
    def walk(tree: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[tuple[str, Dict[str, Any]]]:
        for name, child in tree.items():
            if "pattern_description" in child:
                yield "/".join([*path, name]), child
            else:
                yield from walk(child, (*path, name))

    return dict(walk(json.loads(call("parameters", "json", program=program)), ()))
