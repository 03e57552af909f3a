#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: input that it must refuse, with status 2 and one paragraph. Each row of a group has the entries (texts A/B=C) or
arguments of a run, and the parts that the message must have. Refusals of a single case stand beside the other tests of their subject.

    program_refusals.py VOUSSOIR GROUP...     groups: the functions at the end of the file
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "golden"), str(HERE.parent / "meshes")]
import koyna  # noqa: E402
import meshes  # noqa: E402
import program_base  # noqa: E402
from compare import scene  # noqa: E402
from program_cohesive import SHORT  # noqa: E402
from program_lift import LIFTS, wall  # noqa: E402
from program_subcycling import OWN, ROCK  # noqa: E402
from program_plane_strain import PLANE  # noqa: E402
from program_spectrum import ARTIFICIAL  # noqa: E402
from program_zones import CELLS  # noqa: E402
from run_program import expect, refused, run_cases, runs, settings, voussoir, write, write_scene  # noqa: E402


def refuse(before, rows):
    """Each row: entries, as one text or several, and a tuple of the parts of the message."""
    for *entries, parts in rows:
        refused([*before, *settings(*entries)], *parts)


def base():
    """Base joints where they cannot be, joints that do not exist, laws that do not fit."""
    write_scene()
    bonded = ["scene.prm", *program_base.ARCH]
    refuse([*bonded, *program_base.BASE], (
        ("Foundation/Model=massless", "Dynamics/Impact=none", ("Base joints on massless rock", "mean-force")),
        ("Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60", "Dynamics/Steps per sample=5",
         "Dynamics/Impact=paper", ("Joints cross", "joint 1, base 1, base 2", "mean-force")),
        ("Joints/Overrides=base 9: tied", ("base 9", "7 joints")),
        ("Loads/Uplift/Joints=true", "Loads/Uplift/Base=true", ("Uplift/Joints", "Uplift/Base")),
        ("Statics/Stages=grout 100, fill 100", "Mesh/Arch210/Joints=0", ("Statics/Stages", "grouts joints", "no contraction joints")),
        ("Statics/Stages=grout 100, fill 100", "Joints/Overrides=contraction: tied",
         ("Statics/Stages", "grouts joints", "all contraction joints are tied"))))
    refuse(bonded, (
        ("Joints/Overrides=base: tied", ("\"base\"", "contraction")),
        ("Joints/Adhesion=1 MPa", "Joints/Friction=0", ("Adhesion", "Friction")),
        ("Joints/Normal stiffness=1e11", "Joints/Equations=paper", ("alart-curnier",)),
        ("Joints/Normal stiffness=1e11", "Dynamics/Impact=paper", ("mean-force",))))


def lift():
    """Lift joints where they cannot be, and names that are wrong."""
    write_scene()
    bonded = ["scene.prm", *program_base.ARCH]
    refuse([*bonded, *LIFTS], (
        ("Dynamics/Impact=paper", ("Joints cross", "mean-force")),
        ("Joints/Overrides=lift 2.7: tied", ("lift 2.7",)),
        ("Joints/Overrides=lift: tied", "Joints/Initial gaps=lift 2.1: 1 mm", ("lift 2.1", "tied")),
        ("Joints/Overrides=lift: tied", "Statics/Stages=cut lift 2.1 by 1 mm", ("lift 2.1", "tied")),
        ("Joints/Overrides=99999999999999999999: tied", ("99999999999999999999",))))
    refuse(bonded, (("Mesh/Arch210/Lift joints=6", ("Lift joints", "6 rows")),))
    wall("gap.msh", 1, 2, 3)
    write("gap.msh", Path("gap.msh").read_text().replace("lift 3", "lift 4"))
    refused([scene("gap", "gap.msh", **program_base.sections({"joints": {}}))], "lifts of monolith 1", "gaps")


