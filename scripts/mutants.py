#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutation test. Builds all mutants of scripts/mutants.txt into one program, in a scratch directory, and runs the most
relevant tests against each mutant until one fails. The mutant is killed if that test passes without the mutant. Mutants of Python
(scripts/mutants_python.txt) require no build: each is applied to a copy of scripts, package and tests, which runs with the program
of build/.

    scripts/mutants.py [--scratch build-mutants] [--only REGEX] [--python] [--random N | --invent N] [--seed TEXT] [--all] [--table FILE]
                       [--check] [--no-build] [--build build] [--timeout 300]

--check only checks that all mutants fit the sources. --all also runs the other tests against survivors. --random selects N mutants
by the seed, except those of headers, and builds only their targets: the rest comes from ccache after scripts/build.sh.

--invent makes N new mutants by the seed: each changes a random line of source/ by one of OPERATORS (another arithmetic operator or comparison,
&& and ||, == and !=, another number, or one statement less). One that does not compile without a warning is replaced by the next. Each is built by itself, and
meets the tests that the lists name for its source or, without one, for its directory. Survivors need a reader: a change of speed, of a
message or of a value that is never used is no error of the tests.

Prints a table in Markdown and the survivors. Exit status: 0 none survives, 1 some do, 2 a mutant does not fit the sources.
"""

import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LISTS = ROOT / "scripts/mutants.txt", ROOT / "scripts/mutants_python.txt"
HEADER = """#ifndef voussoir_mutant_h
#define voussoir_mutant_h

#include <cstdlib>
#include <cstring>

inline const char *const voussoir_mutant_name = std::getenv("VOUSSOIR_MUTANT");
inline int voussoir_mutant_number(const char *const *names)
{
  for (int i = 1; names[i - 1] != nullptr; ++i)
    if (voussoir_mutant_name != nullptr && std::strcmp(names[i - 1], voussoir_mutant_name) == 0)
      return i;
  if (voussoir_mutant_name != nullptr && *voussoir_mutant_name != 0)
    std::abort();
  return 0;
}
inline const char *const voussoir_mutant_names[] = {%s, nullptr};
inline const int voussoir_mutant = voussoir_mutant_number(voussoir_mutant_names);

