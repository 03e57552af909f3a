#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the reference pages of doc/generated: columns.md from scripts/columns.txt, messages.md from the sources, and with the program
entries.md (units from the sources) and commands.md.

    scripts/reference.py [--voussoir build/voussoir] [--check]

--check writes nothing, and ends with status 1 if a page is not up to date. Without --voussoir it checks columns.md and messages.md only.
"""

import argparse
import json
import re
import subprocess
import sys
from itertools import product
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "doc" / "generated"
NOTE = "<!-- Written by scripts/reference.py. -->\n"


def columns():
    """{file: (purpose, [(name, unit, meaning)])} of scripts/columns.txt."""
    files, rows = {}, []
    for number, line in enumerate((ROOT / "scripts" / "columns.txt").read_text(encoding="utf-8").splitlines(), 1):
        if head := re.fullmatch(r"\[(.*)\] (.*)", line):
            rows = []
            files[head[1]] = head[2], rows
        elif line and not line.startswith("#"):
            row = tuple(part.strip() for part in line.split(" | "))
            if len(row) != 3 or not files:
                sys.exit(f"reference: scripts/columns.txt:{number} is not NAME | UNIT | MEANING")
            rows.append(row)
    return files


def expanded(name):
    """The names that a name with {a,b} stands for."""
    parts = [part.split(",") if i % 2 else [part] for i, part in enumerate(re.split(r"\{(.*?)\}", name))]
    return ["".join(choice) for choice in product(*parts)]


def shown(name):
    """A name as the cell of a table: choices of words are spelled out, if there are few."""
    names = expanded(re.sub(r"\{((?:\w{1,2},)+\w{1,2})\}", lambda match: f"<{match[1].replace(',', ';')}>", name))
    names = [re.sub(r"<(.*?)>", lambda match: f"{{{match[1].replace(';', ',')}}}", one) for one in names]
    return "<br>".join(f"`{one}`" for one in (names if len(names) < 8 else [name]))


def columns_page():
    """doc/generated/columns.md."""
    text = NOTE + """# Columns, fields and keys

SI units; tensile stress is positive; [output files](../output.md) explains the terms.
`{a,b}` denotes several names, K the number of a joint or monolith from the right bank, NAME the name of a probe, wedge or zone,
DEPTH a depth, and `*` each element of a list. Points separate the keys of JSON.
"""
    for name, (purpose, rows) in columns().items():
        text += f"\n## {name}\n\n{purpose}.\n\n| Name | Unit | Meaning |\n|---|---|---|\n"
        text += "".join(f"| {shown(column)} | {unit} | {meaning} |\n" for column, unit, meaning in rows)
    return text


def entries_page(program):
    """doc/generated/entries.md: a table for each section."""
    def table(tree, path):
        own = {name: child for name, child in tree.items() if "pattern_description" in child}
        text = f"\n## {'/'.join(path)}\n\n| Entry | Default | Meaning |\n|---|---|---|\n" if own else ""
        for name, entry in own.items():
            default = f"`{entry['default_value']}`" if entry["default_value"] else ""
            text += f"| `{'/'.join([*path, name])}` | {escape(default)} | {meaning(entry)} |\n"
        return text + "".join(table(child, [*path, name]) for name, child in tree.items() if name not in own)

    return (NOTE + "# Entries of the input file\n\n`voussoir parameters` prints the same.\n" + table(json.loads(output(program, "parameters", "json")), [])
            + units_table())


def units_table():
    """The units of each dimension, from the sources."""
    rows = {}
    for unit, dimension in re.findall(r'\{"([^"]+)", "([^"]+)",', (ROOT / "source" / "base" / "units.cc").read_text(encoding="utf-8")):
        rows.setdefault(dimension, []).append(unit.replace("\\u00b0", "°"))
    head = "\n## Units\n\n`kN/m^3` is a unit weight.\n\n| Dimension | Units |\n|---|---|\n"
    return head + "".join(f"| {dimension} | {', '.join(units)} |\n" for dimension, units in rows.items())


def commands_page(program):
    """doc/generated/commands.md: the help of the program."""
    return NOTE + "# Commands\n\n" + "".join(f"    {line}".rstrip() + "\n" for line in output(program, "--help").splitlines())


def enclosed(text, head, brackets):
    """The code between the brackets, such as "()", after each match of a pattern."""
    for match in re.finditer(rf"{head}\s*\{brackets[0]}", text, re.S):
        depth, end = 1, match.end()
        for token in re.finditer(rf'"(?:[^"\\]|\\.)*"|[{brackets}]', text[end:]):
            depth += {brackets[0]: 1, brackets[1]: -1}.get(token[0], 0)
            if not depth:
                yield text[end:end + token.start()]
                break


def arguments(text, function):
    """The arguments of each call of a function that a pattern describes."""
    return enclosed(text, function, "()")


def message(code):
    """The text of a C++ expression: its string literals, with an ellipsis for everything between them and for formats."""
    parts = re.findall(r'"((?:[^"\\]|\\.)*)"|([^"]+)', re.sub(r'"xyz"\[\w+\]', "axis", code))
    text = "".join("…" if other.strip(" \n+<") else literal for literal, other in parts)
    text = re.sub(r"%[.\d]*(?:zu|td|[sdgfu])", "…", text).replace("%%", "%").replace("voussoir: warning: ", "")
    return re.sub("…+", "…", text.replace('\\"', '"').replace("\\n", " "))


def first_sentence(text):
    """The first sentence, or two if it is short."""
    sentences = re.split(r"(?<=[^ .][.]) (?=[A-Z\"`])", text)
    return " ".join(sentences[:1 + (len(sentences[0].split()) < 5)]).strip()


def listed(codes, least=5):
    """The first sentences of messages with at least so many words, as a list."""
    found = {first_sentence(message(code)) for code in codes}
    rows = [one for one in found if len(one.split()) >= least and not re.search("^…(; …|, and no|largest)|->", one)]
    return "".join(f"- {escape(one)}\n" for one in sorted(rows, key=lambda one: one.strip("… \"").lower()))


LITERAL = r'(?:"(?:[^"\\]|\\.)*"|[^";])*'  # code of a statement with its strings
# Sources in which all composed texts are warnings
OF_WARNINGS = ("checkpoint_file", "joint_reach", "mesh_groups", "mesh_warnings", "motion_files", "scene_ranges", "scene_relations", "transmitting_boundary")


def errors_of(text):
    """The arguments of errors, and texts of several statements that begin as errors do."""
    codes = [*arguments(text, r"(?:throw (?:InputError|ComputationError|CoarseWater|FactorTooLarge)"
                              r"|\b(?:fail|fail_in|refuse|refuse_name|too_coarse))")]
    more = rf"(?:\s*(?:if \([^;]*?\)\s*)?message\s*<< {LITERAL};)*"
    return codes + re.findall(rf'\b(?:text|message)\s*(?:<<|=)\s*("The (?!added mass|later|law){LITERAL};{more})', text)


def warnings_of(text, is_all):
    """The arguments of calls that warn, and the texts in functions whose name or comment mentions a warning; or in all."""
    head = r"\w*warnings?\w*\([^;{}]*\)(?: const)?"
    commented = r"/\*\*(?:(?!\*/).)*?warning(?:(?!\*/).)*\*/\s*std::(?:string|vector<std::string>)[^;{}]*"
    codes = [*arguments(text, r"(?:warnings\.push_back|\bwarn)"),
             *(f'"{code}"' for code in re.findall(r'"(?:voussoir: )?warning: ((?:[^"\\]|\\.|"\s*")*)"', text)),
             *re.findall(rf'"(?:voussoir: )?warning: " (?:<<|\+) ({LITERAL});', text)]
    for body in [text] if is_all else enclosed(text, f"(?:{head}|{commented})", "{}"):
        codes += re.findall(rf"return ({LITERAL});", body) + re.findall(rf"\b(?:text|warning)\s*(?:<<|\+?=)\s({LITERAL});", body)
        codes += [code.split(",", 2)[2] for code in arguments(body, "std::snprintf")]
    codes = [re.sub(r"^\s*(?:Warning)?\{[\w:]+,\s*", "", code) for code in codes]
    return [code for code in codes if '"' in code and not re.match(r'\s*" ?(?:Set|Refine|The static|A value|Is it|, ) ', code)]


def messages_page():
    """doc/generated/messages.md: warnings, conditions of entries without effect, and the errors of each directory of the sources."""
    sources = {file: file.read_text(encoding="utf-8") for file in sorted((ROOT / "source").glob("*/*.cc"))}
    warnings = [code for file, text in sources.items() for code in warnings_of(text, file.stem in OF_WARNINGS)]
    idle = [f'"{reason}"' for text in sources.values() for reason in re.findall(
        r'\{"((?:[^"\\]|\\.|"\s*")+)",\s*(?:\[\]\(const Scene|\w+,\s*\{")', text)]
    text = NOTE + f"""# Warnings and errors