def gaps():
    """Gaps and cuts of joints that do not exist or are tied; amounts that are no lengths or pressures."""
    write_scene()
    refuse(["scene.prm"], (
        ("Statics/Stages=cut 9 by 1 mm", ("Statics/Stages", "joint 9", "2 joints")),
        ("Statics/Stages=cut base by 1 mm", ("\"base\"",)),
        ("Statics/Stages=cut contraction by 1 mm", "Joints/Overrides=1: tied", ("cuts joint 1", "tied")),
        ("Statics/Stages=cut 1 by -1 mm", ("cut J by W",)),
        ("Statics/Stages=cut 1", ("cut J by W",)),
        ("Statics/Stages=cut 1 by 1 MPa", ("width", "unit of pressure")),
        ("Statics/Stages=grout 100 at 3 m", ("pressure", "unit of length")),
        ("Statics/Stages=grout 100 at -1", ("grout Z at P",)),
        ("Statics/Stages=fill 100 at 1 MPa", ("fill Z",)),
        ("Joints/Initial gaps=1: -1 mm", ("Initial gaps", "-1 mm")),
        ("Joints/Initial gaps=1: wide", ("Initial gaps", "wide")),
        ("Joints/Initial gaps=1: 2 s", ("Initial gaps", "unit of time")),
        ("Joints/Initial gaps=4: 1 mm", ("Initial gaps", "joint 4", "2 joints")),
        ("Joints/Model=KSM", "Joints/Keys/Clearances=1: -1 mm", ("Keys/Clearances", "-1 mm")),
        ("Joints/Model=KSM", "Joints/Keys/Clearances=4: 1 mm", ("Keys/Clearances", "joint 4", "2 joints")),
        ("Joints/Initial gaps=1: 1 mm", "Joints/Overrides=1: tied", ("gap of joint 1", "tied")),
        ("Mesh/Arch210/Base joint=true", "Joints/Overrides=base: KSM", ("KSM", "base 1", "base: FJA"))))
    refuse(["scene.prm", "--validate"], (("Statics/Stages=cut 1 by 0", ("cut 1 by 0", "cut J by W")),))


def cohesive():
    """Rules and equations that do not fit a bond."""
    write_scene()
    refuse(["scene.prm", "--output", "x", *SHORT, *settings("Joints/Model=cohesive", "Joints/Strength=1 MPa", "Joints/Fracture energy=0")], (
        ("Dynamics/Impact=paper", ("cohesive", "Dynamics/Impact", "mean-force")),
        ("Joints/Equations=paper", ("cohesive", "alart-curnier"))))


def choices():
    """A choice that does not exist, such as one of an earlier version."""
    write_scene()
    refuse(["scene.prm", "--validate"], (
        ("Dynamics/Impact=impulse-consistent", ("Dynamics/Impact", "impulse-consistent", "mean-force")),
        ("Joints/Equations=fischer-burmeister", ("Joints/Equations", "fischer-burmeister", "alart-curnier"))))


def damping():
    """Damping that cannot be fitted, or does not fit the foundation."""
    write_scene()
    refuse(["scene.prm", "--validate"], (
        ("Damping/Mass coefficient=1", ("together",)),
        ("Damping/Model=uniform", "Damping/Band end=0.4", ("Band begin", "0.4")),
        ("Damping/Model=uniform", "Damping/Ratio=0.5", ("Damping/Ratio", "0.25")),
        ("Damping/Model=uniform", "Damping/Reference frequency=-2", ("Reference frequency",)),
        ("Damping/Model=uniform", "Foundation/Model=massless", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60",
         "Dynamics/Impact=paper", ("mean-force",))))


def explicit():
    """What the explicit scheme does not have, and steps above the critical one."""
    write_scene()
    rock = ("Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60")
    scheme = ["scene.prm", *settings("Dynamics/Scheme=explicit", "Motion/Duration=0.1", "Output/Figures=false")]
    uniform = [*scheme, *settings("Damping/Model=uniform")]
    refuse([*scheme, "--validate"], (("Damping/Model=Rayleigh", ("stiffness-proportional", "uniform")),))
    refuse([*uniform, "--validate"], (
        ("Foundation/Model=massless", *rock, "Mesh/Arch210/Base joint=true", ("Base joints on massless rock", "trapezoidal")),
        ("Foundation/Model=rock", *rock, "Mesh/Arch210/Base joint=true", ("Base joints on rock", "trapezoidal")),
        ("Foundation/Model=rock", *rock, "Damping/Model=Rayleigh", "Damping/Mass coefficient=0.6", "Damping/Stiffness coefficient=0",
         ("mass-proportional", "uniform")),
        ("Reservoir/Model=incompressible", ("incompressible water", "acoustic")),
        ("Dynamics/Impact=paper", ("rule of impact",)), ("Dynamics/Explicit step=0", ("Explicit step",))))
    text = runs(*uniform, "--output", "limit")
    critical = float(re.search(r"step of an explicit scheme for the dam (\S+) ms", text)[1]) * 1e-3
    text = runs(*uniform, "--validate", *settings("Reservoir/Model=acoustic", "Damping/Reference frequency=2"))
    of_water, of_both = float(re.search(r"critical time step (\S+) s", text)[1]), float(re.search(r"scheme for the dam (\S+) ms", text)[1]) * 1e-3
    expect(.8 < of_both / min(critical, of_water) < 1, f"critical step of the dam {critical}, of the water {of_water}, of both {of_both}")
    refuse([*uniform, "--validate"], ((f"Dynamics/Explicit step={1.001 * critical}", ("above the critical step", "Explicit step")),))
    expect(f"steps of {1e3 * .01 / 20:.3g} ms" in runs(*uniform, "--output", "below", *settings("Dynamics/Explicit step=0.0005"))
           or critical < .0005, "the step that was asked for")