#endif
"""


# Random mutants: a pattern outside of texts and comments, and what its occurrence becomes.
OPERATORS = [*((f"(?<= ){re.escape(old)}(?= )", new) for old, new in (
    ("+", "-"), ("-", "+"), ("*", "/"), ("/", "*"), ("<", "<="), ("<=", "<"), (">", ">="), (">=", ">"), ("&&", "||"), ("||", "&&"),
    ("==", "!="), ("!=", "=="))),
    (r"(?<![\w.])\d+(\.\d*)?(e[-+]?\d+)?(?![\w.])", lambda number: another_number(number)),
    (r"^ *(?!return\b)[\w.:>\[\]-]+(\(.*\)|\[.*\]| [-+*/]?= .*);$", ";")]
NEEDED = ("CMakeLists.txt", "CITATION.cff", "LICENSE", "README.md", "benchmarks", "cmake", "doc/Doxyfile.in", "include", "meshes", "prm", "python",
          "scripts", "source", "tests")

SKIPPED = "not tested: its tests are skipped here"


class Misfit(Exception):
    """A mutant that does not fit the sources, or a line of the list that cannot be understood."""


def read_list(path):
    """The mutants: dictionaries with name, room, file, tests (a list), meaning and edits (original, mutated)."""
    mutants = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        mutant = mutants[-1] if mutants else None
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("- "):
            if not mutant["edits"] or mutant["edits"][-1][1]:
                mutant["edits"].append([[], []])
            mutant["edits"][-1][0].append(line[2:])
        elif line.startswith("+ "):
            mutant["edits"][-1][1].append(line[2:])
        elif line.startswith("  "):
            mutant["meaning"] = (mutant["meaning"] + " " + line.strip()).strip()
        else:
            fields = line.split(" | ")
            if len(fields) != 4:
                raise Misfit(f"{path.name}, line {number}: expected name | group | file | tests")
            name, room, file, tests = (f.strip() for f in fields)
            mutants.append({"name": name, "room": room, "file": file, "tests": tests.split("|"), "meaning": "",
                            "edits": []})
    names = [m["name"] for m in mutants]
    for name in names:
        if names.count(name) > 1:
            raise Misfit(f"two mutants have the name {name}")
    for m in mutants:
        if not m["edits"] or any(not new for _, new in m["edits"]):
            raise Misfit(f"mutant {m['name']}: it has no text to change, or none to change it to")
        m["edits"] = [("\n".join(old), "\n".join(new)) for old, new in m["edits"]]
    return mutants


def is_expression(text):
    """True if the text can be put in parentheses. A rough check: brackets pair off, no operator at an end, no assignment, no statement, no list."""
    open_ones = []
    if text.strip().startswith("{"):
        return False
    for c in re.sub(r"'.'|\"[^\"]*\"", "", text):
        if c == "," and not open_ones:
            return False
        if c in "([{":
            open_ones.append(c)
        elif c in ")]}" and (not open_ones or open_ones.pop() + c not in ("()", "[]", "{}")):
            return False
    text = re.sub(r"\+\+$|--$", "", text.strip())
    return not open_ones and not re.search(r"^[/%,=<>|?:)]|[-+*/%,=<>&|?:(]$|(?<!\d)\.$|;|^(return|if|for|while|else)\b|(?<![=!<>+\-*/%&|^])=(?!=)", text)


def binds_less(text, before, after):
    """Would brackets around this expression change what its neighbours mean? @p before, @p after: the source around it."""
    inner = re.sub(r"'.'|\"[^\"]*\"", "", text)
    while (shorter := re.sub(r"\([^()]*\)|\[[^][]*\]|\{[^{}]*\}", "", inner)) != inner:
        inner = shorter
    ends = not after.strip() or after.lstrip()[0] in ";,)]}:"
    if re.search(r"[+\-*/%&|^]=", inner):
        return not ends
    levels = [level for level, _, symbol in operators(inner) if symbol != "!"]
    if not levels:
        return False
    own, (left, symbol), right = min(levels), last_operator(before), first_operator(after)
    return left > own or left == own and symbol in "-/%" or right > own


LEVELS = {"?": 1, "||": 2, "&&": 3, "==": 4, "!=": 4, "<": 5, ">": 5, "<=": 5, ">=": 5, "+": 6, "-": 6, "*": 7, "/": 7, "%": 7}


def operators(text):
    """Level, place and symbol of the operators in an expression without brackets; unary ones have the level 8. Lists of template
    arguments and arrows are no operators."""
    text = re.sub(r"->|::|\+\+|--|<<|>>|\d[eE][-+]\d", lambda m: "x" * len(m[0]), re.sub(r"<[\w:, ]*>(?=\s*$|\(|::|x)", lambda m: "x" * len(m[0]), text))
    found = []
    for match in re.finditer(r"\|\||&&|[=!<>]=|[-+*/%<>?!]", text):
        symbol, is_binary = match[0], re.search(r"[\w)\]\"'.]\s*$", text[:match.start()])
        if is_binary and symbol != "!":
            found.append((LEVELS[symbol], match.start(), symbol))
        elif symbol in "-!*+":
            found.append((8, match.start(), "!"))
    return found


def last_operator(before):
    """Level and symbol of the operator at the end of the source before an expression, or level 0."""
    line = before[-200:]
    at_end = [(level, symbol) for level, place, symbol in operators(line) if place + len(symbol) == len(line)]
    return at_end[0] if at_end else (0, "")


def first_operator(after):
    """Level of the operator at the beginning of the source after an expression, or 0."""
    match = re.match(r"\|\||&&|[=!<>]=|[-+*/%<>?]", after.lstrip())
    return LEVELS.get(match[0], 0) if match and not re.match(r"\+\+|--|->|<<|>>|[-+*/%]=", after.lstrip()) else 0


def place_of(old, text, mutant):
    """Begin and end of the original text in the source."""
    pattern = r"\s+".join(re.escape(word) for word in old.split())
    found = list(re.finditer(pattern, text))
    if len(found) != 1:
        raise Misfit(f"mutant {mutant['name']}: its original text occurs {len(found)} times in {mutant['file']}, not once: {old}")
    return found[0].span()


def mutate_script(text, mutant):
    """The text of a script in Python with this mutant instead of the original."""
    for old, new in mutant["edits"]:
        begin, end = place_of(old, text, mutant)
        text = text[:begin] + new + text[end:]
    try:
        compile(text, mutant["file"], "exec")
    except SyntaxError as error:
        raise Misfit(f"mutant {mutant['name']}: it is no Python: {error}") from error
    return text


def mutate(text, mutant, number):
    """The text of a source with the choice of this mutant in it."""
    chosen = f"(voussoir_mutant == {number})"
    for old, new in mutant["edits"]:
        begin, end = place_of(old, text, mutant)
        old = text[begin:end]
        before = re.sub(r"//[^\n]*", "", text[:begin]).rstrip()
        if "MUTANT" in new:
            changed = new.replace("MUTANT", chosen)
        elif old.endswith(";") and before[-1] in ";{})":
            changed = f"{{ if {chosen} {{ {new} }} else {{ {old} }} }}"
        else:
            for part in (old.rstrip(";"), new.rstrip(";")):
                if not is_expression(part):
                    raise Misfit(f"mutant {mutant['name']}: this is no expression, so it cannot be chosen by ?: (write MUTANT): {part}")
            if (re.match(r"(&&|!=|[-+*&]) ", old) and re.search(r"[\w)\]]$", before)) or text[end:].startswith(("(", "[")):
                raise Misfit(f"mutant {mutant['name']}: brackets would part this from its neighbours (write MUTANT): {old}")
            if binds_less(old.rstrip(";"), before, text[end:] if not old.endswith(";") else ";"):
                raise Misfit(f"mutant {mutant['name']}: its neighbours bind more, so brackets change what it means without the "
                             f"mutant: {old}")
            semicolon = ";" if old.endswith(";") else ""
            changed = f"({chosen} ? ({new.rstrip(';')}) : ({old.rstrip(';')})){semicolon}"
        text = text[:begin] + changed + text[end:]
    return text


def make_tree(mutants, tree):
    """Copies what git has, and puts the mutants in. Files that do not change keep their time."""
    texts = sources(*NEEDED)
    names = ", ".join(f'"{m["name"]}"' for m in mutants)
    texts["include/voussoir/mutant.h"] = (HEADER % names).encode()
    errors = []
    for number, mutant in enumerate(mutants, 1):
        file = mutant["file"]
        try:
            if file not in texts:
                raise Misfit(f"mutant {mutant['name']}: there is no file {file}")
            texts[file] = mutate(texts[file].decode(), mutant, number).encode()
        except Misfit as misfit:
            errors.append(str(misfit))
    if errors:
        raise Misfit("\n".join(errors))
    mutated = {m["file"] for m in mutants}
    for part in {file for file in mutated if file.endswith(".h") and b"#ifndef voussoir_" not in texts[file]}:
        name = Path(part).name.encode()  # is included inside of namespaces: the choice is declared where that is done
        mutated = mutated - {part} | {file for file, text in texts.items() if b'#include "' + name in text or b"/" + name + b">" in text}
    for file in mutated:
        texts[file] = b"#include <voussoir/mutant.h>\n" + texts[file]
    if mutated:  # they compile with the flags of all others, so that ccache has these, but their warnings are no errors
        texts["CMakeLists.txt"] += f"set_source_files_properties({' '.join(sorted(mutated))} PROPERTIES COMPILE_OPTIONS -Wno-error)\n".encode()
    write_tree(texts, tree)


def sources(*needed):
    """File -> content of what git has, or would have, of these files and directories."""
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard", "--", *needed],
                            capture_output=True, check=True).stdout.decode().split("\n")
    return {file: (ROOT / file).read_bytes() for file in listed if file and (ROOT / file).is_file()}


def write_tree(texts, tree):
    """Updates a tree to these files. Unchanged files keep their time."""
    for old in (f for f in tree.rglob("*") if f.is_file() and f.relative_to(tree).parts[0] != "build"):
        if str(old.relative_to(tree)) not in texts:
            old.unlink()
    for file, text in texts.items():
        path = tree / file
        if not path.exists() or path.read_bytes() != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text)
            path.chmod((ROOT / file).stat().st_mode if (ROOT / file).exists() else 0o644)


def another_number(text):
    """A whole number plus one, another one doubled."""
    if text.isdigit():
        return str(int(text) + 1)
    number = f"{2 * float(text) or 1:.12g}"
    return number if re.search(r"[.e]", number) else number + "."


def without_texts(source):
    """A source with blanks instead of its texts and comments."""
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(\\.|[^\"\\\n])*\"|'(\\.|[^'\\])'|^#[^\n]*", lambda m: re.sub(r"[^\n]", " ", m[0]), source, flags=re.S | re.M)


def changes_of(line, code):
    """All lines that OPERATORS make of this one. @p code: the line without texts."""
    found = [(match, new) for pattern, new in OPERATORS for match in re.finditer(pattern, code) if match[0].count("(") == match[0].count(")")]
    return [line[:m.start()] + (new if isinstance(new, str) else new(m[0])) + line[m.end():] for m, new in found]


def invent(seed):
    """Random mutants of the sources, without end: as those of read_list(), with "text", the whole mutated source, instead of edits."""
    listed = read_list(LISTS[0])
    lines = {}  # (file, index) -> the lines that this one may become
    texts = {file: text.decode() for file, text in sorted(sources("source").items()) if file.endswith(".cc")}
    for file, text in texts.items():
        for i, (line, code) in enumerate(zip(text.split("\n"), without_texts(text).split("\n"))):
            if changes := changes_of(line, code):
                lines[file, i] = changes
    chance = random.Random(seed)
    while True:
        file, i = chance.choice(list(lines))
        whole, new = texts[file].split("\n"), chance.choice(lines[file, i])
        near = [m for m in listed if m["file"] == file] or [m for m in listed if Path(m["file"]).parent == Path(file).parent]
        tests = "|".join(dict.fromkeys(test for m in near for test in m["tests"]))
        yield {"name": f"{file}:{i + 1}", "room": Path(file).parent.name, "file": file, "tests": [tests or "."], "edits": [],
               "meaning": f"`{whole[i].strip()}` is `{new.strip()}`".replace("|", "\\|"), "text": "\n".join([*whole[:i], new, *whole[i + 1:]])}


def build(tree, directory, patterns=None):
    """Builds the program, and all tests or those of these patterns, with the flags of scripts/build.sh and at the same place in the tree.
    Whether it compiles."""
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    samples = ROOT.parent / "shared/reference/data/peers"
    log_name = tree.parent / "build.log"
    configure = ["cmake", "-S", str(tree), "-B", str(directory), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON",
                 "-DVOUSSOIR_UNITY=ON", f"-DVOUSSOIR_SAMPLES={samples}", *launcher]
    compilation = ["cmake", "--build", str(directory), "--parallel", str(os.cpu_count())]
    for command in (configure, compilation):
        if command is compilation:
            command += ["--target", *(targets_of(directory, patterns) if patterns else ["all"]), "--", "-k", "0"]
        with open(log_name, "a") as log:
            environment = {**os.environ, "CCACHE_BASEDIR": str(tree), "CCACHE_NOHASHDIR": "1"}
            if subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, env=environment).returncode != 0:
                return False
    return True


def targets_of(directory, patterns):
    """Targets of a configured build that the tests of these patterns require."""
    text = (directory / "tests" / "CTestTestfile.cmake").read_text()
    targets = {"voussoir", "voussoir-contact", "start_server"}
    for name, words in re.findall(r"^add_test\((\S+) (.*)\)$", text, re.M):
        if any(re.search(pattern, name.strip("[]=")) for pattern in patterns):
            targets |= set(re.findall(rf'"{re.escape(str(directory))}/tests/(test_\w+)"', words))
    return sorted(targets)


def make_overlay(overlay, program, seconds):
    """Copies scripts, package and tests, with links to what else they read; the tests run with the program's build."""
    write_tree(sources("scripts", "python", "tests"), overlay)
    for path in (path for path in ROOT.iterdir() if not path.name.startswith(("build", ".")) and not (overlay / path.name).exists()):
        (overlay / path.name).symlink_to(path)
    text = (program / "tests" / "CTestTestfile.cmake").read_text()
    text = text.replace(f'WORKING_DIRECTORY "{program}/tests"', f'WORKING_DIRECTORY "{overlay}/build"').replace(f'"{ROOT}/tests/', f'"{overlay}/tests/')
    text = re.sub(r'TIMEOUT "\d+"', f'TIMEOUT "{seconds}"', text)
    (overlay / "build").mkdir(exist_ok=True)
    (overlay / "build" / "CTestTestfile.cmake").write_text(re.sub(r"^subdirs\(.*\)$", "", text, flags=re.M))


