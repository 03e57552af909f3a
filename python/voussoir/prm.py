# SPDX-License-Identifier: GPL-3.0-or-later
"""The syntax of input files (.prm): entries to text and back."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Dict, Mapping, Optional, Tuple


def read_entries(text: str) -> Dict[str, Tuple[str, Optional[str]]]:
    """Reads the entries of an input file that the program wrote, in sequence.

    Returns "Section/Entry" -> (value, default). The default is None if the value is the default."""
    entries: Dict[str, Tuple[str, Optional[str]]] = {}
    path: list[str] = []
    for line in text.splitlines():
        words, _, remark = line.partition("#")
        words = words.strip()
        if words.startswith("subsection "):
            path.append(words.split(" ", 1)[1].strip())
        elif words == "end" and path:
            path.pop()
        elif words.startswith("set "):
            name, _, value = words[4:].partition("=")
            default = remark.strip().removeprefix("default:").strip() if "default:" in remark else None
            entries["/".join([*path, name.strip()])] = (value.strip(), default)
    return entries


def prm_text(entries: Mapping[str, Any], remarks: Mapping[str, str] = MappingProxyType({})) -> str:
    """Returns an input file with these entries, "Section/Entry" -> value. An entry of @p remarks has this comment before it."""
    lines: list[str] = []
    path: list[str] = []
    for entry, value in entries.items():
        *sections, name = entry.split("/")
        while path != sections[:len(path)]:
            path.pop()
            lines.append("  " * len(path) + "end")
        for section in sections[len(path):]:
            lines.append("  " * len(path) + f"subsection {section}")
            path.append(section)
        if entry in remarks:
            lines.extend("  " * len(path) + f"# {line}" for line in remarks[entry].splitlines())
        lines.append("  " * len(path) + f"set {name} = {value}")
    while path:
        path.pop()
        lines.append("  " * len(path) + "end")
    return "\n".join(lines) + "\n"
