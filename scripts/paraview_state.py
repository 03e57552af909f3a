#!/usr/bin/env pvpython
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows a run in ParaView over all times: the displaced dam in colours of the maximum principal stress, and next to it the joints in
colours of the opening. On Debian: apt-get install paraview python3-paraview.

    pvpython scripts/paraview_state.py DIR [--magnify 200] [--tension 6] [--time T] [--picture FILE.png] [--state FILE.pvsm]

DIR is the directory of a run with Output/Solution interval. --state writes a state that ParaView opens (File, Load State),
--picture a picture at a time, by default that of the largest opening. Without either: DIR/voussoir.pvsm. Where there is no screen:

    xvfb-run -a -s '-screen 0 1600x1000x24 -noreset' pvpython ...   # -noreset: else X may end between two windows of ParaView
"""

import argparse
import csv
import sys
from pathlib import Path

from paraview import simple

# Between 0 and 1, and red, green and blue there; compression is blue.
STRESS = [0., .36, .56, .73, .25, .66, .77, .84, .5, .91, .89, .85, .75, .87, .48, .23, 1., .66, .17, .12]
OPENING = [0., .93, .92, .90, .3, .94, .76, .48, .65, .87, .48, .23, 1., .66, .17, .12]


def widest(directory, times):
    """The time of the largest opening at the crest [s], of those that there are."""
    try:
        with open(directory / "joint_history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        best = max(rows, key=lambda row: max((float(v) for k, v in row.items() if k.startswith("opening")), default=0.))
        wish = float(best["time"])
    except (OSError, ValueError, KeyError):
        return times[-1]
    return min(times, key=lambda t: abs(t - wish))


def part(source, number, name):
    """The dam (0) or its joints (1) of solution.pvd."""
    return simple.ExtractBlock(registrationName=name, Input=source, Selectors=[f"/Root/Block{number}"])


def moved(source, magnify, name):
    warp = simple.WarpByVector(registrationName=name, Input=source)
    warp.Vectors, warp.ScaleFactor = ["POINTS", "displacement"], magnify
    return warp


def coloured(source, view, array, factor, title, limits, palette, corner):
    """Shows the source by an array of its points times a factor, with a bar between the limits."""
    scaled = simple.Calculator(registrationName=title, Input=source)
    scaled.ResultArrayName, scaled.Function = title, f"{factor}*{array}"
    shown = simple.Show(scaled, view)
    simple.ColorBy(shown, ("POINTS", title))
    shown.Representation, shown.EdgeColor, shown.LineWidth = "Surface With Edges", [.35, .35, .35], .5
    colours = simple.GetColorTransferFunction(title)
    colours.RGBPoints = [value if k % 4 else limits[0] + value * (limits[1] - limits[0]) for k, value in enumerate(palette)]
    colours.ColorSpace = "Lab"
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle, bar.WindowLocation, bar.ScalarBarLength = title, "", corner, .3
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.3g", "%.3g"
    bar.TitleColor = bar.LabelColor = [.1, .1, .1]
    shown.SetScalarBarVisibility(view, True)
    return shown


def largest(source, array, time):
    """The largest value of an array of the points at a time."""
    source.UpdatePipeline(time)
    found = source.GetDataInformation().GetPointDataInformation().GetArrayInformation(array)
    return found.GetComponentRange(0)[1] if found else 0.


def scene(directory, magnify, tension, time):
    """The pipeline; its view and the time that is shown."""
    run = simple.PVDReader(registrationName=directory.name, FileName=str(directory / "solution.pvd"))
    times = list(run.TimestepValues) if hasattr(run.TimestepValues, "__len__") else [run.TimestepValues]
    time = min(times, key=lambda t: abs(t - time)) if time is not None else widest(directory, times)
    view = simple.CreateView("RenderView")
    view.ViewSize, view.UseColorPaletteForBackground, view.Background = [1600, 900], 0, [1., 1., 1.]
    view.OrientationAxesVisibility = 1
    view.OrientationAxesLabelColor = [.1, .1, .1]
    run.UpdatePipeline(time)
    bounds = run.GetDataInformation().GetBounds()
    coloured(moved(part(run, 0, "dam"), magnify, f"displacement x {magnify:g}"), view, "max_principal", 1e-6, "tension [MPa]",
             (-tension, tension), STRESS, "Lower Right Corner")
    joints = part(run, 1, "joints")
    opening = 1e3 * max(largest(joints, "opening", time), 1e-6)
    above = coloured(moved(joints, magnify, f"joints x {magnify:g}"), view, "opening", 1e3, "opening [mm]", (0., opening), OPENING,
                     "Upper Left Corner")
    above.Position = [0., 0., 1.3 * (bounds[5] - bounds[4])]  # in its place the dam would hide them
    above.Ambient, above.Diffuse = 1., 0.
    text = simple.Text(registrationName="what", Text=f"{directory.name}: displacements {magnify:g} times; above: the joints")
    label = simple.Show(text, view)
    label.Color, label.FontSize, label.WindowLocation = [.1, .1, .1], 14, "Lower Center"
    clock = simple.Show(simple.AnnotateTimeFilter(registrationName="time", Input=run, Format="t = {time:.2f} s"), view)
    clock.Color, clock.FontSize, clock.WindowLocation = [.1, .1, .1], 16, "Upper Right Corner"
    animation = simple.GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    animation.AnimationTime = view.ViewTime = time
    middle = [.5 * (bounds[2 * d] + bounds[2 * d + 1]) for d in range(3)]
    size = max(bounds[2 * d + 1] - bounds[2 * d] for d in range(3))
    middle[2] += .66 * (bounds[5] - bounds[4])
    view.CameraFocalPoint, view.CameraViewUp = middle, [0., 0., 1.]
    view.CameraPosition = [middle[0] + 1.05 * size, middle[1] - .65 * size, middle[2] + .45 * size]  # from downstream and the right bank
    return view, time


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--magnify", type=float, default=200.)
    parser.add_argument("--tension", type=float, default=6., help="where the colours end [MPa]")
    parser.add_argument("--time", type=float)
    parser.add_argument("--picture")
    parser.add_argument("--state")
    options = parser.parse_args()
    directory = options.directory.resolve()
    if not (directory / "solution.pvd").is_file():
        print(f"paraview_state: error: {options.directory} holds no solution.pvd: run the scene with --set 'Output/Solution interval=4'.",
              file=sys.stderr)
        return 2
    view, time = scene(directory, options.magnify, options.tension, options.time)
    simple.Render(view)
    if options.picture:
        simple.SaveScreenshot(options.picture, view)
        print(f"{options.picture}: t = {time:g} s")
    if options.state or not options.picture:
        state = options.state or str(directory / "voussoir.pvsm")
        simple.SaveState(state)
        print(f"{state}: open it by File, Load State")
    simple.Delete(view)  # before Python ends: X may be gone then
    return 0


if __name__ == "__main__":
    sys.exit(main())
