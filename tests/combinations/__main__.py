#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes that cover every pair of choices of the program, and relations that must hold without a reference.

    python3 tests/combinations VOUSSOIR [--seed N] [--tenth] [--jobs N] [--list-refused FILE.md] [--draw] [--only K] [--output DIR]

Factors and their levels are the selections and switches of `voussoir parameters json`, the laws of the joints and the loads; only lengths,
levels and lists are given here. A greedy array of strength 2 covers each pair of levels of two factors by a scene in which both have an
effect. If the program refuses a scene, the responsible pair is found by experiments, and the scene is changed there. Prints the number of
pairs, the checks, and each failure with its command. Exit status: 1 if a relation fails or a pair is neither covered nor refused.

--tenth         the first tenth of the array
--list-refused  writes the refused pairs as a page of the manual
--draw          draws and validates the scenes only
--only K        the scene K of the array only
"""

import argparse
import os
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
from scenes import Failed, Net, Omitted, Refused, first_sentence  # noqa: E402

PAGE = HERE.parent.parent / "doc" / "generated" / "refused_pairs.md"


def assigned(scenes, at_most):
    """Relations of each scene: every relation meets every level of every factor once, as far as it applies; the last scenes have the rest."""
    chosen, met = [[] for _ in scenes], {relation: set() for relation in RELATIONS}
    for limit in (at_most, len(RELATIONS)):
        for number, (scene, idle) in enumerate(scenes):
            levels = {x for x in scene.items() if x[0] not in idle}
            while len(chosen[number]) < limit:
                fitting = [relation for relation, applies in RELATIONS.items() if relation not in chosen[number] and applies(scene)]
                fitting = [relation for relation in fitting if relation not in RARE or number % 10 == 3]
                best = max(fitting, key=lambda relation: len(levels - met[relation]), default=None)
                if best is None or not levels - met[best] or limit > at_most and not levels - met[best]:
                    break
                chosen[number].append(best)
                met[best] |= levels
        if at_most == len(RELATIONS):
            break
    return chosen


def checked(net, number, scene, relations):
    """Rows of a scene: relation, verdict, text."""
    case, rows, begin = Case(net, number, scene), [], time.time()
    try:
        case.first = case.run("first")
    except (Failed, Refused) as error:
        kind = "--validate accepts the scene, the run does not: " if isinstance(error, Refused) else ""
        return [("first run", "failed", f"{kind}{error}")], time.time() - begin
    for relation in (*ALWAYS, *relations):
        try:
            relation(case)
            rows.append((relation.__name__, "holds", ""))
        except Omitted as error:
            rows.append((relation.__name__, "no", str(error)))
        except (Failed, Refused) as error:
            rows.append((relation.__name__, "failed", f"{'refused: ' if isinstance(error, Refused) else ''}{error}"))
        except Exception as error:  # pylint: disable=broad-except
            rows.append((relation.__name__, "failed", f"{type(error).__name__}: {error}"))
    return rows, time.time() - begin


def page_of(net):
    """The tables of refused pairs and of three choices together, for the manual."""
    def rows(size):
        found = sorted((", ".join(f"`{name.replace('GRID', '...')} = {level}`" for name, level in sorted(levels)), message)
                       for levels, message in net.refused.items() if size == min(3, len(levels)))
        return [f"| {levels} | {first_sentence(message).replace('|', chr(92) + '|')} |" for levels, message in found]

    head = ["| Choices | Message |", "|---|---|"]
    return "\n".join(["<!-- Written by tests/combinations --list-refused. -->", "# Refused pairs of choices", "",
                      "The program refuses these pairs of choices, together with the defaults of all others.", "", *head, *rows(2), "",
                      "These choices are refused together only.", "", *head, *rows(3), *rows(1)]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("voussoir")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--tenth", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list-refused", type=Path, metavar="FILE.md")
    parser.add_argument("--draw", action="store_true")
    parser.add_argument("--only", type=int)
    parser.add_argument("--scenes", type=int, default=400, help="largest number of scenes")
    parser.add_argument("--output", type=Path, default=Path("combinations"))
    options = parser.parse_args()
    run_program.VOUSSOIR = str(Path(options.voussoir).resolve())
    directory = options.output.resolve() / f"seed-{options.seed[:12]}"
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    written_files(directory)
    net, begin = Net(directory, options.seed), time.time()
    print(f"{len(net.choices.factors)} factors, {len(net.levels)} levels, {len(net.pairs)} pairs, seed {options.seed}", flush=True)
    accepted = net.read_page(PAGE, 10 if options.tenth else 1)
    net.draw(7 if options.tenth else options.scenes, lambda net: options.list_refused and options.list_refused.write_text(page_of(net)),
             options.tenth)
    open_pairs, covered = net.open_pairs(), net.covered()
    refused = sum(len(levels) == 2 for levels in net.refused)
    print(f"{len(net.scenes)} scenes in {time.time() - begin:.0f} s: {len(covered)} pairs covered, {refused} refused, "
          f"{len(net.pairs) - len(covered) - refused - len(open_pairs)} without effect, {len(open_pairs)} open", flush=True)
    for row in accepted:
        print(f"    accepted, but refused in {PAGE.name}: {row}")
    for pair in sorted(map(sorted, open_pairs)) if not options.tenth else ():
        print(f"    open: {pair}")
    status = 1 if accepted or open_pairs and not options.tenth else 0
    if options.draw:
        return status
    relations, rows = assigned(net.scenes, 4 if options.tenth else 6), []
    todo = [k for k in range(len(net.scenes)) if options.only in (None, k + 1)]
    with ThreadPoolExecutor(options.jobs) as pool:
        for number, (found, seconds) in zip(todo, pool.map(lambda k: checked(net, k + 1, net.scenes[k][0], relations[k]), todo)):
            rows += [(number + 1, *row) for row in found]
            bad = [row for row in found if row[1] == "failed"]
            print(f"    scene {number + 1}: {len(found)} checks, {seconds:.0f} s", flush=True)
            for name, _, text in bad:
                print(f"        FAILED {name}: {text}", flush=True)
    print("\n| relation | holds | does not apply | failed |\n|---|---|---|---|")
    for name in dict.fromkeys(row[1] for row in rows):
        print("|", name, "|", " | ".join(str(sum(row[1:3] == (name, verdict) for row in rows)) for verdict in ("holds", "no", "failed")), "|")
    failed = [row for row in rows if row[2] == "failed"]
    print(f"\n{len(covered)} pairs covered, {len(rows)} checks, {len(failed)} failures, {time.time() - begin:.0f} s")
    for number, name, _, text in failed:
        print(f"scene {number}, {name}: {text}\n    {net.choices.name(net.scenes[number - 1][0])}\n    cd {directory}; voussoir scene-{number}.prm")
    return 1 if failed else status


if __name__ == "__main__":
    sys.exit(main())
