#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A law that a user adds to the table has the same results as the law of the program that it repeats, also where joints cross.

    program_own_law.py VOUSSOIR_OWN CASE...     VOUSSOIR_OWN: the program with the law "own", which is FJB without its entries
"""

from pathlib import Path

from run_program import expect, run_cases, runs, settings, summary, write_scene


def own_law():
    """Bit for bit, in both schemes; the stresses are those of a dam."""
    write_scene()
    for scheme in ("trapezoidal", "explicit"):
        for law in ("FJB", "own"):
            runs("scene.prm", "--output", law, "--overwrite", *settings(
                f"Joints/Model={law}", "Mesh/Arch210/Lift joints=1", "Motion/Duration=0.5", f"Dynamics/Scheme={scheme}"))
        for table in ("joint_history.csv", "joints.csv"):
            expect(Path("FJB", table).read_bytes() == Path("own", table).read_bytes(), f"{scheme}: {table}")
        one, two = (summary(law)["extremes"] for law in ("FJB", "own"))
        largest = max(one[f"max_tension_{face}_away_from_base"]["value"] for face in ("upstream", "downstream"))
        print(f"    {scheme}: largest tension {1e-6 * largest:.2f} MPa")
        expect(one == two and 1e5 < largest < 3e7, f"{scheme}: {one}, {two}")


if __name__ == "__main__":
    run_cases(own_law)
