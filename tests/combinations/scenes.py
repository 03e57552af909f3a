# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls of the program; the array of scenes that covers all pairs of levels."""

import itertools
import json
import math
import os
import random
import re
import subprocess
import threading
import zlib
from collections import Counter

import run_program
from choices import DAMS, Choices, cost, text_of
from run_program import Server, read_mesh, write_mesh

FEW = 300  # open pairs, below which a scene is drawn for one pair
ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
        "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}  # without it, the program restarts itself


class Refused(Exception):
    """Status 2: the program does not accept the scene."""


class Failed(Exception):
    """A relation does not hold, or a run ended in another way than with status 0 or 2."""


class Omitted(Exception):
    """A relation does not apply."""


OF_THREAD, SERVERS = threading.local(), []  # one server for each thread


def cpu_time():
    """Ends all servers; the CPU time of all runs so far [s]."""
    for server in SERVERS:
        server.process.communicate()
    times = os.times()
    return times.children_user + times.children_system


def call(words, ranks=1, threads=1, limit=300, served=True):
    """Standard output. Throws Refused with the message of one paragraph, or Failed."""
    command = " ".join(f"'{word}'" if re.search(r"[ ;]", word) else word for word in words)
    if os.path.isfile(Server.library) and served and ranks == threads == 1 and words[0] != "report":
        if not hasattr(OF_THREAD, "server"):
            OF_THREAD.server = Server(run_program.VOUSSOIR, ROOT)
            SERVERS.append(OF_THREAD.server)
        result = OF_THREAD.server.run(words, limit)
    else:
        # Ranks wait for each other: on a busy machine they need little CPU time, but long.
        start = ["mpirun", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1", "-np", str(ranks)] if ranks > 1 else []
        try:
            result = subprocess.run(["prlimit", f"--cpu={limit * threads}", *start, run_program.VOUSSOIR, *words], capture_output=True, text=True,
                                    timeout=12 * limit, check=False, env={**os.environ, **ROOT, "OMP_NUM_THREADS": str(threads)})
        except subprocess.TimeoutExpired:
            raise Failed(f"does not end within {12 * limit} s: voussoir {command}") from None
    errors = [line for line in result.stderr.splitlines() if line.startswith("voussoir: ") and not line.startswith("voussoir: warning: ")]
    if result.returncode == 2 and len(errors) == 1 and errors[0].startswith("voussoir: error: ") and not re.search(r"\w\.(cc|h)\b|deal\.II", errors[0]):
        raise Refused(errors[0][17:])
    if result.returncode != 0:
        raise Failed(f"status {result.returncode}: {' '.join(errors) or result.stderr[-500:]}: voussoir {command}")
    return result.stdout


def first_sentence(message):
    return re.split(r"(?<=[^ .][.]) (?=[A-Z\"])", message)[0]


def warnings_of(facts):
    return [warning["text"] for warning in facts["warnings"]]


class Net:
    """The array: draws scenes and validates them."""

    def __init__(self, directory, seed):
        self.directory, self.random, self.choices = directory, random.Random(seed), Choices()
        self.scenes, self.known = [], {}  # known: results of --validate
        self.levels = [(name, level) for name, levels in self.choices.factors.items() for level in levels]
        self.pairs = {frozenset(pair) for pair in itertools.combinations(self.levels, 2) if pair[0][0] != pair[1][0]}
        # Sets of levels with a message; (factor, other levels with which it has no effect); pairs that follow from these.
        self.refused, self.idle, self.ruled_out = {}, set(), set()
        self.tries = Counter()  # scenes drawn for a pair, and scenes with it that have no solution
        self.plain_tries = Counter()  # plain scenes of a pair

    def write(self, name, entries):
        """A scene file, and the mesh that it requires."""
        entries = dict(entries)
        if entries.get("Mesh/File") == "own.msh":
            grid = {e: entries.pop(e) for e in list(entries) if e.startswith("Mesh/Arch210/")}
            grid.update({e: v for e, v in entries.items() if e == "Foundation/Model"})
            mesh = f"own-{threading.get_ident()}-{zlib.crc32(text_of(grid).encode()):08x}"
            if not (self.directory / f"{mesh}.msh").exists():
                (self.directory / f"{mesh}.prm").write_text(text_of({**grid, "Motion/Source": "none"}))
                part = self.directory / f"{mesh}-part.msh"
                call(["mesh", str(self.directory / f"{mesh}.prm"), "--output", str(part), "--format", "2.2"])
                own = read_mesh(part)
                own["nodes"] = [[x, y, z + DAMS["file"][0]] for x, y, z in own["nodes"]]
                own["head"] = [re.sub('"(monolith 1( lift 1)?)"', r'"\1 heel"', line) for line in own["head"]]
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

    @staticmethod
    def reason(facts):
        """First sentence of a refusal without numbers and names, or an empty text."""
        return re.sub(r"\".*?\"|\(.*?\)|[-+.\de]+", "", first_sentence(facts)) if isinstance(facts, str) else ""

    def refusal(self, levels):
        return self.reason(self.validated({**self.choices.default, **dict(levels)}))

    def mentioned(self, text, names):
        """Factors whose entries are in a text."""
        def words(name):
            return [name, *(entry for level in self.choices.factors[name].values() for entry in level)]
        text = text.replace("Arch210", "GRID").replace("Arcs", "GRID")
        return [name for name in names if any(re.search(re.escape(word) + r"(?![a-z])", text, re.I) for word in words(name))]

    def blame(self, scene, message, names):
        """The smallest set of levels of some factors that the program refuses with this message, with the defaults that are part of it; or None."""
        default, factors, reason = self.choices.default, self.choices.factors, self.reason(message)
        levels = [(name, scene[name]) for name in names if scene[name] != default[name]]
        if self.refusal(levels) != reason:
            return None
        for level in list(levels):
            rest = [x for x in levels if x != level]
            if self.refusal(rest) == reason:
                levels = rest
        message = self.validated({**default, **dict(levels)})
        for name, level in levels if len(levels) > 2 else ():  # without importance, because all others are refused, too
            rest = [x for x in levels if x[0] != name]
            if len(levels) > 2 and all(self.refusal([*rest, (name, other)]) for other in factors[name]):
                levels = rest
        others = [name for name in scene if name not in dict(levels)]
        stated = [name for name in self.mentioned(" ".join(re.findall(r"\S+/[^\"]+", message)), others) if "/" in name]
        for name in dict.fromkeys([*stated, *(others if len(levels) < 2 else ())]):
            if any(not self.refusal([*levels, (name, other)]) for other in list(factors[name])[1:4]):
                levels.append((name, scene[name] if self.refusal([*levels, (name, scene[name])]) else default[name]))
                break
        self.refused[frozenset(levels)] = message
        print("        refused:", *(f"{n}={level}" for n, level in sorted(levels)), "|", first_sentence(message), flush=True)
        return dict(levels)

    def inactive(self, scene):
        """Factors without effect in a scene."""
        items = scene.items()
        return {name for name, others in self.idle if others <= items}

    def inactive_defaults(self, scene):
        """Factors with their default and without effect, about which there is no warning."""
        return {name for name in self.inactive(scene) if scene[name] == self.choices.default[name]}

    def learn_idle(self, scene, facts):
        """Reads the warnings about entries without effect."""
        here = set()
        for warning in warnings_of(facts):
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
            inactive = idle | self.inactive_defaults(scene)
            active = [x for x in scene.items() if x[0] not in inactive]
            result.update(map(frozenset, itertools.combinations(active, 2)))
        return result

    def open_pairs(self):
        """Pairs that are neither covered nor refused nor without effect."""
        alone = {x for levels in self.refused if len(levels) == 1 for x in levels}
        no_effect = {(name, x) for name, others in self.idle if len(others) == 1 for x in others}
        return {pair for pair in self.pairs - self.covered() - self.refused.keys() - self.ruled_out if not pair & alone and not any(
            (x[0], y) in no_effect for x, y in itertools.permutations(pair))}

    def is_ruled_out(self, pair):
        """True if, for a third factor, each level is refused or makes one of the pair ineffective."""
        names = {name for name, _ in pair}
        return any(all(self.is_forbidden(scene) or self.inactive(scene) & names for scene in ({**dict(pair), name: level} for level in levels))
                   for name, levels in self.choices.factors.items() if name not in names)

    def read_page(self, page, share):
        """Takes the refused sets of the page, and validates one of @p share rows; the rows that are accepted."""
        rows, accepted = [(row, message) for levels, message in re.findall(r"^\| `(.*?)` \| (.*) \|$", page.read_text(), re.M)
                          for row in levels.split("`<br>`")] if page.exists() else (), []
        first = self.random.randrange(share) if share < math.inf else -1
        for number, (row, message) in enumerate(rows):
            levels = frozenset(tuple(part.split(" = ", 1)) for part in row.replace("...", "GRID").split("`, `"))
            if all(level in self.choices.factors.get(name, ()) for name, level in levels):
                self.refused[levels] = message
                if number % share == first and not isinstance(self.validated({**self.choices.default, **dict(levels)}), str):
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
                lost = 10 * len(idle - self.inactive(scene) - {name}) + cost(trial) - cost(scene)
                return sum(frozenset(((name, level), x)) in wanted for x in scene.items()) * (name not in idle) - lost + self.random.random() / 2
            scene[name] = max(self.choices.factors[name], key=gain)
        active = [x for x in scene.items() if x[0] not in self.inactive(scene)]
        return sum(frozenset(pair) in wanted for pair in itertools.combinations(active, 2)) - cost(scene), scene

    def plain(self, seed):
        """A scene with a pair and defaults, except for choices that give both an effect."""
        scene = {**self.choices.default, **seed}

        def without_effect(trial):
            facts = self.validated(trial)
            return {*seed} if isinstance(facts, str) else (self.learn_idle(trial, facts) | self.inactive_defaults(trial)) & seed.keys()
        for _ in range(4):
            facts, idle = self.validated(scene), without_effect(scene)
            if isinstance(facts, str) or not idle:
                break
            reasons = " ".join(warning.partition(" no effect: ")[2] for warning in warnings_of(facts))
            causes = {*self.mentioned(reasons, scene), *(cause for name, others in self.idle if name in idle for cause, _ in others)}
            trials = [{**scene, name: level} for name in sorted(causes - seed.keys()) for level in self.choices.factors[name]]
            better = [trial for trial in trials if len(without_effect(trial)) < len(idle)]
            if not better:
                break
            scene = self.random.choice(better)
        return scene

    def accepted(self, scene, seed):
        """Changes factors other than those of the seed until the program accepts the scene; its facts, or None if no scene has the seed."""
        default = self.choices.default
        for _ in range(60):
            levels, named = next((dict(sorted(levels)) for levels in self.refused if levels <= scene.items()), None), []
            changed = [name for name in scene if name not in seed and scene[name] != default[name]]
            if not levels:
                facts = self.validated(scene)
                if not isinstance(facts, str):
                    return facts
                named = self.mentioned(facts, scene)
                levels = self.blame(scene, facts, named if changed else scene)
            free = [name for name in levels or () if name not in seed] or [name for name in named if name in changed] or changed
            if not free:
                return None
            allowed = {name: [level for level in (self.choices.factors[name] if levels else [default[name]]) if level != scene[name] and not self.is_forbidden(
                {**scene, name: level})] for name in free}
            name = self.random.choice([name for name in free if allowed[name]] or changed or free)
            scene[name] = self.random.choice(allowed.get(name) or [default[name]])
        return None

    def unsolved(self):
        """Removes the last scene: its pairs remain open, and are drawn again at most three times."""
        scene, _ = self.scenes.pop()
        self.tries.update(map(frozenset, itertools.combinations(scene.items(), 2)))

    def counts(self):
        covered, n_open = self.covered(), len(self.open_pairs())
        alone = {x for levels in self.refused if len(levels) == 1 for x in levels}
        refused = sum(pair in self.refused or pair in self.ruled_out or not pair.isdisjoint(alone) for pair in self.pairs - covered)
        return f"{len(covered)} pairs covered, {refused} refused, {len(self.pairs) - len(covered) - refused - n_open} without effect, {n_open} open"

    def draw(self, n_scenes):
        """Adds scenes, with their factors without effect, until all pairs are covered, and yields them. The caller may remove the last one: unsolved()."""
        while len(self.scenes) < n_scenes:
            wanted = {pair for pair in self.open_pairs() if self.tries[pair] < 3}
            is_plain = len(wanted) <= FEW
            if is_plain:
                wanted = {pair for pair in self.open_pairs() if self.plain_tries[pair] < 2}
            seeds = self.random.sample(sorted(map(sorted, wanted)), min(8, len(wanted)))
            self.ruled_out |= {frozenset(seed) for seed in seeds if self.is_ruled_out(seed)}
            seeds = [seed for seed in seeds if frozenset(seed) not in self.ruled_out]
            if not wanted:
                break
            if not seeds:
                continue
            if not is_plain:
                _, scene, seed = max(((*self.candidate(wanted, seed), seed) for seed in seeds), key=lambda x: x[0])
            else:
                seed = seeds[0]
                scene = self.plain(dict(seed))
                self.plain_tries[frozenset(seed)] += 1
            plain = self.validated(scene) if is_plain else ""  # a refused pair may need others
            facts = self.accepted(scene, dict(seed)) if isinstance(plain, str) else plain
            self.tries[frozenset(seed)] += 1
            if facts:
                self.scenes.append((scene, self.learn_idle(scene, facts)))
                yield self.scenes[-1]
            print(f"    drawn {len(self.scenes)}: {self.counts()}, {len(self.refused)} refused, {len(self.known)} validated", flush=True)
