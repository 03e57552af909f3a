# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir study STUDY.prm`: many scenes under Snakemake, one table of their results, and figures (doc/studies.md).

    study.py [--jobs N] [--output DIR] [--profile PROFILE] [--keep-going] [--dry-run] [--set ENTRY=VALUE]... -- STUDY.prm
"""

import hashlib
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .command import Parser, lock_directory, write_whole
from .errors import ComputationError, InputError
from .prm import prm_text
from .program import entries_of, find_program, message_of, start
from .study_file import is_file_entry, read_study, value_in, with_paths
from .study_scene import end_with_parent, record_of, revision_of, row_in_words

PLAIN_NUMBER = re.compile(r"[-+]?[0-9]+(\.[0-9]*)?(e[-+]?[0-9]+)?")
SNAKEFILE = """# Written by `voussoir study`, which runs it, and gathers the results when all scenes are done.
import json
STUDY = json.load(open("scenes.json"))

rule all:
    input: expand("done/{scene}", scene=STUDY["scenes"])

rule scene:
    input: "scenes/{scene}.prm"
    output: touch("done/{scene}")
    threads: STUDY["threads"]
    params: job=STUDY["job"]
    resources: mem_mb=lambda wildcards: STUDY["scenes"][wildcards.scene]["mem_mb"]
    shell: "exec {params.job} . {wildcards.scene} {threads}"
"""


def arguments():
    """The command line, which the program has looked at."""
    parser = Parser(prog="voussoir study", add_help=False)
    parser.add_argument("--jobs", default="")
    parser.add_argument("--output")
    parser.add_argument("--profile", default="")
    parser.add_argument("--keep-going", action="store_true")
    parser.add_argument("--dry-run", action="store_true")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("files", nargs="*")
    options = parser.parse_args()
    if len(options.files) != 1:
        raise InputError("`voussoir study` needs one study file. `voussoir study --help` shows how.")
    if options.jobs and not (options.jobs.isdecimal() and 0 < int(options.jobs) <= 10000):
        raise InputError(f'--jobs must be a positive number, not "{options.jobs}".')
    if options.profile:
        check_profile(options.profile)
    return options


def check_profile(profile):
    """Throws InputError unless Snakemake will find it: a directory, or one by its name among the user's or the machine's."""
    homes = [os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config", *(os.environ.get("XDG_CONFIG_DIRS") or "/etc/xdg").split(":")]
    places = [Path(profile), *(Path(home) / "snakemake" / profile for home in homes)]
    if not any(list(place.glob("config*.yaml")) for place in places if place.is_dir()):
        raise InputError(f"--profile: {profile} is no profile of Snakemake: no directory {' or '.join(dict.fromkeys(map(str, places[:2])))} "
                         "with a config.yaml.")


def jobs_and_threads(options, study):
    """Number of simultaneous scenes, and of threads of each; together at most the number of cores, except by option."""
    cores = len(os.sched_getaffinity(0))
    jobs = int(options.jobs) if options.jobs else max(1, cores // max(1, study.threads))
    threads = study.threads or (1 if options.profile else max(1, cores // jobs))
    if jobs * threads > cores and not options.profile:
        print(f"voussoir: warning: {jobs} scenes at a time with {threads} threads each are more than the {cores} cores here.",
              file=sys.stderr)
    return jobs, threads


# ---------------------------------------------------------------- scenes

def slug(entry, text, length):
    """A factor in a name: "factor-0.4", "scale-y-minus-1"."""
    value = Path(text).stem if is_file_entry(entry) or entry == "Scene" else re.sub(r"^-(?=[\d.])", "minus ", text)
    return re.sub("[^a-z0-9.]+", "-", " ".join([*entry.split("/")[-length:], value or "none"]).lower()).strip("-.")


def names_of(study):
    """A directory's name for each scene, from what varies; equal ones get a digest."""
    last = Counter(entry.split("/")[-1] for entry in study.factors)
    names = []
    for _, _, values in study.scenes:
        parts = [slug(entry, values[entry].text, 1 if last[entry.split("/")[-1]] == 1 else 9) for entry in study.factors]
        names.append("_".join(parts) or "scene")
    count = Counter(name.lower() for name in names)
    for i, (base, _, values) in enumerate(study.scenes):
        if count[names[i].lower()] > 1 or len(names[i]) > 100:
            text = repr((str(base), sorted((value.entry, value.text) for value in values.values())))
            names[i] = f"{names[i][:90]}-{hashlib.sha256(text.encode()).hexdigest()[:8]}"
    seen = set()
    for name, (base, _, values) in zip(names, study.scenes):
        scene = (base, tuple(sorted((entry, value_in(entry, value.text)) for entry, value in values.items() if entry != "Scene")))
        if scene in seen:
            place = list(values.values())[-1].place
            raise InputError(f"{place}: this scene ({name}) is in the study twice. Leave one.")
        seen.add(scene)
    return names