These are the first sentences of the messages in the sources; … stands for names and numbers. The program also prints the remedy.
[Messages](../messages.md) explains the kinds of messages. Some messages that are composed of many parts are missing.

## Warnings

{listed(warnings)}
## Entries without effect

A warning names entries of the input file that have no effect, because `Foundation/Model` or `Joints/Model` does not read them, or for one of these reasons:

{listed(idle, 1)}"""
    for directory in sorted({file.parent for file in sources}):
        rows = listed(code for file, text in sources.items() if file.parent == directory for code in errors_of(text))
        text += f"\n## Errors: {directory.name}\n\n{rows}" if rows else ""
    return text


def meaning(entry):
    """The text of an entry, with a line for each choice and links to the pages that it names."""
    text = re.sub(r"doc/(\w+)\.md", r"[\1](../\1.md)", escape(entry["documentation"]))
    choices = re.match(r"\[(?:Selection|Bool) ?(.*?) ?\]", entry["pattern_description"])
    for choice in (choices[1] or "true|false").split("|") if choices else ():
        text = re.sub(rf"(?:^|(?<=\.) |; ){re.escape(choice)}: ", f"<br>`{choice}`: ", text)
    return text.removeprefix("<br>")


def escape(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def output(program, *words):
    return subprocess.run([program, *words], capture_output=True, text=True, check=True).stdout


def pages(program):
    """{path: text} of the pages; without a program those of columns and messages."""
    made = {"columns.md": columns_page(), "messages.md": messages_page()}
    if program:
        made |= {"entries.md": entries_page(program), "commands.md": commands_page(program)}
    return {PAGES / name: text for name, text in made.items()}


def stale(program=None):
    """Messages about pages that are not up to date."""
    return [f"{path.relative_to(ROOT)} is not up to date: run scripts/reference.py" for path, text in pages(program).items()
            if not path.is_file() or path.read_text(encoding="utf-8") != text]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--voussoir", type=Path, help="the program, by default build/voussoir")
    parser.add_argument("--check", action="store_true", help="write nothing")
    options = parser.parse_args()
    if options.check:
        errors = stale(options.voussoir)
        for error in errors:
            print(error, file=sys.stderr)
        return 1 if errors else 0
    for path, text in pages(options.voussoir or ROOT / "build" / "voussoir").items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
