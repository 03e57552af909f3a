# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls of the program; the array of scenes that covers all pairs of levels."""

import itertools
import json
import os
import random
import re
import subprocess
import threading
import zlib

import run_program
from choices import COSTLY, DAMS, Choices, text_of
from run_program import Server, read_mesh, write_mesh

ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
        "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}  # without it, the program restarts itself


class Refused(Exception):
    """Status 2: the program does not accept the scene."""


class Failed(Exception):
    """A relation does not hold, or a run ended in another way than with status 0 or 2."""


class Omitted(Exception):
    """A relation does not apply."""


OF_THREAD = threading.local()  # its server


def call(words, ranks=1, threads=1, limit=300):
    """Standard output. Throws Refused with the message of one paragraph, or Failed."""
    command = " ".join(f"'{word}'" if re.search(r"[ ;]", word) else word for word in words)
    if os.path.isfile(Server.library) and ranks == threads == 1 and words[0] != "report":
        if not hasattr(OF_THREAD, "server"):
            OF_THREAD.server = Server(run_program.VOUSSOIR, ROOT)
        result = OF_THREAD.server.run(words, limit)
    else:
        start = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
        try:
            result = subprocess.run([*start, run_program.VOUSSOIR, *words], capture_output=True, text=True, timeout=3 * limit, check=False,
                                    env={**os.environ, **ROOT, "OMP_NUM_THREADS": str(threads)})
        except subprocess.TimeoutExpired:
            raise Failed(f"does not end within {3 * limit} s: voussoir {command}") from None
    errors = [line for line in result.stderr.splitlines() if line.startswith("voussoir: ") and not line.startswith("voussoir: warning: ")]
    if result.returncode == 2 and len(errors) == 1 and errors[0].startswith("voussoir: error: ") and not re.search(r"\w\.(cc|h)\b|deal\.II", errors[0]):
        raise Refused(errors[0][17:])
    if result.returncode != 0:
        raise Failed(f"status {result.returncode}: {' '.join(errors) or result.stderr[-500:]}: voussoir {command}")
    return result.stdout


def first_sentence(message):
    return re.split(r"(?<=[^ .][.:]) (?=[A-Z\"])", message)[0]