def in_words(study, values):
    """A scene by what makes it different."""
    return ", ".join(f"{entry} = {values[entry].text}" for entry in study.factors) or "the only scene"


def entries_with(base, words, known):
    """All entries of the base with these words. Scenes that differ in plain numbers are asked for once: a start of the program
    takes longer than all else here. Whether the numbers can be is for --validate to say."""
    numbers = {entry: text for entry, text in words.items() if PLAIN_NUMBER.fullmatch(text)}
    kind = (base, frozenset(numbers), tuple(sorted((entry, text) for entry, text in words.items() if entry not in numbers)))
    if kind not in known:
        entries = entries_of(base, words)
        if any(entries.get(entry) != text for entry, text in numbers.items()):
            return entries  # it is written in another way
        known[kind] = entries
    return {**known[kind], **numbers}


def text_of_scene(study, scene, known):
    """A scene with every entry, files by their whole path, and the files it reads."""
    base, fixed, values = scene
    chosen = {value.entry: value for value in [*fixed.values(), *values.values()] if value.entry != "Scene"}
    words = {"Output/Figures": "false"}
    for entry, value in chosen.items():
        words[entry] = with_paths(entry, value.text, study.file.parent)[0]
    try:
        entries = entries_with(base, words, known)
    except InputError as error:
        named = [value.place for entry, value in chosen.items() if f'"{entry}"' in str(error)]
        raise InputError(str(error).replace("--set:", f"{named[0]}:", 1) if named else
                         f"{study.file.name}, {in_words(study, values)}: {error}") from None
    files = []
    for entry, value in entries.items():
        entries[entry], found = with_paths(entry, value, base.parent)
        files += found
        for file in found:
            if "#" in file:
                raise InputError(f"{file}: a path with # cannot stand in a scene file. Give the directory another name.")
    return prm_text(entries), files


def key_of(text, files):
    """A digest of all that a run reads."""
    digest = hashlib.sha256(text.encode())
    for file in files:
        digest.update(Path(file).read_bytes() if Path(file).is_file() else b"missing")
    return digest.hexdigest()


def validated(study, directory, scene, name, old, known):
    """One line of scenes.json: key, memory, values. Writes the scene's file; runs --validate unless that was done."""
    text, files = text_of_scene(study, scene, known)
    key, path = key_of(text, files), directory / "scenes" / f"{name}.prm"
    before = old.get(name, {})
    if not path.exists() or path.read_text() != text:
        write_whole(path, text)
    memory = before.get("mem_mb") if before.get("key") == key else None
    if memory is None:
        result = start(path, "--validate", "--output", directory / "runs" / name, "--overwrite")
        if result.returncode != 0:
            text_of_scene(study, scene, {})  # tells the line of the study if an entry's value cannot be
            raise InputError(f"{study.file.name}, {in_words(study, scene[2])}: {message_of(result.stderr, result.returncode)}")
        found = re.search(r"^Memory\s+about ([0-9.]+) GiB", result.stdout, re.MULTILINE)
        memory = int(1024 * float(found.group(1))) + 1 if found else 0
    return {"key": key, "mem_mb": memory, "values": {entry: scene[2][entry].text for entry in study.factors}}