@contextmanager
def put_into(overlay, mutant, directory):
    """The overlay with this mutant if it is one of Python, the tree with it and its build if it is a random one; whether it can be run."""
    path = (directory.parent if "text" in mutant else overlay) / mutant["file"]
    sound = path.read_text(encoding="utf-8") if is_script(mutant) or "text" in mutant else None
    if sound is not None:
        path.write_text(mutant["text"] if "text" in mutant else mutate_script(sound, mutant), encoding="utf-8")
    try:
        yield "text" not in mutant or build(directory.parent, directory, mutant["tests"])
    finally:
        if sound is not None:
            path.write_text(sound, encoding="utf-8")


def is_script(mutant):
    return mutant["file"].endswith(".py")


def run_tests(directory, pattern, mutant):
    """Runs the tests of this pattern against a mutant; whether there are any, whether any ran, and the one that failed."""
    environment = {**os.environ, "VOUSSOIR_MUTANT": mutant, "PYTHONDONTWRITEBYTECODE": "1"}  # bytecode of a mutant may pass for that of the next
    if (scripts := directory.parent / "scripts").is_dir():
        environment["VOUSSOIR_SCRIPTS"] = str(scripts)
    result = subprocess.run(["ctest", "-R", pattern, "--stop-on-failure", "--no-tests=ignore", "--timeout", "300"],
                            cwd=directory, env=environment, capture_output=True, text=True)
    tests = re.findall(r"^ *\d+/\d+ Test .*$", result.stdout, re.M)
    ran = [line for line in tests if not re.search(r"\*\*\*(Skipped|Not Run)", line)]
    failed = re.search(r"Test +#\d+: (\S+) [ .]*\*\*\*(?!Skipped|Not Run)", result.stdout)
    if result.returncode != 0 and failed is None:
        sys.exit(f"mutants: ctest failed: {result.stdout[-2000:]}{result.stderr}")
    return bool(tests), bool(ran), failed[1] if result.returncode != 0 else None