def intervals():
    """Intervals of outputs: samples of the motion (10 ms), or times with a unit that are multiples of them."""
    write_scene()
    for entry in ("Envelope", "Solution", "Checkpoint", "Progress"):
        refuse(["scene.prm", "--validate"], [(f"Output/{entry} interval={value}", (f"Output/{entry} interval", *parts)) for value, *parts in (
            ("15 ms", "1.5 samples", "Motion/Time step, 0.01 s"), ("1e-9 s", "samples"), ("3 m", "from"), ("1.5", "from"), ("-1", "from"),
            ("often", "from"))])
    refuse(["scene.prm", "--validate"], [("Output/Progress interval=0", ("from 1",))])
    for name, value in (("samples", "10"), ("time", "0.1 s"), ("milliseconds", "100 ms")):
        runs("scene.prm", "--output", name, *settings(f"Output/Solution interval={value}", f"Output/Envelope interval={value}"))
    undated = lambda path: re.sub(rb"generated by .*", b"", path.read_bytes())
    for path in Path("samples").iterdir():
        if path.suffix in (".csv", ".vtu", ".pvd"):
            for other in ("time", "milliseconds"):
                expect(undated(path) == undated(Path(other, path.name)), f"{path.name} of {other}")
    expect(len(list(Path("time").glob("solution-*.vtu"))) == 6, "six solutions in 0.5 s")


def subcycling():
    """What does not fit subcycled rock is refused before the run; --validate names the coupling."""
    write_scene()
    run = ["scene.prm", "--validate"]
    expect("mean tractions" in runs(*run, *OWN), "--validate names the coupling")
    expect("mean tractions" not in runs(*run, *ROCK, *settings("Dynamics/Steps per sample=8")), "one step for all is the partition")
    refuse([*run, *OWN], (("Dynamics/Impact=paper", ("mean-force", "Dynamics/Impact")),))
    refuse([*run, *ROCK], (
        ("Contact/Write problems=true", "Foundation/Coupling=auto", "Foundation/Substeps=4", ("Foundation/Model",)),
        ("Contact/Write problems=true", "Foundation/Coupling=partition", "Foundation/Substeps=1", ("Foundation/Model",)),
        ("Foundation/Substeps=50", "Dynamics/Steps per sample=1", ("layers", "Foundation/Substeps")),
        ("Foundation/Substeps=1", "Dynamics/Steps per sample=1", ("Steps per sample", "\"Foundation/Substeps\" to"))))
    for other in ("Dynamics/Impact=paper", "Foundation/Coupling=partition"):  # these exclude substeps
        message = refused([*run, *ROCK, *settings("Foundation/Substeps=1", "Dynamics/Steps per sample=1", other)], "Steps per sample")
        expect("Substeps" not in message and "Coupling" not in message, message)
    near = [*run, *ROCK, *settings("Mesh/Arch210/Joints=2", "Mesh/Arch210/Elements along=9", "Mesh/Arch210/Elements up=4",
                                   "Mesh/Arch210/Elements through=2", "Dynamics/Steps per sample=1",
                                   *(f"Mesh/Arch210/Rock/{side}=100" for side in ("Upstream", "Downstream", "Sides", "Depth")))]
    shown = runs(*near, *settings("Foundation/Substeps=0"))
    steps = int(re.search(r"(\d+) rock steps", shown).group(1))  # the boundary requires more of them than the critical time step
    refuse(near, ((f"Foundation/Substeps={steps - 1}", ("artificial boundary", "node spacing", f"\"Foundation/Substeps\" to {steps}")),))