def validate_all(study, directory, names, jobs):
    """scenes.json's scenes; an error names the first scenes that cannot be run."""
    try:
        old = json.loads((directory / "scenes.json").read_text())["scenes"]
    except (OSError, ValueError, KeyError):
        old = {}
    with ThreadPoolExecutor(min(jobs, len(os.sched_getaffinity(0)))) as pool:
        known = {}
        futures = [pool.submit(validated, study, directory, scene, name, old, known) for scene, name in zip(study.scenes, names)]
        scenes, errors = {}, []
        for name, future in zip(names, futures):
            try:
                scenes[name] = future.result()
            except InputError as error:
                if str(error) not in errors:
                    errors.append(str(error))
            except KeyboardInterrupt:
                pool.shutdown(cancel_futures=True)
                raise
    if errors:
        more = f" {len(errors) - 1} more of the {len(names)} scenes cannot be run, either." if len(errors) > 1 else ""
        raise InputError(errors[0] + more)
    return scenes


# ---------------------------------------------------------------- the workflow

def open_directory(options, study):
    """The study's directory, and the lock that keeps other studies out of it."""
    directory = Path(options.output or Path("output") / study.file.stem).resolve()
    if directory.exists() and not (directory / "scenes").is_dir() and (not directory.is_dir() or any(directory.iterdir())):
        raise InputError(f"{directory} has files that no study wrote. Choose another directory with --output.")
    return directory, lock_directory(directory, "study", ("scenes", "runs", "records", "done", "logs"))


def is_done(directory, name, scene):
    record = record_of(directory, name)
    return (record.get("key") == scene["key"] and record.get("status") == 0
            and (directory / "runs" / name / "summary.json").exists())


def take_over(directory, scenes):
    """Runs that were made under another name, before a factor came or went, get their new one."""
    recorded = {record.get("key"): path.stem for path in (directory / "records").glob("*.json")
                if (record := record_of(directory, path.stem)).get("status") == 0}
    for name, scene in scenes.items():
        before = recorded.get(scene["key"])
        if before and before != name and before not in scenes and not (directory / "runs" / name).exists():
            (directory / "runs" / before).rename(directory / "runs" / name)
            (directory / "records" / f"{before}.json").rename(directory / "records" / f"{name}.json")


def end_at_once_with_parent():
    """Ends Snakemake by SIGKILL together with its parent; the jobs then write their checkpoints. After SIGTERM Snakemake would wait for them."""
    end_with_parent(signal.SIGKILL)