def kill(directory, mutant, everything):
    """The test that notices the mutant, SKIPPED if none of its tests ran, or None."""
    exist = ran = False
    for pattern in mutant["tests"] + (["."] if everything else []):
        found, some_ran, failed = run_tests(directory, pattern, mutant["name"])
        exist, ran = exist or found, ran or some_ran
        if failed:
            return failed
    if not exist:
        raise Misfit(f"mutant {mutant['name']}: there are no tests {'|'.join(mutant['tests'])}")
    return None if ran else SKIPPED


def check(compiled, scripts, scratch):
    """Throws Misfit unless all mutants fit the sources."""
    errors = []
    for mutant in scripts:
        try:
            mutate_script((ROOT / mutant["file"]).read_text(encoding="utf-8"), mutant)
        except (OSError, Misfit) as error:
            errors.append(f"{error}")
    try:
        make_tree(compiled, scratch / "tree")
    except Misfit as misfit:
        errors.append(str(misfit))
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    if errors:
        raise Misfit("\n".join(errors))


def prepare(mutants, options, directory, overlay):
    """Builds what these mutants need."""
    compiled = [m for m in mutants if not is_script(m)]
    if compiled and not options.no_build:
        chosen = compiled if options.random else [m for m in read_list(LISTS[0]) if not is_script(m)]
        make_tree(chosen, directory.parent)
        if not build(directory.parent, directory, [p for m in compiled for p in m["tests"]] if options.random and not options.all else None):
            sys.exit(f"mutants: the build failed; see {directory.parent.parent / 'build.log'}")
    if len(compiled) < len(mutants):
        overlay.mkdir(parents=True, exist_ok=True)
        make_overlay(overlay, options.build.resolve(), options.timeout)


