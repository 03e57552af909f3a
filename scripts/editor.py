#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes files for the completion of scenes in an editor, from the entries of the program:

    scripts/editor.py [--output .vscode] [--voussoir build/voussoir]

voussoir.code-snippets   VS Code: "Joints/Friction" in a .prm file becomes the section with its entry, default and choices
voussoir-scene.schema.json   JSON Schema of an object {"Section/Entry": value}, as voussoir.run() takes it, with unit and range
"""

import argparse
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from voussoir.program import declarations

LARGEST = {"[Double": 1e300, "[Integer": 2147483647}


def unit_of(entry):
    """Unit in the documentation of an entry, as the program reads it."""
    found = re.search(r"\[([^\]]*)\]", entry["documentation"])
    return found[1] if found else ""


def choices_of(entry):
    """Choices of a selection or a truth value; [] for other entries."""
    pattern = entry["pattern_description"]
    if pattern.startswith("[Selection "):
        return pattern[len("[Selection "):].rstrip("] ").split("|")
    return ["true", "false"] if pattern == "[Bool]" else []


def schema_of(entry):
    """Schema of a value. Numbers may be text with a unit, "21 GPa"."""
    pattern, result = entry["pattern_description"], {"description": entry["documentation"], "default": entry["default_value"]}
    if unit_of(entry):
        result["x-unit"] = unit_of(entry)
    if found := re.fullmatch(r"(\[Double|\[Integer range) (.+)\.\.\.(.+) \(inclusive\)\]", pattern):
        whole = found[1] == "[Integer range"
        number = {"type": "integer" if whole else "number"}
        for word, bound, none in (("minimum", found[2], "-MAX_DOUBLE"), ("maximum", found[3], "MAX_DOUBLE")):
            if bound != none and abs(float(bound)) < LARGEST["[Integer" if whole else "[Double"]:
                number[word] = int(bound) if whole else float(bound)
        text = {"type": "string", "pattern": r"^\s*[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?(\s*[^\s0-9].*)?$"}
        return {**result, "anyOf": [number, text]}
    if pattern == "[Bool]":
        return {**result, "enum": [True, False, "true", "false"]}
    if choices_of(entry):
        return {**result, "enum": choices_of(entry)}
    return {**result, "type": "string"}


def snippet_of(name, entry):
    """The section with the entry; its choices, or its default to be typed over."""
    *sections, last = name.split("/")
    escaped = [re.sub(r"([\\$}])", r"\\\1", text) for text in choices_of(entry) or [entry["default_value"]]]
    if choices_of(entry):
        first = [text for text in escaped if text == entry["default_value"]]
        value = "${1|" + ",".join(first + [text for text in escaped if text not in first]) + "|}"
    else:
        value = "${1:" + escaped[0] + "}"
    body = ["  " * i + f"subsection {section}" for i, section in enumerate(sections)]
    body.append("  " * len(sections) + f"set {last} = {value}")
    body += ["  " * i + "end" for i in reversed(range(len(sections)))]
    return {"scope": "properties", "prefix": name, "body": body, "description": entry["documentation"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--output", default=ROOT / ".vscode", type=Path)
    parser.add_argument("--voussoir", default=ROOT / "build" / "voussoir", help="the program")
    options = parser.parse_args()
    entries = declarations(options.voussoir)
    schema = {"$schema": "http://json-schema.org/draft-07/schema#", "title": "A scene of Voussoir", "type": "object", "additionalProperties": False,
              "properties": {name: schema_of(entry) for name, entry in entries.items()}}
    options.output.mkdir(parents=True, exist_ok=True)
    for file, content in (("voussoir-scene.schema.json", schema),
                          ("voussoir.code-snippets", {name: snippet_of(name, entry) for name, entry in entries.items()})):
        (options.output / file).write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"{len(entries)} entries: {options.output}/voussoir.code-snippets, {options.output}/voussoir-scene.schema.json")
    return 0


if __name__ == "__main__":
    sys.exit(main())
