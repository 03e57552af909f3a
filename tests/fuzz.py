#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged input files: whatever is in a file, the program must end with a result or with a message.

    fuzz.py VOUSSOIR [--count 200] [--seconds S] [--seed 1] [--only N] [--jobs 2] [--time-out 20] [KIND...]

Kinds: prm, msh (2.2 and 4.1, ascii and binary), motion (columns, AT2), fclib, checkpoint; all by default. Each case is a
sound file with one to five seeded mutations. What fails: a signal, a run that does not end, status 2 without
"voussoir: error: ", 1 without "voussoir: failed: ", another status, "internal error", a message that speaks of the
code, a motion that is not finite, a resumed run with other results, an FCLib file that keeps a sound one after it from
being solved. Files of failed cases are kept in fuzz/KIND/failed/N below the working directory, with the command.
--only N repeats one case. --seconds: as many cases as take this time, in random order. --time-out: CPU seconds of a case, and six times
that by the clock on the wall.
The environment variable VOUSSOIR_START_SERVER names the library of start_server.cc, which saves the start of the program (most of the time).
"""

import argparse
import json
import math
import os
import queue
import random
import re
import resource
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import threading
import time
from pathlib import Path

from run_program import Server

HERE = Path(__file__).resolve().parent

# Sound files

MESH = """subsection Mesh
  subsection Arch210
    set Joints = 2
    set Elements along = 6
    set Elements up = 3
    set Elements through = 1
  end
end
"""
SHORT = """subsection Motion
  set Source = file
  set File = motion.txt
  set Unit = g
  set Duration = 0.4
end
subsection Output
  set Figures = false
  set Checkpoint interval = 0
end
"""
SCENES = {
    "plain": MESH + SHORT,
    "keys": MESH + SHORT + """subsection Joints
  set Model = KSM
  set Friction = 0.6 # of the faces
  set Overrides = 1: FJB, 2: KSM
  subsection Keys
    set Height = 0.15
    set Clearance = 0.001
    set Flank angle = 30
    set Direction = radial
    set Friction = 0.3
  end
end
subsection Contact
  set Tolerance = 1e-9
end
subsection Output
  set Probes = crown: 0 0 210; foot: 0 0 0
  set Envelope interval = 3
  set Solution interval = 10
end
subsection Elements
  set Degree = 2
end
""",
    "rock": MESH + SHORT + """subsection Mesh
  subsection Arch210
    subsection Rock
      set Enabled = true
      set Element size = 90
      set Depth = 150
    end
  end
end
subsection Foundation
  set Model = rock
  set Boundary = mtf2
  set Stiffness damping = 1e-4
end
subsection Dynamics
  set Steps per sample = 5
end
""",
    "artificial": MESH + """subsection Motion
  set Spectrum = NB35047-2015
  set Duration = 12.5
  set Peak acceleration = 0.3
  set Seed = 7
  set Matching iterations = 3
end
subsection Damping
  set Ratio = 0.1
end
subsection Reservoir
  set Water level = 180
  set Depth = local
  set Factor = 0.5