def zones():
    """What is no material, or no zone of the mesh, is refused with entry and zone."""
    meshes.zoned_arch("entries.msh", *CELLS)
    refuse([scene("entries", "entries.msh"), "--validate"], [(f"Concrete/Zones={value}", ("Concrete/Zones", *parts)) for value, *parts in (
        ("hell: 24e9 .2 2400", "\"hell\"", "Did you mean \"heel\"?"),
        ("heel: 24e9 .2", "\"heel\"", "three values"),
        ("heel: 24e9 .5 2400", "\"heel\"", "Poisson's ratio", "from 0 to 0.499"),
        ("heel: -24e9 .2 2400", "\"heel\"", "modulus of elasticity", "positive"),
        ("heel: 24e9 .2 0", "\"heel\"", "density", "positive"),
        ("heel: 24 kN/m^3 .2 2400", "\"heel\"", "Pa"),
        ("heel: 24e9 .2 2400, Heel: 2e9 .2 2400", "twice"),
        ("Höcker: 24e9 .2 2400", "\"Höcker\"", "letters"),
        ("heel 24e9 .2 2400",))])
    refuse([scene("ratios", "entries.msh"), "--validate", *settings("Damping/Ratio=0.05", "Damping/Model=uniform")], [
        (f"Damping/Zones={value}", ("Damping/Zones", *parts)) for value, *parts in (
            ("hell: 0.03", "\"hell\"", "Did you mean \"heel\"?"), ("heel: 0", "\"heel\"", "above 0"), ("heel: 0.3", "up to 0.25"), ("heel: much", "\"much\""),
            ("heel: 0.03, Heel: 0.02", "two ratios"))] + [("Damping/Ratio=0", "Damping/Zones=heel: 0.03", ("Damping/Zones", "Damping/Ratio")),
        ("Motion/Source=artificial", "Motion/Duration=1", "Damping/Zones=heel: 0.25", "Damping/Reference frequency=0.1", ("0.25", "closer together"))])
    write("letters.msh", Path("entries.msh").read_text().replace("heel", "Höcker"))
    refused([scene("letters", "letters.msh"), "--validate"], "letters.msh", "Höcker'", "letters")
    refuse([scene("generated", "entries.msh"), "--validate"], (
        ("Mesh/Source=arch210", "Concrete/Zones=heel: 24e9 .2 2400", ("Concrete/Zones", "no zones")),))


def plane_strain():
    """examples/koyna has no warning; dams and models that cannot be in plane strain are refused."""
    shown = runs(str(HERE.parent / "examples" / "koyna" / "scene.prm"), "--validate")
    expect("plane strain" in shown and "warning" not in shown, shown)
    write_scene()
    run = ["scene.prm", "--validate"]
    refuse(run, (("Mesh/Plane strain=true", ("Mesh/Plane strain", "the same section at each y", "slice")),))
    koyna.write("koyna.msh", 4, 10, rock=(8, 8))
    meshes.on_rock("held.msh", 5., 2, (0, 2), 2, 2, 6)  # artificial boundary also at the sides
    across = meshes.block(lambda i, j, k: (10. * j, 5. * i, 20. * k), (1, 2), 2, 2, {**meshes.DAM, "right": None, "left": None})
    meshes.write("across.msh", *across)
    refuse([*run, *PLANE, *settings("Reservoir/Density=1000")], (
        ("Mesh/File=held.msh", "Foundation/Model=massless", "Reservoir/Density=0", ("artificial boundary", "planes of symmetry", "(-2.5, -5, -7.5)")),
        ("Mesh/File=koyna.msh", "Foundation/Model=rock", "Reservoir/Density=0", "Foundation/Incidence=SH 20 0", ("Foundation/Incidence", "P and SV waves")),
        ("Mesh/File=across.msh", "Reservoir/Water level=35", ("(5, 5, 10) m", "without joints across y"))))