class Net:
    """The array: draws scenes and validates them."""

    def __init__(self, directory, seed):
        self.directory, self.random, self.choices = directory, random.Random(seed), Choices()
        self.scenes, self.known = [], {}  # known: results of --validate
        self.levels = [(name, level) for name, levels in self.choices.factors.items() for level in levels]
        self.pairs = {frozenset(pair) for pair in itertools.combinations(self.levels, 2) if pair[0][0] != pair[1][0]}
        self.refused, self.idle = {}, set()  # sets of levels with a message; (factor, other levels without which it acts)

    def write(self, name, entries):
        """A scene file, and the mesh that it requires."""
        entries = dict(entries)
        if entries.get("Mesh/File") == "own.msh":
            grid = {e: entries.pop(e) for e in list(entries) if e.startswith("Mesh/Arch210/")}
            grid.update({e: v for e, v in entries.items() if e == "Foundation/Model"})
            mesh = f"own-{zlib.crc32(text_of(grid).encode()):08x}"
            if not (self.directory / f"{mesh}.msh").exists():
                (self.directory / f"{mesh}.prm").write_text(text_of({**grid, "Motion/Source": "none"}))
                part = self.directory / f"{mesh}-part.msh"
                call(["mesh", str(self.directory / f"{mesh}.prm"), "--output", str(part), "--format", "2.2"])
                own = read_mesh(part)
                own["nodes"] = [[x, y, z + DAMS["file"][0]] for x, y, z in own["nodes"]]
                write_mesh(self.directory / f"{mesh}.msh", own)
                part.unlink()
            entries["Mesh/File"] = f"{mesh}.msh"
        file = self.directory / f"{name}.prm"
        file.write_text(text_of(entries))
        return str(file)

    def validated(self, scene):
        """The facts that --validate prints, or the message of the refusal."""
        key = frozenset((name, level) for name, level in scene.items() if level != self.choices.default[name])
        if key not in self.known:
            try:
                file = self.write(f"draw-{len(self.known)}", self.choices.entries(scene))
                self.known[key] = json.loads(call([file, "--validate", "--json"]))
                os.unlink(file)
            except Refused as error:
                self.known[key] = str(error)
        return self.known[key]

    def refusal(self, levels):
        """First sentence of the refusal without numbers and names, or an empty text."""
        facts = self.validated({**self.choices.default, **dict(levels)})
        return re.sub(r"\".*?\"|\(.*?\)|[-+.\de]+", "", first_sentence(facts)) if isinstance(facts, str) else ""

    def mentioned(self, text, names):
        """Factors whose entries are in a text."""
        def words(name):
            return [name, *(entry for level in self.choices.factors[name].values() for entry in level)]
        text = text.replace("Arch210", "GRID").replace("Arcs", "GRID")
        return [name for name in names if any(re.search(re.escape(word) + r"(?![a-z])", text, re.I) for word in words(name))]

    def blame(self, scene, message):
        """The smallest set of levels that the program refuses, with the defaults that are part of it; its message."""
        default, factors = self.choices.default, self.choices.factors
        levels = [(name, level) for name, level in scene.items() if level != default[name]]
        reason, named = self.refusal(levels), self.mentioned(message, scene)
        if self.refusal([x for x in levels if x[0] in named]) == reason:
            levels = [x for x in levels if x[0] in named]
        size = len(levels) // 2 if len(levels) > 5 else 1
        while levels:
            for start in range(0, len(levels), size):
                rest = levels[:start] + levels[start + size:]
                if self.refusal(rest) == reason:
                    levels = rest
                    break
            else:
                if size == 1:
                    break
                size = (size + 1) // 2
            size = max(1, min(size, len(levels)))
        message = self.validated({**default, **dict(levels)})
        for name, level in levels if len(levels) > 2 else ():  # without importance, because all others are refused, too
            rest = [x for x in levels if x[0] != name]
            if len(levels) > 2 and all(self.refusal([*rest, (name, other)]) for other in factors[name]):
                levels = rest
        others = [name for name in scene if name not in dict(levels)]
        stated = [name for name in self.mentioned(" ".join(re.findall(r"\S+/[^\"]+", message)), others) if "/" in name]
        for name in dict.fromkeys([*stated, *(others if len(levels) < 2 else ())]):
            if any(not self.refusal([*levels, (name, other)]) for other in list(factors[name])[1:4]):
                levels.append((name, default[name]))
                break
        return frozenset(levels), message

    def inactive(self, scene):
        """Factors without effect in a scene."""
        items = scene.items()
        return {name for name, others in self.idle if others <= items}

    def learn_idle(self, scene, facts):
        """Reads the warnings about entries without effect."""
        here = set()
        for warning in facts["warnings"]:
            entries, _, reason = warning.partition(" no effect: ")
            if not reason:
                continue
            entries = entries.replace("Mesh/Arch210/", "Mesh/GRID/").replace("Mesh/Arcs/", "Mesh/GRID/")
            for name, level in scene.items():
                if any(f"{entry} (" in entries for entry in self.choices.factors[name][level]):
                    here.add(name)
                    causes = [other for other in self.mentioned(reason, scene) if other != name]
                    if causes:
                        self.idle.add((name, frozenset((other, scene[other]) for other in causes)))
        return here

    def covered(self):
        result = set()
        for scene, idle in self.scenes:
            active = [x for x in scene.items() if x[0] not in idle and x[0] not in self.inactive(scene)]
            result.update(map(frozenset, itertools.combinations(active, 2)))
        return result

    def open_pairs(self):
        """Pairs that are neither covered nor refused nor without effect. A pair is refused, too, if it is refused with one level of a third
        factor, and with all others it is refused or without effect."""
        no_effect = {frozenset((x, next(iter(others)))) for name, others in self.idle if len(others) == 1
                     for x in itertools.product([name], self.choices.factors[name])}
        excluded = no_effect | {levels for levels in self.refused if len(levels) == 2}
        alone = {next(iter(levels)) for levels in self.refused if len(levels) == 1}
        for levels in self.refused:
            for third in levels if len(levels) == 3 else ():
                pair = levels - {third}
                if all(any(frozenset((x, (third[0], other))) in excluded for x in pair) or levels - {third} | {(third[0], other)} in self.refused
                       for other in self.choices.factors[third[0]] if other != third[1]):
                    excluded = excluded | {pair}
        return {pair for pair in self.pairs - self.covered() - excluded if not pair & alone}

    def read_page(self, page, share):
        """Takes the refused sets of the page, and validates one of @p share rows; the rows that are accepted."""
        rows, accepted = re.findall(r"^\| `(.*?)` \| (.*) \|$", page.read_text(), re.M) if page.exists() else (), []
        first = self.random.randrange(share)
        for number, (row, message) in enumerate(rows):
            levels = frozenset(tuple(part.split(" = ", 1)) for part in row.replace("...", "GRID").split("`, `"))
            if all(level in self.choices.factors.get(name, ()) for name, level in levels):
                self.refused[levels] = message
                if number % share == first:
                    self.refused[levels] = self.validated({**self.choices.default, **dict(levels)})
                    if not isinstance(self.refused[levels], str):
                        accepted.append(row)
                        del self.refused[levels]
        return accepted

    def is_forbidden(self, scene):
        items = scene.items()
        return any(levels <= items for levels in self.refused)

    def candidate(self, wanted, seed):
        """A scene with a pair, and as many others as possible."""
        scene = dict(seed)
        names = [name for name in self.choices.factors if name not in scene]
        self.random.shuffle(names)
        for name in names:
            def gain(level, name=name):
                trial = {**scene, name: level}
                idle = self.inactive(trial)
                if self.is_forbidden(trial) or not idle.isdisjoint(dict(seed)):
                    return -1e3
                lost = 10 * len(idle - self.inactive(scene) - {name}) + 20 * COSTLY(trial.items())
                return sum(frozenset(((name, level), x)) in wanted for x in scene.items()) * (name not in idle) - lost + self.random.random() / 2
            scene[name] = max(self.choices.factors[name], key=gain)
        active = [x for x in scene.items() if x[0] not in self.inactive(scene)]
        return sum(frozenset(pair) in wanted for pair in itertools.combinations(active, 2)), scene

    def draw(self, n_scenes, written, quick):
        """Adds scenes until all pairs are covered. written(self) follows each scene. quick: takes the default of a named factor where a
        scene is refused, without a search for the pair."""
        given_up = set()
        while len(self.scenes) < n_scenes:
            wanted = self.open_pairs() - given_up
            if not wanted:
                break
            seeds = self.random.sample(sorted(map(sorted, wanted)), min(8, len(wanted)))
            seeds = [seed for seed in seeds if not self.is_forbidden(dict(seed))] or seeds
            _, scene = max(((value, scene) for value, scene in (self.candidate(wanted, seed) for seed in seeds)), key=lambda x: x[0])
            for _ in range(40):
                facts = self.validated(scene)
                if not isinstance(facts, str):
                    break
                if quick:  # the page has most refused pairs
                    named = [name for name in self.mentioned(facts, scene) if scene[name] != self.choices.default[name]]
                    name = self.random.choice(named or [n for n in scene if scene[n] != self.choices.default[n]])
                    scene[name] = self.choices.default[name]
                    continue
                levels, message = self.blame(scene, facts)
                self.refused[levels] = message
                print("        refused:", *(f"{n}={level}" for n, level in sorted(levels)), "|", first_sentence(message), flush=True)
                fixed = dict(sorted(levels)[1:] if len(levels) > 1 and self.random.random() < .5 else sorted(levels)[:-1])
                free = [name for name, _ in levels if name not in fixed]
                for name in free:
                    others = [level for level in self.choices.factors[name] if not self.is_forbidden({**scene, name: level})]
                    scene[name] = max(others or [self.choices.default[name]],
                                      key=lambda level, name=name: sum(frozenset(((name, level), x)) in wanted for x in scene.items()))
            else:
                raise Failed(f"no scene found: {facts}")
            self.scenes.append((scene, self.learn_idle(scene, facts)))
            written(self)
            new = len(wanted) - len(self.open_pairs() - given_up)
            print(f"    scene {len(self.scenes)}: {new} new pairs, {len(wanted) - new} left, {len(self.refused)} refused, "
                  f"{len(self.known)} validated", flush=True)
            if new == 0:
                given_up.update(frozenset(seed) for seed in seeds)
