#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Test of an installation: a program of a user is built against it, and the installed program runs a scene with figures; and of the
Debian packages, what they say and hold (scripts/try_package.sh installs them in a clean root).

    program_install.py VOUSSOIR CASE... with the environment of the build: CMAKE, BUILD, BUILD_TYPE, CXX, GENERATOR
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from run_program import VOUSSOIR, expect, run_cases, summary, write_scene  # noqa: E402

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
    for file in ("bin/voussoir", "include/voussoir/contact/joint_law.h", "share/voussoir/scripts/figures.py", "share/voussoir/python/voussoir/report.css",
                 "share/voussoir/prm/quickstart.prm", "share/voussoir/meshes/koyna.msh", "share/voussoir/examples/keys/scene.prm",
                 "share/bash-completion/completions/voussoir"):
        expect((prefix / file).is_file(), f"{file} is not installed")

    # Nothing of the installation may point to the sources or to where they were built.
    configuration = "".join(file.read_text() for file in prefix.glob("lib*/**/cmake/Voussoir/*.cmake"))
    for place in (os.environ["BUILD"], str(USER.parent.parent)):
        expect(place not in configuration, f"the package configuration names {place}")

    print("    a user's program")
    does(cmake, "-S", str(USER), "-B", "user", "-G", os.environ["GENERATOR"], f"-DCMAKE_PREFIX_PATH={prefix}",
         f"-DCMAKE_CXX_COMPILER={os.environ['CXX']}", "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON")  # no build type: that of the library
    does(cmake, "--build", "user")
    for program in ("sliding_joint", "sliding_joint_dealii"):
        text = does(f"user/{program}")
        expect(text == "normal 1000 N, tangential -800 N\n", f"{program} prints {text!r}")
    does(cmake, "-S", str(USER), "-B", "user", f"-DCMAKE_BUILD_TYPE={os.environ['BUILD_TYPE']}")

    print("    the installed program")
    write_scene()
    environment = {"VOUSSOIR_SCRIPTS": ""}
    program = str(prefix / "bin" / "voussoir")
    does(program, "scene.prm", "--set", "Output/Figures=true", "--output", "out", environment=environment)
    expect(len(list(Path("out/figures").glob("*.png"))) >= 3, "the installed program drew no figures")
    expect(summary("out")["steps"] > 0, "no steps")
    does(program, str(prefix / "share/voussoir/examples/koyna/scene.prm"), "--validate", environment=environment)
    completion = (prefix / "share/bash-completion/completions/voussoir").read_text()
    expect(completion == does(program, "completion", "bash"), "the installed completion is not that of the program")


def packages():
    """CPack's two Debian packages: fields, files, and a page of the manual that names every command."""
    tools = ("dpkg-deb", "dpkg-shlibdeps", "gzip")
    if missing := [tool for tool in tools if shutil.which(tool) is None]:
        print(f"not installed: {', '.join(missing)}")
        sys.exit(77)
    cpack = str(Path(os.environ["CMAKE"]).parent / "cpack")
    does(cpack, "-G", "DEB", "--config", str(Path(os.environ["BUILD"]) / "CPackConfig.cmake"), "-B", "packages",
         "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")
    version = does(VOUSSOIR, "--version").split()[1]
    found = {name: Path("packages").glob(f"{name}_{version}_*.deb") for name in ("voussoir", "voussoir-dev")}
    found = {name: [str(path) for path in paths] for name, paths in found.items()}
    expect(all(len(paths) == 1 for paths in found.values()), f"{found}, {list(Path('packages').iterdir())}")
    fields = {name: does("dpkg-deb", "-f", path) for name, (path,) in found.items()}
    for name, parts in (("voussoir", ("Section: science", "python3-matplotlib", "libdeal.ii-", "libcholmod", "snakemake", "chromium")),
                        ("voussoir-dev", ("Section: libdevel", "libdeal.ii-dev", "libsuitesparse-dev"))):
        for part in (f"Package: {name}\n", f"Version: {version}\n", "Maintainer: ", *parts):
            expect(part in fields[name], f"{name} has no {part!r}: {fields[name]}")
        print(f"    {name}: {re.search('Installed-Size: (.*)', fields[name])[1]} kB")
    files = {name: {line.split()[5] for line in does("dpkg-deb", "-c", path).splitlines()} for name, (path,) in found.items()}
    for name, parts in (("voussoir", ("bin/voussoir", "share/voussoir/scripts/report.py", "share/voussoir/python/voussoir/report.py",
                                      "share/voussoir/prm/quickstart.prm", "share/man/man1/voussoir.1.gz", "share/bash-completion/completions/voussoir",
                                      "share/doc/voussoir/copyright", "share/doc/voussoir/changelog.gz", "share/doc/voussoir/doc/install.md")),
                        ("voussoir-dev", ("include/voussoir/contact/joint_law.h", "share/doc/voussoir-dev/copyright"))):
        for part in parts:
            expect(f"./usr/{part}" in files[name], f"{name} does not hold {part}")
    expect(not files["voussoir"] & {file for file in files["voussoir-dev"] if not file.endswith("/")}, "a file is in both packages")
    manual = re.sub(r"\W+", " ", Path(os.environ["BUILD"], "debian", "voussoir.1").read_text())
    commands = re.findall(r"^voussoir ([a-z]+) ", does(VOUSSOIR, "--help"), re.M)
    expect(len(commands) > 9, f"{commands}")
    for command in commands:
        expect(f" {command} " in manual, f"the page of the manual does not know {command}")


run_cases(install, packages)