def memory_at_hand():
    """Available memory [MiB]."""
    with open("/proc/meminfo", encoding="ascii") as file:
        return next(int(line.split()[1]) // 1024 for line in file if line.startswith("MemAvailable:"))


def start_snakemake(options, directory, jobs, threads):
    """Snakemake's process, in a group of its own."""
    words = ["snakemake", "--snakefile", "Snakefile", "--nolock", "--rerun-incomplete", "--rerun-triggers", "mtime"]
    if options.profile:
        profile = Path(options.profile)
        words += ["--profile", str(profile.resolve()) if profile.is_dir() else options.profile]
        words += ["--jobs", options.jobs] if options.jobs else []
    else:
        words += ["--cores", str(jobs * threads), "--resources", f"mem_mb={memory_at_hand()}", "--scheduler", "greedy"]
    if options.keep_going:
        words.append("--keep-going")
    with open(directory / "snakemake.log", "w", encoding="utf-8") as log:
        return subprocess.Popen(words, cwd=directory, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                                start_new_session=True, preexec_fn=end_at_once_with_parent)


def follow(process, directory, scenes, todo):
    """Prints a line for each scene that ends, until Snakemake does."""
    seen, total, ended = set(), len(scenes), False
    while not ended:
        ended = process.poll() is not None
        for name in todo:
            record = record_of(directory, name) if name not in seen else {}
            if record.get("key") != scenes[name]["key"]:
                continue
            seen.add(name)
            what = row_in_words(directory, name) if record["status"] == 0 else f"failed: {record['message']}"
            print(f"[{total - len(todo) + len(seen):>{len(str(total))}}/{total}] {name}: {what}", flush=True)
        if not ended:
            time.sleep(.1)


def run_workflow(options, directory, scenes, todo, jobs, threads):
    """Runs the remaining scenes, and records failures."""
    for name in todo:
        (directory / "records" / f"{name}.json").unlink(missing_ok=True)
    for name in scenes:
        (directory / "done" / name).touch() if name not in todo else (directory / "done" / name).unlink(missing_ok=True)
    process = start_snakemake(options, directory, jobs, threads)
    try:
        follow(process, directory, scenes, todo)
    except KeyboardInterrupt:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait()
        raise ComputationError(f"stopped; the same command goes on from the checkpoints in {directory}.") from None
    unknown = [name for name in todo if not record_of(directory, name)]
    if process.returncode and len(unknown) == len(todo):
        said = (directory / "snakemake.log").read_text(errors="replace").strip().splitlines()
        raise ComputationError(f"Snakemake ran no scene. It said, in {directory / 'snakemake.log'}: " + " ".join(said[-3:]))


def report(directory, scenes):
    """Names what failed; the study's status."""
    failed = [name for name in scenes if record_of(directory, name).get("status", 0)]
    missing = [name for name, scene in scenes.items() if not is_done(directory, name, scene) and name not in failed]
    for name in failed:
        print(f"voussoir: failed: {name}: {record_of(directory, name)['message']}", file=sys.stderr)
    if missing:
        print(f"voussoir: failed: {len(missing)} scenes were not run: {', '.join(missing[:5])}"
              f"{', ...' if len(missing) > 5 else ''}. --keep-going runs them in spite of the failure.", file=sys.stderr)
    revisions = sorted({revision for name in scenes if (revision := revision_of(directory, name))})
    if len(revisions) > 1:
        print(f"voussoir: warning: these results are of {len(revisions)} versions of the program ({', '.join(revisions)}).", file=sys.stderr)
    return 1 if failed or missing else 0


def main(job):
    """Reads, checks, runs, gathers and draws; @p job: the command file that runs one scene."""
    options = arguments()
    if shutil.which("snakemake") is None:
        raise InputError("`voussoir study` needs Snakemake (on Debian: apt-get install snakemake).")
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    study = read_study(options.files[0], options.set)
    names = names_of(study)
    jobs, threads = jobs_and_threads(options, study)
    directory, lock = open_directory(options, study)
    with lock:
        at_a_time = "as the profile says" if options.profile and not options.jobs else f"{jobs} at a time"
        print(f"Study     {study.file.stem}: {len(names)} scenes, {at_a_time}, with {threads} thread{'s' if threads > 1 else ''} each", flush=True)
        scenes = validate_all(study, directory, names, jobs)
        write_whole(directory / "scenes.json", json.dumps({"program": str(Path(find_program()).resolve()), "job": shlex.join((sys.executable, str(job))),
                                                           "threads": threads, "scenes": scenes}, indent=1))
        write_whole(directory / "Snakefile", SNAKEFILE)
        take_over(directory, scenes)
        todo = [name for name, scene in scenes.items() if not is_done(directory, name, scene)]
        print(f"Done      {len(scenes) - len(todo)} before, {len(todo)} to do; at most "
              f"{max(scene['mem_mb'] for scene in scenes.values()) / 1024:.2f} GiB for a scene", flush=True)
        if options.dry_run:
            print("\n".join(f"to do     {name}" for name in todo) or "nothing to do")
            return 0
        if todo:
            run_workflow(options, directory, scenes, todo, jobs, threads)
        from .study_figures import draw  # what takes a second to load
        from .study_results import write_results
        rows = write_results(study, directory, {name: scene for name, scene in scenes.items() if is_done(directory, name, scene)})
        draw(study, rows, directory / "figures")
        print(f"Results   {directory / 'results.csv'}, {directory / 'figures'}")
        return report(directory, scenes)