def spectrum():
    """Spectra that cannot be used, and warnings."""
    write("scene.prm", ARTIFICIAL)
    run = ["modes", "scene.prm", "--count", "1"]
    refused([*run, "--spectrum", "nothing.csv"], "nothing.csv", "--spectrum design")
    refused([*run, "--spectrum"], "--spectrum", "needs a value")
    refused(["scene.prm", "--spectrum", "design"], "no option --spectrum", "`voussoir modes`")
    refuse([*run, "--spectrum", "design"], (("Motion/Source=none", ("Motion/Source is none", "artificial")),
                                            ("Motion/Factor=0", ("zero", "Motion/Factor"))))
    write("short.csv", "0 3\n0.1 7\n")
    refused([*run, "--spectrum", "short.csv"], "short.csv ends", "0.1 s")
    hazard = "lon,lat,0.1~PGA,0.1~SA(4.0),0.02~PGA,0.02~SA(4.0)\n"
    for text, parts in ((hazard + "7,46,.2,.1,.4,.2\n", ("2 spectra", "0.1; 0.02", '"broken.csv: 0.1"')),
                        (hazard + "7,46,.2,.1,.4,.2\n8,46,.2,.1,.4,.2\n", ("4 spectra", "0.02 at 8 46")),
                        (hazard + "7,46,.2,.1,.4\n", ("line 2", "5 columns")),
                        ("Period (s),DBE (g),MCE (g)\n0,.2,.3\n4,.1,.2\n", ("2 spectra", "DBE (g); MCE (g)")),
                        ("T (s),A,B,C\n0,1,1,1\n4,1,1,1\n", ("3 spectra", "A; B; C")),
                        ("T (s),Sd (cm)\n0,.2\n4,.1\n", ("no column of accelerations",)), ("T (s),PSV\n0,.2\n4,.1\n", ("no column of accelerations",)),
                        ("T (s),Sa (mg)\n0,.2\n4,.1\n", ("Sa (mg)", "unit (mg)", "%g")), ("T (ms),Sa (g)\n0,.2\n4,.1\n", ("T (ms)", "in s.")),
                        ("f (Hz),Sa (g)\n0,.2\n50,.1\n", ("line 2", "inf s")), ('{"period": [0, 1]}', ("no numbers",)),
                        ("Unscaled\n -- Scaled Spectra used in Search & Scaling --\nPeriod (sec),Mean pSa (g),RSN-6 pSa (g)\n0.01,.2,.3\n4,.1,.2\n",
                         ("2 spectra", "Mean pSa (g); RSN-6 pSa (g)"))):
        write("broken.csv", text)
        refused([*run, "--spectrum", "broken.csv"], "broken.csv", *parts)
    refused([*run, "--spectrum", "broken.csv: 0.3"], "named '0.3'", "Mean pSa (g)")
    write("weak.csv", "0 0.3\n4 0.1\n")
    write("uhs.csv", hazard + "7,46,.2,.1,.4,.2\n")
    for arguments, parts in ((["weak.csv"], ("weak.csv is 0.3 m/s^2", "headings")), (["design", *settings("Damping/Ratio=0.1")], (" (of its file, or Motion/Damping), but Damping/Ratio is 0.1",)),
                             (["uhs.csv: 0.02", *settings("Damping/Ratio=0.1")], ("ratio of 0.05 (of its file",))):
        result = voussoir(*run, "--spectrum", *arguments)
        expect(result.returncode == 0 and all(part in result.stderr for part in parts), f"{result}")


def suite():
    """Records that cannot be scaled to a spectrum."""
    write("scene.prm", "subsection Motion\n  set Source = file\n  set Match = scale\n  set Target spectrum = target.csv\nend\n")
    write("target.csv", "T (s), Sa (g)\n0,.2\n4,.1\n")
    write("record.csv", "".join(f"{.02 * k:.2f} {k % 7 - 3} {k % 5 - 2} {k % 3 - 1}\n" for k in range(100)))
    record = "Motion/File=record.csv"
    refuse(["motion", "scene.prm", "--output", "out.csv"], (
        ("Motion/Source=artificial", ("Motion/Match is scale", "artificial")),
        (record, "Motion/Target spectrum=", ("Motion/Match is scale", "no Motion/Target spectrum")),
        (record, "Motion/Abutments=left 5: record.csv", "Foundation/Model=massless", ("Motion/Match is scale", "Motion/Abutments")),
        (record, "Motion/Match band=2, 0.2", ("Motion/Match band is 2, 0.2", "shorter one first")),
        (record, "Motion/Match band=0.2", ("Motion/Match band is 0.2", "two periods")),
        (record, "Motion/Match band=0.2, x", ("Motion/Match band", "'x'")),
        (record, "Motion/Match band=0.2, 5", ("target.csv", "at 5 s or later", "change Motion/Match band")),
        (record, "Motion/Time step=0.05", ("Motion/Time step", "0.02 s")),
        (record, "Motion/Damping=0.02", "Motion/Target spectrum=other.csv", ("other.csv", "cannot be opened")),
        ("Motion/Ensemble=record.csv; none.csv", ("none.csv", "cannot be opened"))))
    refused(["motion", "scene.prm", "--output", "suite.csv", *settings("Motion/Ensemble=record.csv")], "suite.csv", "another")


if __name__ == "__main__":
    run_cases(base, lift, gaps, cohesive, choices, damping, explicit, intervals, subcycling, zones, plane_strain, spectrum, suite)