end
"""}


def write(path, content):
    path = Path(path)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def accelerations(n, dt):
    for i in range(n):
        t = dt * i
        s = .6 * (1 - math.exp(-10 * t))
        yield t, [s * math.sin(w * t + p) for w, p in ((17, 0), (23, 1), (29, 2))]


def write_motions(directory):
    rows = list(accelerations(61, .01))
    write(directory / "motion.txt", "".join(f"{t:.2f} {a[0]:.10g} {a[1]:.10g} {a[2]:.10g}\n" for t, a in rows))
    write(directory / "commas.csv", "# t, a_x, a_y, a_z\n" +
          "".join(f"{t:.2f}, {a[0]:.6e}, {a[1]:.6e}, {a[2]:.6e} # {i}\n" for i, (t, a) in enumerate(rows)))
    write(directory / "one.txt", "".join(f"{t:.2f}\t{a[0]:.8f}\n" for t, a in rows))
    numbers = [f"{a[1]:15.7E}" for _, a in rows]
    write(directory / "record.AT2", "PEER NGA STRONG MOTION DATABASE RECORD\nA VALLEY, 1/1/1999, STATION 1, 090\n"
          "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=    61, DT=   .0100 SEC,\n" +
          "".join("".join(numbers[i:i + 5]) + "\n" for i in range(0, len(numbers), 5)))


# Mutations

EXTREME = ["0", "-1", "1", "-0.", "1e308", "-1e308", "1e309", "nan", "-nan", "inf", "-inf", "1e-300", "1e-320", "2147483647",
           "2147483648", "-2147483648", "4294967295", "4294967296", "9223372036854775807", "18446744073709551615",
           "99999999999999999999999", "1e18", "3.5", "0x10", "1,5", "", "1e", "--1", "1e-6", "1e6", "%s%n", "../..", "\"'`"]
EXTREME_BYTES = ([struct.pack("<i", i) for i in (0, -1, 1, 2**31 - 1, -2**31, 1000000)] +
                 [struct.pack("<q", i) for i in (0, -1, 2**63 - 1, -2**63, 2**32, 10**12)] +
                 [struct.pack("<d", x) for x in (0., -1., 1e308, -1e308, math.nan, math.inf, -math.inf, 1e-300, 1e-320)])
NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def mutate_bytes(data, rng):
    """One mutation of any file."""
    data = bytearray(data)
    n = len(data)
    if n == 0:
        return bytes(rng.randrange(256) for _ in range(rng.randrange(1, 20)))
    i = rng.randrange(n)
    kind = rng.randrange(8)
    if kind <= 1:
        data[i] ^= 1 << rng.randrange(8)
    elif kind == 2:
        data[i:i] = bytes(rng.randrange(256) for _ in range(rng.choice((1, 1, 2, 8, 100))))
    elif kind == 3:
        del data[i:i + rng.choice((1, 1, 2, 4, 8, 100))]
    elif kind == 4 or kind == 5:
        value = rng.choice(EXTREME_BYTES)
        i -= i % rng.choice((1, 4, 8))
        data[i:i + len(value)] = value
    elif kind == 6:  # a piece from elsewhere
        j, length = rng.randrange(n), rng.choice((4, 8, 16, 64))
        data[i:i + length] = data[j:j + length]
    else:
        del data[i:]
    return bytes(data)


def mutate_lines(data, rng):
    """One mutation of a text, or of the text in a binary file."""
    kind = rng.randrange(-3, 10)
    if kind <= 3:  # a number
        numbers = [m for m in NUMBER.finditer(data)]
        if numbers:
            m = rng.choice(numbers)
            text = rng.choice(EXTREME).encode()
            if rng.random() < .3:  # a number of the same file
                text = rng.choice(numbers)[0]
            return data[:m.start()] + text + data[m.end():]
    lines = data.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    if kind == 4:
        del lines[i]
    elif kind == 5:
        lines[j:j] = [lines[i]] * rng.choice((1, 1, 3, 50))
    elif kind == 6:
        lines[i], lines[j] = lines[j], lines[i]
    elif kind == 7:
        words_i, words_j = lines[i].split(b" "), lines[j].split(b" ")
        a, b = rng.randrange(len(words_i)), rng.randrange(len(words_j))
        words_i[a], words_j[b] = words_j[b], words_i[a]
        if i != j:
            lines[i], lines[j] = b" ".join(words_i), b" ".join(words_j)
    elif kind == 8:
        del lines[i:i + rng.randrange(1, 10)]
    else:
        return mutate_bytes(data, rng)
    return b"\n".join(lines)


def mutate(data, rng, binary):
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        data = (mutate_bytes if rng.random() < (.9 if binary else .2) else mutate_lines)(data, rng)
    return data


# Runs

class Direct:
    """Starts the program for each run."""

    def __init__(self, program):
        self.program = program

    def run(self, words, seconds, directory):
        def limit():
            limit_memory()
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        try:
            return subprocess.run([self.program, *words], cwd=directory, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                                  timeout=6 * seconds, preexec_fn=limit)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(words, -signal.SIGALRM, "", "")


def limit_memory():
    """A damaged number may ask for any amount."""
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


TIME_IS_OVER = (-signal.SIGALRM, -signal.SIGPROF, -signal.SIGXCPU)


def complaint(status, out, err):
    """What is wrong with the end of a run; empty if nothing is."""
    if status in TIME_IS_OVER:
        return "did not end in time"
    if status < 0:
        return f"signal {-status}"
    if status not in (0, 1, 2):
        return f"status {status}"
    if status == 2 and "voussoir: error: " not in err or status == 1 and "voussoir: failed: " not in err:
        return f"status {status} without its message"
    if "internal error" in err + out:
        return "internal error"
    if re.search(r"dealii::|std::|boost::|terminate called|\w\.(cc|h):", err):
        return "the message speaks of the code"
    return ""


class Kind:
    """Sound files in corpus; case() gives the files of one case and its command line."""

    def __init__(self, name, program):
        self.name, self.program = name, program
        self.root = Path("fuzz", name).resolve()
        shutil.rmtree(self.root, ignore_errors=True)
        self.corpus = self.root / "corpus"
        self.corpus.mkdir(parents=True)
        write_motions(self.corpus)
        for scene, text in SCENES.items():
            write(self.corpus / f"{scene}.prm", text)
        self.prepare()

    def call(self, *words, program=None):
        result = subprocess.run([program or self.program, *words], cwd=self.corpus, capture_output=True, text=True, timeout=120)
        if result.returncode != 0:
            sys.exit(f"FAILED: {self.name}: a sound file is refused: {words}: {result.stderr}")
        return result.stdout

    def prepare(self):
        pass

    def check(self, directory, status, out):
        return ""

    def may_take_long(self, directory):
        return False


class Prm(Kind):
    SIZES = re.compile(rb"set (Joints|Elements \w+|Element size|Degree|Depth|Sides|Upstream|Downstream|Duration|Time step|"
                       rb"Steps per sample|Substeps|Water increments|Maximum iterations|Matching iterations) *= *(.*?) *\n")

    def prepare(self):
        self.scenes = {name: (self.corpus / f"{name}.prm").read_bytes() for name in SCENES}
        self.scenes["all"] = (self.call("parameters", "prm") + MESH + SHORT).encode()

    def case(self, rng, directory):
        name = rng.choice(sorted(self.scenes))
        shutil.copy(self.corpus / "motion.txt", directory)
        write(directory / "case.prm", mutate(self.scenes[name], rng, False))
        if rng.random() < .7 or name in ("all", "artificial"):
            return ["case.prm", "--validate"]
        # A short run: the size of the problem as it was.
        size = ["Motion/Duration=0.05", "Motion/Time step=0.01", "Mesh/Arch210/Joints=2", "Mesh/Arch210/Elements along=6",
                "Mesh/Arch210/Elements up=3", "Mesh/Arch210/Elements through=1"]
        return ["case.prm", "--output", "results", "--quiet", *(w for s in size for w in ("--set", s))]

    def may_take_long(self, directory):
        """The damaged scene may be a sound one of ten million elements."""
        sizes = set(self.SIZES.findall((directory / "case.prm").read_bytes()))
        return all(sizes != set(self.SIZES.findall(scene)) for scene in self.scenes.values())


class Msh(Kind):
    def prepare(self):
        self.meshes = []
        for scene in ("plain", "rock"):
            for version in ("2.2", "4.1"):
                name = f"{scene}_{version}.msh"
                self.call("mesh", f"{scene}.prm", "--output", name, "--format", version)
                self.meshes.append((scene, name))
                if shutil.which("gmsh"):
                    self.call(name, "-save", "-bin", "-format", "msh" + version.replace(".", ""), "-o", "binary_" + name,
                              program="gmsh")
                    self.meshes.append((scene, "binary_" + name))
                self.call(f"{scene}.prm", "--validate", "--set", "Mesh/Source=file", "--set", f"Mesh/File={self.meshes[-1][1]}",
                          "--set", "Mesh/Arch210/Rock/Enabled=false")

    def case(self, rng, directory):
        scene, mesh = rng.choice(self.meshes[:4] * 3 + self.meshes)
        shutil.copy(self.corpus / "motion.txt", directory)
        shutil.copy(self.corpus / f"{scene}.prm", directory / "scene.prm")
        write(directory / "case.msh", mutate((self.corpus / mesh).read_bytes(), rng, mesh.startswith("binary")))
        return ["scene.prm", "--validate", "--set", "Mesh/Source=file", "--set", "Mesh/File=case.msh",
                "--set", "Mesh/Arch210/Rock/Enabled=false"]


class Motion(Kind):
    def prepare(self):
        for name in ("motion.txt", "commas.csv", "one.txt", "record.AT2"):
            self.call("motion", *self.words(name, name))

    @staticmethod
    def words(name, file):
        entry = "File" if name in ("motion.txt", "commas.csv") else "File x"
        return ["plain.prm", "--output", "out.csv", "--set", "Motion/File=", "--set", f"Motion/{entry}={file}"]

    def case(self, rng, directory):
        name = rng.choice(("motion.txt", "commas.csv", "one.txt", "record.AT2"))
        shutil.copy(self.corpus / "plain.prm", directory)
        file = "case" + Path(name).suffix
        write(directory / file, mutate((self.corpus / name).read_bytes(), rng, False))
        return ["motion", *self.words(name, file)]

    def check(self, directory, status, out):
        text = (directory / "out.csv").read_text() if (directory / "out.csv").exists() else ""
        if status == 0 and not text:
            return "no motion is written"
        if re.search(r"\b(nan|inf)", text + (out if status == 0 else "")):
            return "a motion that is not finite"
        return ""


class Fclib(Kind):
    def __init__(self, name, program):
        super().__init__(name, str(Path(program).with_name("voussoir-contact")))

    def prepare(self):
        self.files = sorted((HERE / "fclib").glob("*.hdf5"))
        self.good = next(f for f in self.files if "Example1" in f.name)
        self.call(*(str(f) for f in self.files if f.name != "RockPile.hdf5"))  # RockPile takes thousands of steps

    def case(self, rng, directory):
        shutil.copy(self.good, directory / "good.hdf5")
        write(directory / "case.hdf5", mutate(rng.choice(self.files).read_bytes(), rng, True))
        return ["case.hdf5", "good.hdf5", "--max-seconds", "1", "--tolerance", "1e-8"]

    def check(self, directory, status, out):
        def no_constant(name):
            raise ValueError(name)
        try:
            lines = [json.loads(line, parse_constant=no_constant) for line in out.splitlines()]
        except ValueError as error:
            return f"not JSON: {error}"
        good = [line for line in lines if line["file"] == "good.hdf5"]
        return "" if good and good[0]["converged"] else "the sound file after it was not solved"


class Checkpoint(Kind):
    settings = ["--quiet", "--set", "Output/Checkpoint interval=10"]

    def prepare(self):
        self.call("plain.prm", "--output", "whole", *self.settings)
        directory = self.corpus / "killed"
        for _ in range(20):
            shutil.rmtree(directory, ignore_errors=True)
            process = subprocess.Popen([self.program, "plain.prm", "--output", "killed", *self.settings], cwd=self.corpus)
            while process.poll() is None and not self.ready(directory):
                time.sleep(.0005)
            process.kill()
            process.wait()
            if (directory / "checkpoint.bin").exists():
                break
        else:
            sys.exit("FAILED: the run always ends before it can be killed")
        shutil.copytree(directory, self.corpus / "results")
        self.call("plain.prm", "--output", "results", *self.settings, "--resume")
        if self.check(self.corpus, 0, ""):
            sys.exit("FAILED: a run resumed from a sound checkpoint has other results")

    @staticmethod
    def ready(directory):
        """Two checkpoints, if the one before is kept; else one."""
        try:
            return "step 20" in (directory / "checkpoint.txt").read_text()
        except OSError:
            return False

    def case(self, rng, directory):
        for name in ("motion.txt", "plain.prm"):
            shutil.copy(self.corpus / name, directory)
        shutil.copytree(self.corpus / "killed", directory / "results")
        file = directory / "results" / "checkpoint.bin"
        write(file, mutate(file.read_bytes(), rng, True))
        return ["plain.prm", "--output", "results", *self.settings, "--resume"]

    def check(self, directory, status, out):
        """Equal to what the joint solver's tolerance leaves: it starts without its old factors."""
        if status != 0:
            return ""
        for name in ("history.csv", "joint_history.csv"):
            a, b = ([[float(x) for x in line.split(",")] for line in Path(f).read_text().splitlines()[1:]]
                    for f in (directory / "results" / name, self.corpus / "whole" / name))
            if len(a) != len(b):
                return f"{name} has {len(a)} rows, not {len(b)}"
            for x, y in zip(zip(*a), zip(*b)):
                size = max(map(abs, y))
                if not all(abs(p - q) <= 1e-6 * size for p, q in zip(x, y)):
                    return f"{name} differs from that of the undisturbed run"
        return ""


