#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes that cover every pair of choices of the program, and relations that must hold without a reference.

    python3 tests/combinations VOUSSOIR [--seed N] [--tenth] [--jobs N] [--list-refused FILE.md] [--draw] [--only K] [--relations N]
                                 [--output DIR] [--resume]

Factors and their levels are the selections and switches of `voussoir parameters json`, the laws of the joints and the loads; only lengths,
levels and lists are given here. A greedy array of strength 2 covers each pair of levels of two factors by a scene in which both have an
effect. If the program refuses a scene, the responsible pair is found by experiments, and the scene is changed there. Prints the number of
pairs, the checks, and each failure with its command. Exit status: 1 if a relation fails or a pair is neither covered nor refused,
or the program accepts a pair that is refused in the manual.

--tenth         the first seven scenes
--list-refused  writes the refused pairs as a page of the manual
--draw          draws and validates the scenes only
--relations N   relations of a scene that need other runs (default 3)
--resume        goes on with the array in this directory; the scenes that have been checked are not checked again
--only K        the scene K of the last array in this directory only, with all relations
"""

import argparse
import ast
import math
import os
import re
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import run_program  # noqa: E402
from choices import written_files  # noqa: E402
from relations import ALWAYS, RARE, RELATIONS, Case  # noqa: E402
from scenes import Failed, Net, Omitted, Refused, cpu_time, first_sentence  # noqa: E402

SLOW = 20.  # first run of a scene, above which it has fewer relations [s]
DRAWN, CHECKED = "scenes.txt", "checked"  # file, and mark of a scene in it
PAGE = HERE.parent.parent / "doc" / "generated" / "refused_pairs.md"


def chosen(number, scene, idle, met, at_most):
    """Relations of a scene: every relation meets every level of every factor once, as far as it applies. met: levels of each relation so far."""
    result, levels = [], {x for x in scene.items() if x[0] not in idle}
    fitting = [relation for relation, applies in RELATIONS.items() if (relation not in RARE or number % 10 == 3) and applies(scene)]
    for relation in sorted(fitting, key=lambda relation: -len(levels - met[relation]))[:at_most]:
        if levels - met[relation]:
            result.append(relation)
            met[relation] |= levels
    return result


def first(case):
    """The first run of a scene. Some choices leave no equilibrium, such as water on a cracked base without self-weight; without an impact
    rule a run may become unstable (doc/failures.md)."""
    try:
        case.first = case.run("first")
    except (Failed, Refused) as error:
        unstable = "|has become unstable" if case.scene["Dynamics/Impact"] == "none" else ""
        if re.search("did not converge|no equilibrium|moves without limit" + unstable, str(error)):
            raise Omitted(str(error)) from None
        raise


def always_converges(scene):
    """The equations of the paper can cycle (doc/failures.md), depending on the order of the nodes."""
    return scene.get("Joints/Equations") != "paper"


def checked(case, relation):
    """Number of the scene, relation, verdict, seconds."""
    verdict, begin = "holds", time.time()
    try:
        relation(case)
    except Omitted as error:
        verdict = "does not apply"
        if relation is first:
            print(f"    no solution of scene {case.number}: {error}\n        {case.net.choices.name(case.scene)}", flush=True)
    except Exception as error:  # pylint: disable=broad-except
        if "did not converge" in str(error) and not always_converges(case.scene):
            print(f"    no solution of scene {case.number}, {relation.__name__}: {error}", flush=True)
            return case.number, relation.__name__, "does not apply", time.time() - begin
        verdict = "failed"
        print(f"    FAILED scene {case.number}, {relation.__name__}: {'' if isinstance(error, Failed) else type(error).__name__ + ': '}{error}\n"
              f"        {case.net.choices.name(case.scene)}\n        cd {case.net.directory}; voussoir scene-{case.number}.prm", flush=True)
    return case.number, relation.__name__, verdict, time.time() - begin


def all_checked(case, relations):
    begin = time.time()
    rows = [checked(case, relation) for relation in relations]
    print(f"    scene {case.number}: {len(rows)} checks, {time.time() - begin:.0f} s:",
          ", ".join(f"{row[1]} {row[3]:.0f}" for row in rows if row[3] >= 10), flush=True)
    if all(row[2] != "failed" for row in rows):
        record(case.net, case.number, CHECKED)
    return rows


def record(net, number, what):
    """Writes a line for this scene: what was drawn, None if it has no solution, or CHECKED after its checks without a failure."""
    with (net.directory / DRAWN).open("a") as file:
        print((number, what), file=file)


def page_of(net):
    """The tables of refused pairs and of three choices together, for the manual, with one row for each message. Messages about files of
    this net, and a zone that is only in one of its meshes, are left out."""
    def rows(size):
        found = {}
        for levels, message in net.refused.items():
            if size == min(3, len(levels)) and "heel" not in message and str(net.directory) not in message:
                message = re.sub(r"\(-?[\d.e-]+, -?[\d.e-]+, -?[\d.e-]+\) m", "(x, y, z)", first_sentence(message)).replace("|", "\\|")
                found.setdefault(message, []).append(", ".join(f"`{name.replace('GRID', '...')} = {level}`" for name, level in sorted(levels)))
        return sorted(f"| {'<br>'.join(sorted(levels))} | {message} |" for message, levels in found.items())

    head = ["| Choices | Message |", "|---|---|"]
    return "\n".join(["<!-- Written by tests/combinations --list-refused. -->", "# Refused pairs of choices", "",
                      "The program refuses these pairs of choices, together with the defaults of all others.", "", *head, *rows(2), "",
                      "These choices are refused alone, or three together.", "", *head, *rows(3), *rows(1)]) + "\n"


def drawn_before(file, number):
    """The scene with this number, as drawn by the last run; a scene may depend on whether those before it have a solution."""
    found = [row for row in map(ast.literal_eval, file.read_text().splitlines() if file.exists() else ()) if row[0] == number and isinstance(row[1], tuple)]
    return found[-1:] or sys.exit(f"combinations: the last run in {file.parent} drew no scene {number}.")


def resumed(net, drawn, page):
    """Number of the scenes in the directory. Pairs of checked scenes are covered, unless a scene has no solution; refused pairs are those of the
    list."""
    if page:
        net.read_page(page, math.inf)
    rows = [ast.literal_eval(line) for line in drawn.read_text().splitlines()]
    without, done = ({number for number, scene in rows if scene == mark} for mark in (None, CHECKED))
    for number, scene in rows:
        facts = net.validated(scene[0]) if isinstance(scene, tuple) and number in without | done else ""
        if not isinstance(facts, str):
            net.scenes.append((scene[0], net.learn_idle(scene[0], facts)))
            if number in without:
                net.unsolved()
    print(f"    resumed: {net.counts()}", flush=True)
    return max(number for number, _ in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("voussoir")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--tenth", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list-refused", type=Path, metavar="FILE.md")
    parser.add_argument("--draw", action="store_true")
    parser.add_argument("--only", type=int)
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--scenes", type=int, default=1000, help="largest number of scenes")
    parser.add_argument("--relations", type=int, default=3)
    parser.add_argument("--output", type=Path, default=Path("combinations"))
    options = parser.parse_args()
    run_program.VOUSSOIR = str(Path(options.voussoir).resolve())
    directory = options.output.resolve() / f"seed-{options.seed[:12]}"
    if options.only is None and not options.resume:
        shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True, exist_ok=True)
    written_files(directory)
    net, begin, drawn = Net(directory, options.seed), time.time(), directory / DRAWN
    print(f"{len(net.choices.factors)} factors, {len(net.levels)} levels, {len(net.pairs)} pairs, seed {options.seed}", flush=True)
    accepted = net.read_page(PAGE, 10) if options.tenth else []
    met, checks, rows = {relation: set() for relation in RELATIONS}, [], []
    before = resumed(net, drawn, options.list_refused) if options.resume else 0
    with ThreadPoolExecutor(options.jobs) as pool:
        array = drawn_before(drawn, options.only) if options.only else enumerate(net.draw(7 if options.tenth else options.scenes), before + 1)
        for number, (scene, idle) in array:
            if options.list_refused:
                options.list_refused.write_text(page_of(net))
            record(net, number, (scene, idle))
            if options.draw:
                continue
            case, start = Case(net, number, scene), time.time()
            rows.append(checked(case, first))
            if case.first:
                is_slow = time.time() - start > SLOW
                at_most = len(RELATIONS) if options.only else (4, 0)[is_slow] if options.tenth else 1 if is_slow else options.relations
                relations = (*ALWAYS, *chosen(number, scene, idle, met, at_most))
                checks.append(pool.submit(all_checked, case, relations))
            elif rows[-1][2] != "failed":
                net.unsolved()
                record(net, number, None)
        rows += [row for check in checks for row in check.result()]
    if options.list_refused:
        options.list_refused.write_text(page_of(net))
    print("\n| relation | holds | does not apply | failed | time [s] |\n|---|---|---|---|---|")
    for name in dict.fromkeys(row[1] for row in rows):
        of_relation = [row for row in rows if row[1] == name]
        print("|", name, "|", " | ".join(str(sum(row[2] == verdict for row in of_relation)) for verdict in ("holds", "does not apply", "failed")), "|",
              f"{sum(row[3] for row in of_relation):.0f} |")
    pairs, failures = net.counts(), sum(row[2] == "failed" for row in rows)
    if not options.tenth and options.only is None:
        accepted = Net(directory, options.seed).read_page(PAGE, 1)
    for row in accepted:
        print(f"accepted, but refused in {PAGE.name}: {row}")
    for pair in sorted(map(sorted, net.open_pairs())) if not options.tenth else ():
        print(f"open: {pair}")
    print(f"\n{len(net.scenes)} scenes, {pairs}, {len(rows)} checks, {failures} failures, {time.time() - begin:.0f} s, "
          f"{cpu_time():.0f} s of CPU time")
    return 1 if failures or accepted or net.open_pairs() and not options.tenth else 0


if __name__ == "__main__":
    sys.exit(main())
