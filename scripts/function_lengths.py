#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions that are too long, from the line of the signature to that of the closing brace.

    scripts/function_lengths.py LIMIT FILE...

Prints those above LIMIT lines; exit status 1 if there are any. Lambdas are lines of the function that they are in."""

import re
import sys
from pathlib import Path

# Comments, raw strings, strings, characters; the ' between digits begins none.
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'', re.S)
TYPE = re.compile(r"(?:template\s*<[^{]*>\s*)?(?:class|struct|union|enum)\b")


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def functions(text):
    """(name, first line, last line) of each function."""
    code = NOT_CODE.sub(blank, text)
    code = re.sub(r"(?m)^[ \t]*#.*(?:\\\n.*)*$", blank, code)
    braces, begin = [], 0  # what is open: "space" (namespace, type), "other", or a function; begin of a statement
    for match in re.finditer(r"[{};]", code):
        position, sign = match.start(), match.group()
        if sign == "{":
            head = code[begin:position].strip()
            kind = "other"
            if all(b == "space" for b in braces):
                if head.startswith(("namespace", "inline namespace", "extern")) or (
                        TYPE.match(head) and not re.search(r"\)\s*(const|noexcept|override)*$", head)):
                    kind = "space"
                elif "(" in head and not head.endswith("="):
                    name = re.search(r"([\w:~]+|operator\s*\S+?)\s*\(", head)
                    kind = (name.group(1) if name else head, code.count("\n", 0, begin + code[begin:].index(head[0])) + 1)
            braces.append(kind)
        elif sign == "}":
            kind = braces.pop() if braces else "other"
            if isinstance(kind, tuple):
                yield (*kind, code.count("\n", 0, position) + 1)
        begin = position + 1
    if braces:
        sys.exit(f"function_lengths: {len(braces)} braces are not closed")


def main():
    limit, too_long = int(sys.argv[1]), 0
    for file in sys.argv[2:]:
        for name, first, last in functions(Path(file).read_text()):
            if last - first + 1 > limit:
                print(f"{file}:{first}: {name} has {last - first + 1} lines, more than {limit}")
                too_long = 1
    sys.exit(too_long)


main()