def judge(mutants, count, options, directory, overlay):
    """Runs the tests against that many that compile; prints the table. Its lines, and the survivors."""
    lines = ["| group | mutant | what it means | killed by |", "|---|---|---|---|"]
    print("\n".join(lines), flush=True)
    survivors, sound = [], {}
    for mutant in mutants:
        if len(lines) == 2 + count:
            break
        begin, place = time.monotonic(), overlay / "build" if is_script(mutant) else directory
        with put_into(overlay, mutant, directory) as is_built:
            if not is_built:
                print(f"    {mutant['name']} does not compile: {mutant['meaning']}", file=sys.stderr, flush=True)
                continue
            killer = kill(place, mutant, options.all)
        if "text" in mutant:
            place = options.build.resolve()  # without mutant
        if killer == SKIPPED:
            sound[place, killer] = True
        elif killer and (place, killer) not in sound:
            sound[place, killer] = run_tests(place, f"^{re.escape(killer)}$", "")[2] is None
        said = "**nothing**" if killer is None else killer if sound[place, killer] else f"**{killer} fails without any mutant**"
        lines.append(f"| {mutant['room']} | {mutant['name']} | {mutant['meaning']} | {said} |")
        print(lines[-1], flush=True)
        print(f"    {time.monotonic() - begin:.0f} s", file=sys.stderr, flush=True)
        if killer is None or not sound[place, killer]:
            survivors.append(mutant["name"])
    return lines, survivors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scratch", type=Path, default=ROOT / "build-mutants", help="directory")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="build with the program for the mutants of Python")
    parser.add_argument("--only", default="", help="mutants whose name has this regular expression")
    parser.add_argument("--python", action="store_true", help="those of Python only")
    parser.add_argument("--random", type=int, metavar="N", help="that many of them")
    parser.add_argument("--invent", type=int, metavar="N", help="that many new ones, by random changes of source/")
    parser.add_argument("--seed", default="", help="of the choice")
    parser.add_argument("--all", action="store_true", help="all other tests against those that survive")
    parser.add_argument("--table", type=Path, help="write the table to this file")
    parser.add_argument("--check", action="store_true", help="look only whether all mutants fit the sources")
    parser.add_argument("--timeout", type=int, default=300, help="of each test for mutants of Python [s]")
    parser.add_argument("--no-build", action="store_true", help="the scratch directory is built already")
    options = parser.parse_args()
    scratch = options.scratch.resolve()
    directory, overlay = scratch / "tree" / "build", scratch / "python"
    try:
        mutants = [mutant for path in LISTS for mutant in read_list(path)]
        if options.check:
            check([m for m in mutants if not is_script(m)], [m for m in mutants if is_script(m)],
                  Path(os.environ.get("TMPDIR", "/tmp")) / f"voussoir-mutants-{os.getpid()}")
            print(f"{len(mutants)} mutants fit the sources, {sum(map(is_script, mutants))} of them in Python.")
            return 0
        chosen = [m for m in mutants if re.search(options.only, m["name"]) and (is_script(m) or not options.python)]
        if options.random:
            chosen = [m for m in chosen if not m["file"].endswith(".h")]
            chosen = random.Random(options.seed).sample(chosen, min(options.random, len(chosen)))
            print(f"{len(chosen)} mutants by the seed {options.seed or '(none)'}: {', '.join(m['name'] for m in chosen)}\n", flush=True)
        if options.invent:
            write_tree(sources(*NEEDED), directory.parent)
        else:
            prepare(chosen, options, directory, overlay)
        count = options.invent or len(chosen)
        lines, survivors = judge(invent(options.seed) if options.invent else chosen, count, options, directory, overlay)
    except Misfit as misfit:
        print(f"mutants: {misfit}", file=sys.stderr)
        return 2
    if options.table:
        options.table.write_text("\n".join(lines) + "\n")
    print(f"\n{count} mutants, {len(survivors)} survive{': ' + ', '.join(survivors) if survivors else ''}")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