KINDS = {"prm": Prm, "msh": Msh, "motion": Motion, "fclib": Fclib, "checkpoint": Checkpoint}


class Campaign:
    def __init__(self, kind, options):
        self.kind, self.options = kind, options
        self.numbers = queue.Queue()
        numbers = [options.only] if options.only is not None else list(range(options.count))
        for number in random.sample(numbers, len(numbers)) if options.seconds else numbers:
            self.numbers.put(number)
        self.failures, self.endings, self.lock = [], {0: 0, 1: 0, 2: 0}, threading.Lock()

    def one(self, number, runner, directory):
        shutil.rmtree(directory, ignore_errors=True)
        directory.mkdir()
        words = self.kind.case(random.Random(f"{self.options.seed} {self.kind.name} {number}"), directory)
        result = runner.run(words, self.options.time_out, directory)
        status, out, err = result.returncode, result.stdout, result.stderr
        problem = complaint(status, out, err) or self.kind.check(directory, status, out)
        if status in TIME_IS_OVER and self.kind.may_take_long(directory):
            problem = ""
        with self.lock:
            self.endings[status] = self.endings.get(status, 0) + 1
            if problem or self.options.only is not None:
                kept = self.kind.root / "failed" / str(number)
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(directory, kept)
                if problem:
                    self.failures.append(number)
                print(f"{self.kind.name} {number}: {problem or 'OK'}: status {status}: {err.strip()[-300:]}\n    cd {kept} && "
                      f"{shlex.join([self.kind.program, *words])}", flush=True)

    def work(self, index):
        runner = Server(self.kind.program, preexec_fn=limit_memory) if os.path.isfile(Server.library) else Direct(self.kind.program)
        try:
            end = time.time() + (self.options.seconds or math.inf)
            while time.time() < end:
                self.one(self.numbers.get_nowait(), runner, self.kind.root / f"case_{index}")
        except queue.Empty:
            pass
        except Exception as error:  # of a thread: nobody else would see it
            self.failures.append(repr(error))

    def run(self):
        start = time.time()
        threads = [threading.Thread(target=self.work, args=(i,)) for i in range(self.options.jobs)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        print(f"{self.kind.name}: {sum(self.endings.values())} cases of seed {self.options.seed}: "
              f"{self.endings[0]} with a result, {self.endings[2]} refused, {self.endings[1]} failed with a message; "
              f"{len(self.failures)} wrong; {time.time() - start:.0f} s", flush=True)
        return self.failures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda name: str(Path(name).resolve()))
    parser.add_argument("kinds", nargs="*", metavar="KIND")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--time-out", type=int, default=20)
    options = parser.parse_intermixed_args()
    if unknown := set(options.kinds) - set(KINDS):
        parser.error(f"there is no kind {' '.join(unknown)}; the kinds are {', '.join(KINDS)}")
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    failures = {}
    for name in options.kinds or KINDS:
        if found := Campaign(KINDS[name](name, options.program), options).run():
            failures[name] = found
    if failures:
        sys.exit(f"FAILED: {failures}")


if __name__ == "__main__":
    main()
