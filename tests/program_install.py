#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Test of an installation: a program of a user is built against it, and the installed program runs a scene with figures.

    program_install.py VOUSSOIR CASE... with the environment of the build: CMAKE, BUILD, BUILD_TYPE, CXX, GENERATOR
"""

import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from run_program import expect, run_cases, summary, write_scene  # noqa: E402

USER = Path(__file__).resolve().parent / "user_project"


def does(*command, environment=None):
    """The command must succeed; its standard output."""
    result = subprocess.run(command, capture_output=True, text=True, timeout=240,
                            env={**os.environ, **(environment or {})})
    expect(result.returncode == 0, f"status {result.returncode} of {command}: {result.stdout[-3000:]}{result.stderr[-3000:]}")
    return result.stdout


def install():
    cmake, prefix = os.environ["CMAKE"], Path("prefix").absolute()
    does(cmake, "--install", os.environ["BUILD"], "--prefix", str(prefix))
    for file in ("bin/voussoir", "include/voussoir/contact/joint_law.h", "share/voussoir/scripts/figures.py",
                 "share/voussoir/prm/quickstart.prm", "share/voussoir/meshes/keys_law.msh"):
        expect((prefix / file).is_file(), f"{file} is not installed")

    # Nothing of the installation may point to the sources or to where they were built.
    configuration = "".join(file.read_text() for file in prefix.glob("lib*/**/cmake/Voussoir/*.cmake"))
    for place in (os.environ["BUILD"], str(USER.parent.parent)):
        expect(place not in configuration, f"the package configuration names {place}")

    print("    a user's program")
    does(cmake, "-S", str(USER), "-B", "user", "-G", os.environ["GENERATOR"], f"-DCMAKE_PREFIX_PATH={prefix}",
         f"-DCMAKE_CXX_COMPILER={os.environ['CXX']}", f"-DCMAKE_BUILD_TYPE={os.environ['BUILD_TYPE']}",
         "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON")
    does(cmake, "--build", "user")
    for program in ("sliding_joint", "sliding_joint_dealii"):
        text = does(f"user/{program}")
        expect(text == "normal 1000 N, tangential -800 N\n", f"{program} prints {text!r}")

    print("    the installed program")
    write_scene()
    environment = {"VOUSSOIR_SCRIPTS": ""}
    program = str(prefix / "bin" / "voussoir")
    does(program, "scene.prm", "--set", "Output/Figures=true", "--output", "out", environment=environment)
    expect(len(list(Path("out/figures").glob("*.png"))) >= 3, "the installed program drew no figures")
    expect(summary("out")["steps"] > 0, "no steps")
    does(program, str(prefix / "share/voussoir/prm/keys_law.prm"), "--validate", environment=environment)


run_cases(install)
