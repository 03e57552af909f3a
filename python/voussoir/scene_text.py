# SPDX-License-Identifier: GPL-3.0-or-later
"""A new input file, for `voussoir new` and `voussoir arcs`: entries with values, each with a comment from its help text.

The program checks the entries. The files that they name are relative to the directory of the input file."""

import os
import re
from pathlib import Path
from tempfile import TemporaryDirectory

from .command import write_whole
from .errors import ComputationError, InputError
from .prm import prm_text, read_entries
from .program import declarations, message_of, set_options, start

FILES = ("Mesh/File", "Mesh/Arcs/Table", "Motion/File", "Motion/File x", "Motion/File y", "Motion/File z")
MATERIAL = ("Young's modulus", "Poisson's ratio", "Density")
NUMBERS = ("[Double", "[Integer")


class SceneText:
    """The entries of the file, "Section/Entry" -> text, and what the program declares about all entries. InputError if the file exists."""

    def __init__(self, file):
        self.file, self.directory = file, os.path.dirname(file)
        self.expect_new()
        self.known, self.values = declarations(), {}

    def default(self, name):
        """The default of an entry."""
        return self.known[name]["default_value"]

    def choices(self, name):
        """The choices of an entry as ", one of: ...", or an empty text."""
        found = re.fullmatch(r"\[Selection (.*?) *\]", self.known[name]["pattern_description"])
        return ", one of: " + found[1].replace("|", ", ") if found else ""

    def run(self, command, entries):
        """Runs `voussoir COMMAND` with these entries, "" for --validate. Returns its output and messages, or throws its errors."""
        entries = {name: os.path.join(os.getcwd(), self.directory, value) if name in FILES and value else value for name, value in entries.items()}
        with TemporaryDirectory() as directory:
            scene = Path(directory, "scene.prm")
            scene.touch()
            words = {"": [scene, "--validate"], "scene": ["scene", scene]}.get(command, [command, scene, "--output", Path(directory, "new.msh")])
            result = start(*words, *set_options(entries))
        messages = result.stderr.replace(os.getcwd() + "/", "").replace("--set: entry ", "").replace(" (--set)", "")
        if result.returncode != 0:
            raise (InputError if result.returncode == 2 else ComputationError)(message_of(messages, result.returncode))
        return result.stdout, messages

    def set(self, name, value):
        """Sets an entry. Returns the number of an entry that is one, in its unit. InputError for an invalid or unusual value."""
        if "#" in value:
            raise InputError(f'An input file cannot contain "#" in "{value}". Rename the file.')
        choices, number = self.choices(name), None
        if choices and value not in choices.removeprefix(", one of: ").split(", "):
            raise InputError(f'"{name}" cannot be "{value}". It must be {choices[2:]}.')
        if self.known[name]["pattern_description"].startswith(NUMBERS):
            text = value
            if value != self.default(name):
                output, messages = self.run("scene", {**self.values, name: value})
                text = read_entries(output)[name][0]
                if unusual := re.search(rf"warning: ({re.escape(name)} is .*: usual is .*)", messages):
                    raise InputError(unusual[1])
            number = float(text)
        self.values[name] = value
        return number

    def add(self, *names):
        """Adds entries with their defaults, if they have no values."""
        for name in names:
            self.values.setdefault(name, self.default(name))

    def mesh_facts(self, **grid):
        """Bottom, top, crest [m], volume [m3] and smallest scaled Jacobian of the dam; whether there is rock. grid: as Elements_along=40."""
        entries = {f"Mesh/Arcs/{name.replace('_', ' ')}": f"{value:.9g}" for name, value in grid.items()}
        text, _ = self.run("mesh", {**{name: value for name, value in self.values.items() if name.startswith("Mesh/")}, **entries})
        dam = re.search(r"^dam : z from (\S+) to (\S+) m, crest (\S+) m, volume (\S+) m3", text, re.M)
        jacobian = re.search(r"^dam : .*smallest scaled Jacobian ([^\s,]+)", text, re.M)
        return {**dict(zip(("bottom", "top", "crest", "volume"), map(float, dam.groups()))), "jacobian": jacobian[1],
                "rock": re.search("^rock: ", text, re.M) is not None}

    def add_materials(self):
        """Adds the numbers that the models of the joints and of the foundation read, and those of concrete and damping."""
        models = {name: self.values[name] for name in ("Joints/Model", "Foundation/Model")}
        names = [name for name, entry in self.known.items() if name.startswith("Joints/") and "[" in entry["documentation"]
                 and entry["pattern_description"].startswith(NUMBERS)] + [f"Foundation/{name}" for name in MATERIAL]
        # The program names entries without effect if they do not have their defaults.
        other = {name: 1.1 * float(self.default(name)) if float(self.default(name)) > 0 else 1e-6 for name in names}
        _, messages = self.run("scene", {**models, **other})
        idle = ", ".join(re.findall("warning: (.*?) ha(?:s|ve) no effect", messages)).split(", ")
        self.add(*(name for name in names if name not in idle), *(f"Concrete/{name}" for name in MATERIAL))
        if self.values["Motion/Source"] != "none":
            self.add(*(f"Damping/{name}" for name in ("Ratio", "Frequency 1", "Frequency 2")))

    def comment(self, name):
        """The first sentence of the help text, with the unit and the choices, and the sentence about the value -1."""
        text = self.known[name]["documentation"]
        sentences = [text.split(". ")[0].rstrip(".") + self.choices(name)]
        if self.values[name] == "-1" and "-1: " in text:
            sentences.append("-1: " + text.split("-1: ")[1].split(". ")[0].rstrip("."))
        return ". ".join(sentences) + "."

    def expect_new(self):
        """Throws InputError if the file exists, or if its directory does not."""
        if os.path.lexists(self.file):
            raise InputError(f"The file {self.file} exists, and is not replaced. Name another file, or remove it.")
        if self.directory and not os.path.isdir(self.directory):
            raise InputError(f"There is no directory {self.directory} for the file {self.file}. Create it, or name another file.")

    def write(self, heading):
        """Writes the file. InputError if the entries contradict one another, or if the file exists."""
        self.run("scene", self.values)
        entries = {name: self.values[name] for name in self.known if name in self.values}
        text = prm_text(entries, {name: self.comment(name) for name in entries})
        self.expect_new()
        try:
            write_whole(self.file, heading + re.sub("^subsection", "\nsubsection", text, flags=re.M))
        except OSError as error:
            raise ComputationError(f"The file {self.file} cannot be written: {error.strerror}. Name another file.") from None
