#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks classes and functions of C++ headers against the gates of CONTRIBUTING.

    scripts/check_classes.py FILE...

Prints classes with more than 25 member functions, interfaces with more than 16 virtual functions, functions with more than 7
parameters, and docstrings that name with @p or @param something that is no parameter of the function. Exit status 1 if there are any.
Constructors, destructors and operators do not count as member functions; an overridden function does not count as virtual.
ABOVE lists what exceeds a gate today: these numbers may fall, not grow."""

import re
import sys
from pathlib import Path

MEMBERS, VIRTUALS, PARAMETERS = 25, 16, 7
ABOVE = {"ContactSolver": 27, "ExplicitRegion": 31, "InterfaceOperator": 29,  # member functions
         "solve": 8}  # parameters
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)
CLASS = re.compile(r"(?:template\s*<[^{;]*>\s*)?(class|struct)\s+(?:\w+\s+)*?(\w+)\s*(?:final\s*)?(?::[^{;]*)?$")


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def split_parameters(text):
    """The parameters of a list, without what is inside of brackets."""
    depth, parts, part = 0, [], ""
    for c in text:
        depth += (c in "(<[{") - (c in ")>]}")
        if c == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += c
    return [p.strip() for p in parts + [part] if p.strip() and p.strip() != "void"]


def declaration(head):
    """(name, parameters) of a function declaration, or None."""
    head = re.sub(r"^\s*(public|private|protected)\s*:", "", head.strip())
    match = re.search(r"(~?\w+|operator\s*\S+?)\s*\(", head)
    if not match or re.match(r"(using|typedef|friend|return|static_assert)\b", head) or "=" in head[:match.start()]:
        return None
    depth = 0
    for i in range(match.end() - 1, len(head)):
        depth += (head[i] == "(") - (head[i] == ")")
        if depth == 0:
            return match.group(1), split_parameters(head[match.end():i]), head
    return None


def functions(text):
    """(class or "", line, name, parameters, head, docstring) of each function that a header declares."""
    code = COMMENT.sub(blank, text)
    code = re.sub(r"(?m)^[ \t]*#.*(?:\\\n.*)*$", blank, code)
    scopes, begin = [], 0
    for match in re.finditer(r"[{};]", code):
        position, sign = match.start(), match.group()
        head = code[begin:position]
        here = scopes[-1] if scopes else ("space", "")
        if sign in "{;" and here[0] in ("space", "class") and (found := declaration(head)):
            comment = re.findall(r"/\*\*(.*?)\*/", text[begin:position], re.S)
            after = re.match(r"[^\n]*///<([^\n]*)", text[position:])
            line = code.count("\n", 0, begin + len(head) - len(head.lstrip())) + 1
            yield (here[1] if here[0] == "class" else "", line, *found, (comment or [after.group(1) if after else ""])[-1])
        if sign == "{":
            stripped = re.sub(r"\b(public|private|protected)\s*:", "", head).strip()
            if re.match(r"(inline\s+)?namespace\b", stripped) and here[0] == "space":
                scopes.append(("space", ""))
            elif here[0] in ("space", "class") and (c := CLASS.search(stripped)):
                scopes.append(("class", c.group(2)))
            else:
                scopes.append(("other", ""))
        elif sign == "}" and scopes:
            scopes.pop()
        begin = position + 1


def check(file):
    """The complaints about a header."""
    members, virtuals = {}, {}
    for owner, line, name, parameters, head, doc in functions(Path(file).read_text()):
        if owner and name not in (owner, "~" + owner) and not name.startswith("operator"):
            members[owner] = members.get(owner, 0) + 1
            virtuals[owner] = virtuals.get(owner, 0) + bool(re.search(r"\bvirtual\b", head))
        if len(parameters) > (limit := ABOVE.get(name, PARAMETERS)):
            yield f"{file}:{line}: {name} has {len(parameters)} parameters, more than {limit}"
        named = {match for p in parameters for match in re.findall(r"\w+", re.sub(r"=.*", "", p))[-1:]}
        for word in re.findall(r"@p(?:aram)?\s+(\w+)", doc):
            if word not in named:
                yield f"{file}:{line}: the docstring of {name} has @p {word}, which is no parameter"
    for owner, count in members.items():
        if count > (limit := max(MEMBERS, ABOVE.get(owner, 0))):  # of JointSystem it has the parameters
            yield f"{file}: class {owner} has {count} member functions, more than {limit}"
        if virtuals[owner] > VIRTUALS:
            yield f"{file}: class {owner} has {virtuals[owner]} virtual functions, more than {VIRTUALS}"


def main():
    complaints = [complaint for file in sys.argv[1:] for complaint in check(file)]
    print("".join(complaint + "\n" for complaint in complaints), end="")
    sys.exit(1 if complaints else 0)


main()
