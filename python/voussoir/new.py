# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir new`: asks for the main choices on standard input, checks each answer, and writes a commented input file."""

import math
import os
import re
import sys

from .command import Parser
from .errors import InputError
from .scene_text import SceneText

SECTIONS = {"arch210": "Mesh/Arch210/", "arcs": "Mesh/Arcs/"}
STEPS = (1, 2, 5, 10, 20, 50)
FILES = ("Motion/File", "Motion/File x", "Motion/File y", "Motion/File z")


class NewScene(SceneText):
    """Questions on standard output, and the input file of the answers."""

    ended = False  # the standard input

    def until_valid(self, questions):
        """Repeats questions until the answers are valid. At the end of the input an error is final."""
        while True:
            try:
                return questions()
            except InputError as error:
                if self.ended:
                    raise
                print(f"   {error}")

    def ask(self, name, standard=None, check=lambda number: None):
        """Asks for an entry until its value is valid. The end of the input is the standard. check(number): throws InputError."""
        standard = self.default(name) if standard is None else standard

        def question():
            print(f"   {name}{self.choices(name)} [{standard}]: ", end="", flush=True)
            line = sys.stdin.buffer.readline()
            self.ended = not line
            answer = line.decode(errors="replace").strip() or standard
            if self.ended or not sys.stdin.isatty():
                print(answer)
            check(self.set(name, answer))

        print(self.known[name]["documentation"])
        self.until_valid(question)

    def ask_file(self, name, needed=False):
        """Asks for a file that exists, or an empty answer if no file is needed."""
        def check(_):
            file = os.path.join(self.directory, self.values[name])
            if self.values[name] and not os.path.isfile(file):
                raise InputError(f"The file {file} does not exist. Correct the name.")
            if not self.values[name]:
                self.forget(name)
                if needed:
                    raise InputError("Name a file.")

        self.ask(name, "", check)

    def forget(self, *names):
        """Removes entries of a previous attempt."""
        for name in names:
            self.values.pop(name, None)

    def ask_dam(self):
        """Asks for the mesh."""
        self.values.clear()  # of a previous attempt
        self.ask("Mesh/Source")
        source = self.values["Mesh/Source"]
        if source == "file":
            self.ask_file("Mesh/File", needed=True)
            self.ask("Mesh/Axes")
            self.ask("Mesh/Length unit")
        if source == "arcs":
            self.ask("Mesh/Arcs/Kind")
            self.ask_file("Mesh/Arcs/Table", needed=True)
        if source in SECTIONS:
            self.add(*(SECTIONS[source] + name for name in ("Joints", "Elements along", "Elements up", "Elements through")))
        self.mesh = self.mesh_facts()

    def ask_water(self):
        """Asks for a water level at the dam."""
        low, high = self.mesh["bottom"], self.mesh["top"]

        def check(level):
            if not low < level <= high:
                raise InputError(f"The dam is from z = {low:g} to {high:g} m. Choose a level between.")

        self.ask("Reservoir/Water level", f"{math.floor(low + .93 * (high - low)):g}", check)

    def ask_joints(self):
        """Asks for the joint law."""
        self.ask("Joints/Model")
        if self.values["Joints/Model"] == "cohesive":
            self.values["Joints/Fracture energy"] = "150 N/m"
            self.ask("Joints/Strength", "1 MPa")
            self.ask("Joints/Fracture energy", "150 N/m")

    def set_rock(self, _):
        """Adds rock to the mesh of a foundation that needs it, and chooses its time step."""
        self.forget(*(section + "Rock/Enabled" for section in SECTIONS.values()), "Dynamics/Steps per sample")
        model, source = self.values["Foundation/Model"], self.values["Mesh/Source"]
        if model != "rigid" and source == "file" and not self.mesh["rock"]:
            raise InputError("The mesh has no volumes of rock. Choose rigid.")
        if model != "rigid" and source in SECTIONS:
            self.values[SECTIONS[source] + "Rock/Enabled"] = "true"
        if model != "rock":
            return None
        print("   The critical time step of the rock is computed.", flush=True)
        least = 1
        for steps in STEPS:
            self.values["Dynamics/Steps per sample"] = str(steps)
            try:
                if steps >= least or steps == STEPS[-1]:
                    return self.run("", {**self.values, "Foundation/Substeps": "1"})
            except InputError as error:
                needed = re.search(r'"Dynamics/Steps per sample" to (\d+)', str(error))
                least = int(needed[1]) if needed else 1
                if steps == STEPS[-1]:
                    raise

    def ask_motion(self):
        """Asks for the ground motion."""
        self.ask("Motion/Source")
        source = self.values["Motion/Source"]
        if source == "none":
            return self.forget("Dynamics/Steps per sample")
        if source == "artificial":
            self.ask("Motion/Peak acceleration")
        else:
            self.until_valid(self.ask_records)
        return self.add("Motion/Duration", "Motion/Time step")

    def ask_records(self):
        """Asks for the files of the ground motion and their unit. InputError for a motion of unusual size."""
        self.forget(*FILES)  # of a previous attempt
        self.ask_file(FILES[0])
        if FILES[0] not in self.values:
            for name in FILES[1:]:
                self.ask_file(name)
        self.ask("Motion/Unit")
        report, _ = self.run("motion", {name: value for name, value in self.values.items() if name.startswith("Motion/")})
        if found := re.search(r"^warning: (the (?:peak acceleration of the )?motion (?:is|has a peak velocity).*)$", report, re.M):
            raise InputError(found[1])


def main(words=None):
    """The command."""
    parser = Parser(prog="voussoir new", description=__doc__)
    parser.add_argument("file", nargs="*")
    files = parser.parse_args(words).file
    if len(files) > 1:
        raise InputError(f'`voussoir new` writes one file. Remove the argument "{files[1]}".')
    scene = NewScene(files[0] if files else "dam.prm")
    print("Enter takes the value in brackets. The end of the input takes all remaining ones.")
    parts = {"Dam": lambda: scene.until_valid(scene.ask_dam), "Water": scene.ask_water, "Joints": scene.ask_joints,
             "Foundation": lambda: scene.ask("Foundation/Model", check=scene.set_rock), "Ground motion": scene.ask_motion}
    for number, (title, questions) in enumerate(parts.items(), 1):
        print(f"\n{number}. {title}")
        questions()
    scene.add_materials()
    scene.write("# Scene of a dam, written by `voussoir new`. All other entries have their defaults.\n"
                "# Check each value: `voussoir parameters SECTION` describes all entries of a section.\n")
    print(f"\n{scene.file} is written. Check each value, then\n    voussoir {scene.file} --validate\n    voussoir {scene.file}")
    return 0
