#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of frames.bin and of the moving dam in `voussoir report`, in a real browser.

    program_view3d.py VOUSSOIR CASE...

The browser is a headless Chromium; where it or the libraries are missing the case is skipped (status 77), and says so.
"""

import base64
import hashlib
import json
import re
import sys
import time
import zlib
from pathlib import Path

import numpy as np

from browser import Browser, find_browser
from program_ranks import ROCK
from program_report import Reader
from run_program import expect, refused, report, reports, run_cases, runs, settings, summary, write_scene
from voussoir.frames import Frames, joint_of
from voussoir.picture import read_solution
from voussoir.report_view3d import LIBRARIES, SCRIPTS, figure_of, magnification
from voussoir.runs import Run
from voussoir.tables import read_table

MOVING = settings("Joints/Friction=0.3")
WATER = settings("Reservoir/Model=acoustic", "Reservoir/Element size=25")


def nodes_of(monolith, points):
    """Names of nodes that are the same in both files: monolith and place."""
    return list(map(tuple, np.column_stack([monolith, np.rint(50. * points)]).astype(int).tolist()))


def frames():
    """Displacement, stress, opening and pressure of the water of every frame are those of the solution at its time; the quadrilaterals enclose
    the dam."""
    write_scene()
    runs("scene.prm", "--output", "dry", *MOVING, *settings("Output/Frames=4"))
    expect(not Frames("dry").has_pressure and Frames("dry").units.shape[1] == 3, "a pressure without compressible water")
    runs("scene.prm", "--output", "run", *MOVING, *WATER, *settings("Output/Solution interval=1", "Output/Frames=1000", "Mesh/Arch210/Equal rows=true"))  # nearly plane faces
    found = Frames("run")
    step = np.rint(found.times / .01).astype(int)
    expect(len(step) > 40 and step[0] == 0 and (np.diff(step)[1:] == 1).all(), f"steps of the frames: {step}")
    monolith = np.zeros(len(found.points))
    monolith[found.quads] = found.monolith[:, None]
    for k in (0, 1, len(step) // 2, len(step) - 1):
        data = read_solution(Path(f"run/solution-{step[k]:05d}.vtu"), displacement=3, max_principal=1, opening=1, water_pressure=1, monolith=1)
        at = {name: i for i, name in enumerate(nodes_of(data["monolith"], data["Points"]))}
        rows = [at[name] for name in nodes_of(monolith, found.points)]
        for c, (name, column) in enumerate({"displacement": "displacement", "stress": "max_principal", "opening": "opening",
                                            "pressure": "water_pressure"}.items()):
            error = np.abs(found.values(name, [k])[0] - data[column][rows]).max()
            unit, largest = found.units[k][c], np.abs(data[column][rows]).max()
            print(f"    frame {k}: {name} up to {largest:.4g}, error {error:.2g}, unit {unit:.2g}")
            expect(error <= .51 * unit + 1e-6 * largest, f"frame {k}: {name} has an error of {error}, unit {unit}")
            if (k, name) == (0, "pressure"):  # of the static state
                expect(largest == 0., f"dynamic pressure of {largest} Pa at the start")
                continue
            expect(largest > 0. and unit < largest / 32766., f"frame {k}: {name} up to {largest}, unit {unit}")
    x = found.points.astype(float)[found.quads]
    volume = sum(np.einsum("ij,ij->i", x[:, 0], np.cross(x[:, a], x[:, b])).sum() / 6. for a, b in ((1, 2), (2, 3)))
    by_cells = sum(volume_of(data["Points"].astype(float)[cell]) for cell in data["connectivity"])
    print(f"    volume {volume:.8g} m3, by the cells {by_cells:.8g} m3")
    expect(abs(volume / by_cells - 1.) < 2e-4, f"the surface encloses {volume} m3, not {by_cells} m3")
    expect({joint_of(s) for s in found.surface.tolist()} == {0, 1, 2}, f"surfaces {set(found.surface.tolist())}")


def volume_of(corners):
    """Of a hexahedron of VTK, by two points of Gauss in each direction."""
    signs = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
    total = 0.
    for point in signs / np.sqrt(3.):
        part = 1. + signs * point
        gradient = np.stack([signs[:, c] * part[:, (c + 1) % 3] * part[:, (c + 2) % 3] / 8. for c in range(3)])
        total += abs(np.linalg.det(gradient @ corners))
    return total


def times():
    """The frames are in the strong part of the motion and not more than Output/Frames; on rock, relative to the base."""
    write_scene()
    for number in (0, 1, 2, 7, 20):
        runs("scene.prm", "--output", "run", "--overwrite", *settings(f"Output/Frames={number}", "Motion/Duration=3"))
        expect(Path("run/frames.bin").exists() == (number > 0), f"frames.bin with Output/Frames={number}")
        if number == 0:
            continue
        table = read_table("run/history.csv")
        square = np.cumsum(sum(table[f"base_acceleration_{c}"]**2 for c in "xyz"))
        first, last = (table["time"][np.searchsorted(square, part * square[-1])] for part in (.05, .95))
        found = Frames("run").times
        print(f"    {number}: {len(found)} frames, strong part {first:g} to {last:g} s, {found[1:2]} to {found[-1]:g} s")
        expect(len(found) <= number and found[0] == 0., f"{len(found)} frames with Output/Frames={number}")
        if number > 1:
            expect(abs(found[1] - first) < 1e-9 and found[-1] <= last + 1. + 1e-9, f"{found} beside {first} to {last} s")
            expect(len(found) > .6 * number and np.ptp(np.diff(found[1:]), axis=0) < 1e-9 if number > 2 else True, f"intervals of {found}")
    runs("scene.prm", "--output", "rock", *ROCK)
    found, table = Frames("rock"), read_table("rock/history.csv")
    crest = {c: np.interp(found.times, table["time"], table[f"crest_{c}"]) for c in "xyz"}
    moved = found.values("displacement", np.arange(len(found.times)))
    error = min(max(np.abs(moved[:, node, c] - crest["xyz"[c]]).max() for c in range(3)) for node in range(len(found.points)))
    largest = max(np.abs(column).max() for column in crest.values())
    base = max(np.abs(table[f"base_{c}"]).max() for c in "xyz")
    print(f"    on rock: crest up to {largest:.3g} m, base {base:.3g} m, error {error:.2g} m")
    expect(error < 1e-4 * largest < base, f"no node moves as the crest of history.csv: {error} m")
    expect(not Frames("rock").has_stress, "stresses that are not recorded")


def chosen():
    """The report takes consecutive frames with the largest opening, and the largest factor 1, 2 or 5."""
    write_scene()
    runs("scene.prm", "--output", "run", *MOVING)
    found = Frames("run")
    opening = found.values("opening", np.arange(len(found.times))).max(axis=1)
    for count in (5, 17):
        some = found.strongest(count)
        expect(len(some) == count and (np.diff(some) == 1).all() and 1 + opening[1:].argmax() in some, f"{some}")
    expect(found.strongest(10**6).tolist() == list(range(1, len(found.times))), "all frames except the static state")
    for height, most, factor in ((120., .1, 100.), (120., .099, 100.), (120., .051, 100.), (120., .05, 200.), (120., .0199, 500.), (120., 50., 1.)):
        points, moved = np.array([[0., 0., 0.], [0., 0., height]]), np.array([[[0., 0., 0.], [0., -most, 0.]]])
        expect(abs(magnification(points, moved) - factor) < 1e-9, f"{most} m of {height} m: {magnification(points, moved)}, not {factor}")
    _, whole, _ = figure_of(Run("run"), found, True, 10**9)
    _, text, words = figure_of(Run("run"), found, True, len(whole) * 2 // 3)
    data = json.loads(text)
    n = len(data["times"])
    some = found.strongest(n)
    expect(len(text) <= len(whole) * 2 // 3 and 5 < n < len(found.times), f"{n} of {len(found.times)} frames, {len(text)} of {len(whole)} characters")
    expect(np.allclose(data["times"], found.times[some]) and f"t = {found.times[1 + opening[1:].argmax()]:.2f} s" in words, words)
    unpack = lambda text, kind: np.frombuffer(zlib.decompress(base64.b64decode(text)), kind)
    low, high = unpack(data["moved"], "u1").reshape(2, n, -1).astype(int)
    moved = np.cumsum(np.cumsum(low + 256 * high, axis=0), axis=0).astype(np.int16).reshape(n, -1, 3)
    expect(np.abs(data["unit"] * moved - found.values("displacement", some)).max() <= .51 * data["unit"] + 1e-9, "displacements of the page")
    history, table = data["history"], read_table("run/joint_history.csv")
    for joint, columns in history["joints"].items():
        for name, column in columns.items():
            values = column["unit"] * unpack(column["numbers"], "<i2")
            expect(np.abs(values - 1e3 * table[f"{name}_{joint}"]).max() <= .51 * column["unit"], f"{name} of joint {joint}")


def without():
    """Without the libraries: a picture, no script, and what brings the view; without frames: said at the end of the page."""
    write_scene()
    runs("scene.prm", "--output", "run")
    runs("report", "run", environment={"VOUSSOIR_JAVASCRIPT": "/nowhere"})
    html, read = Path("run/report.html").read_text(), Reader("run/report.html")
    expect("script" not in read.tags and "script-src" not in html and "libjs-three" in read.text, "the page without libraries")
    expect("The dam at t = " in read.text and "The moving dam" in read.text, "the picture is missing")
    runs("scene.prm", "--output", "still", *settings("Motion/Source=none", "Motion/File="))
    reports("still")
    text = Reader("still/report.html").text
    expect(len(Frames("still").times) == 1 and "The displaced dam" in text and "strongest seconds" not in text, text[:500])
    runs("scene.prm", "--output", "none", "--set", "Output/Frames=0")
    reports("none")
    text = Reader("none/report.html").text
    expect("The moving dam" not in text and "Output/Frames is 0" in text, text[-500:])
    data = Path("run/frames.bin").read_bytes()
    head = data.index(b"\n") + 1
    for damaged, word in ((data[:20], "damaged"), (b"{}\n" + data[head:], "damaged"), (data[:head + 50], "damaged"), (data.replace(b"frames 1", b"frames 9"), "format")):
        Path("run/frames.bin").write_bytes(damaged)
        refused(["run"], "run/frames.bin is damaged", word, "Repeat the run", run=report)
    Path("run/frames.bin").write_bytes(data[:-7])  # stopped while it wrote
    expect(len(Frames("run").times) > 10, "a run that was stopped")
    reports("run")


def mouse(chromium, kind, x, y, buttons=1):
    chromium.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left" if kind != "mouseMoved" or buttons else "none", buttons=buttons,
                  clickCount=1, pointerType="mouse")


def drag(chromium, x, y, dx, dy):
    mouse(chromium, "mouseMoved", x, y, 0)
    mouse(chromium, "mousePressed", x, y)
    for part in (.3, .7, 1.):
        mouse(chromium, "mouseMoved", x + part * dx, y + part * dy)
    mouse(chromium, "mouseReleased", x + dx, y + dy, 0)


def swipe(chromium, x, y, dx, dy):
    """The same with a finger."""
    point = lambda part: [{"x": x + part * dx, "y": y + part * dy}]
    chromium.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=point(0.))
    for part in (.3, .7, 1.):
        chromium.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=point(part))
    chromium.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])


def settled(chromium):
    """Waits for the next picture of the view."""
    chromium.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))))")


def box(chromium, selector):
    chromium.value(f"document.querySelector('{selector}').scrollIntoView({{block: 'center'}})")
    settled(chromium)
    return chromium.value(f"(r => [r.left, r.top, r.width, r.height])(document.querySelector('{selector}').getBoundingClientRect())")


VIEW = "document.querySelector('figure.view3d').view"


def view():
    """The view turns, shows times, joints, histories and other colours; no error, nothing of the network; on a desk and a telephone."""
    if find_browser() is None or not all((LIBRARIES / name).is_file() for name in SCRIPTS):
        print("SKIPPED: no Chromium, libjs-three or libjs-dygraphs (on Debian: apt-get install chromium libjs-three libjs-dygraphs)")
        sys.exit(77)
    write_scene()
    runs("scene.prm", "--output", "run", *MOVING, *WATER)
    runs("report", "run", "--pdf")
    html = Path("run/report.html").read_text(encoding="utf-8")
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', html)[1]
    scripts = re.findall(r"<script>(.*?)</script>", html, re.S)
    allowed = re.search(r"script-src ([^;]*);", policy)[1].split()
    hashes = [f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'" for script in scripts]
    expect(allowed == hashes and len(scripts) == 4 and "unsafe" not in policy and "http" not in policy, f"{policy}: {hashes}")
    size = Path("run/report.html").stat().st_size
    print(f"    page {size / 1e6:.2f} MB, scripts {sum(map(len, scripts)) / 1e6:.2f} MB")
    expect(size < 8e6, f"the page has {size} bytes")
    with Browser() as chromium:
        for width in (1280, 390):
            chromium.call("Emulation.setTouchEmulationEnabled", enabled=width < 600)
            chromium.open(Path("run/report.html"), width)
            deadline = time.monotonic() + 30.
            while not chromium.value(f"!!{VIEW}") and time.monotonic() < deadline:
                settled(chromium)
            turn(chromium, swipe if width < 600 else drag)
            slide(chromium)
            joints(chromium)
            colours(chromium)
            expect(chromium.value("document.documentElement.scrollWidth") <= width, f"the page scrolls sideways at {width} px")
            expect(not chromium.complaints(), f"at {width} px: {chromium.complaints()}")
        paper(chromium)


def turn(chromium, move):
    """A drag turns the camera around the dam, and changes the picture; the dam stays in the frame, also if it is magnified; reset brings all back."""
    expect(chromium.value("document.querySelectorAll('.view3d-on canvas').length") > 0, "no view: is there WebGL?")
    camera = lambda: np.array(chromium.value(f"{VIEW}.model.camera.position.clone().sub({VIEW}.model.controls.target).toArray()"))
    picture = lambda: chromium.value(f"({VIEW}.model.renderer.render({VIEW}.model.scene, {VIEW}.model.camera), {VIEW}.model.canvas.toDataURL())")
    x, y, w, h = box(chromium, ".view3d-stage")
    before, seen = camera(), picture()
    move(chromium, x + w / 2, y + h / 2, w / 5, h / 8)
    settled(chromium)
    after = camera()
    angle = np.degrees(np.arccos(before @ after / np.linalg.norm(before) / np.linalg.norm(after)))
    print(f"    turned by {angle:.1f} degrees")
    expect(angle > 10., f"camera from {before} to {after}")
    expect(picture() != seen, "the picture has not changed")
    for factor in (1., 10.):
        chromium.value(f"{VIEW}.magnify({factor} * {VIEW}.data.factor)")
        inside(chromium, f"turned by a drag, factor {factor}")
        for azimuth in range(0, 360, 45):
            chromium.value(f"(m => {{ const d = m.camera.position.distanceTo(m.controls.target); m.camera.position.set({np.cos(np.radians(azimuth))}, "
                           f"{np.sin(np.radians(azimuth))}, .5).setLength(d).add(m.controls.target); m.controls.update(); }})({VIEW}.model)")
            inside(chromium, f"azimuth {azimuth}, factor {factor}")
    chromium.value("document.querySelector('.view3d-reset').click()")
    settled(chromium)
    expect(np.allclose(camera(), before) and picture() == seen, "the view at the start")
    keyboard(chromium, camera, before)


def keyboard(chromium, camera, before):
    """Arrow keys turn the focused view, + comes nearer, Home goes back; every control has a name."""
    chromium.value(f"{VIEW}.model.canvas.focus()")
    press = lambda key: [chromium.call("Input.dispatchKeyEvent", type=kind, key=key, text=key if len(key) == 1 and kind == "keyDown" else "")
                         for kind in ("keyDown", "keyUp")]
    for _ in range(3):
        press("ArrowLeft")
    after = camera()
    azimuths = [np.arctan2(x[1], x[0]) for x in (before, after)]
    expect(abs(azimuths[0] - azimuths[1] - .3) < 1e-6, f"arrow keys turn from {azimuths[0]} to {azimuths[1]}")
    press("+")
    expect(np.linalg.norm(camera()) < .95 * np.linalg.norm(after), "+ does not come nearer")
    press("Home")
    expect(np.allclose(camera(), before), "Home does not go back to the start")
    nameless = chromium.value("[...document.querySelectorAll('select, input, button, canvas[tabindex]')].filter(e => e.offsetParent && !(e.labels && e.labels.length) && "
                              "!e.getAttribute('aria-label') && !e.textContent.trim()).map(e => e.outerHTML.slice(0, 80))")
    expect(not nameless, f"controls without a name: {nameless}")


def inside(chromium, what):
    """All nodes of the frame are in the picture. The largest coordinate in it is at most 1."""
    settled(chromium)
    largest = chromium.value(f"(m => {{ m.camera.updateMatrixWorld(); let most = 0; const x = m.position.array, p = m.middle.clone(); "
                             "for (let i = 0; i < x.length; i += 3) { p.set(x[i], x[i + 1], x[i + 2]).project(m.camera); "
                             f"most = Math.max(most, Math.abs(p.x), Math.abs(p.y), Math.abs(p.z)); }} return most; }})({VIEW}.model)")
    expect(.2 < largest <= 1., f"{what}: largest coordinate in the picture {largest}")


def slide(chromium):
    """The slider shows another frame: its time, and the places of its nodes."""
    found = Frames("run")
    some = found.strongest(len(found.times))
    x, y, w, h = box(chromium, ".view3d-slider")
    mouse(chromium, "mousePressed", x + .3 * w, y + h / 2)
    mouse(chromium, "mouseReleased", x + .3 * w, y + h / 2, 0)
    settled(chromium)
    at, shown = chromium.value(f"[{VIEW}.model.at, document.querySelector('.view3d-now').textContent]")
    expect(abs(at / (len(some) - 1) - .3) < .1 and shown == f"{found.times[some[at]]:.2f} s", f"frame {at} of {len(some)}: {shown}")
    place = np.array(chromium.value(f"Array.from({VIEW}.model.position.array)")).reshape(-1, 3)
    factor, unit = chromium.value(f"[{VIEW}.model.factor, {VIEW}.data.unit]")
    error = np.abs(place - found.points - factor * found.values("displacement", [some[at]])[0]).max()
    expect(error < .6 * factor * unit + 1e-4, f"nodes of frame {at} have an error of {error} m")
    chromium.value("document.querySelector('.view3d-play').click()")
    deadline = time.monotonic() + 20.
    while chromium.value(f"{VIEW}.model.at") == at and time.monotonic() < deadline:
        settled(chromium)
    expect(chromium.value(f"{VIEW}.model.at") != at, "the view does not play")
    chromium.value("document.querySelector('.view3d-play').click()")
    expect(not chromium.value(f"{VIEW}.playing"), "the view does not stop")


def joints(chromium):
    """A click beside each joint shows the history of this joint; a drag in a plot zooms."""
    table = read_table("run/joint_history.csv")
    for joint in (1, 2, 1):
        x, y, _, _ = box(chromium, ".view3d-stage")
        top = chromium.value(f"{VIEW}.model.topOf({joint})")
        for kind, buttons in (("mouseMoved", 0), ("mousePressed", 1), ("mouseReleased", 0)):
            mouse(chromium, kind, x + top["x"], y + top["y"] + 6, buttons)
        settled(chromium)
        expect(chromium.value(f"{VIEW}.model.joint") == joint, f"a click on joint {joint} chooses {chromium.value(f'{VIEW}.model.joint')}")
        heading = chromium.value("[...document.querySelectorAll('.view3d-heading b')].map(b => b.textContent)")
        expect(heading[:2] == [f"Joint {joint}: {what} at the crest [mm]" for what in ("opening", "slip")], f"{heading}")
        for plot in ("opening", "slip"):
            rows = np.array(chromium.value(f"{VIEW}.{plot}.graph.file_"))
            for c, face in ((1, "upstream"), (2, "downstream")):
                values = 1e3 * table[f"{plot}_{face}_{joint}"]
                expect(np.abs(rows[:, c] - values).max() <= 2e-5 * np.abs(values).max(), f"{plot} of joint {joint}, {face}")
            expect(np.abs(rows[:, 0] - table["time"]).max() < 1e-5, "times of the history")
    whole = chromium.value(f"{VIEW}.opening.graph.xAxisRange()")
    x, y, w, h = box(chromium, ".view3d-graph")
    drag(chromium, x + .5 * w, y + .5 * h, .25 * w, 0.)
    settled(chromium)
    low, high = chromium.value(f"{VIEW}.opening.graph.xAxisRange()")
    print(f"    plot from {whole} to {low:.3f}, {high:.3f} s")
    expect(whole[0] < low < high < whole[1] and high - low < .5 * (whole[1] - whole[0]), f"zoom from {whole} to {low}, {high}")
    mouse(chromium, "mouseMoved", x + .6 * w, y + .5 * h, 0)
    settled(chromium)
    text = chromium.value("document.querySelector('.view3d-heading').textContent")
    expect(re.search(r"t = [\d.]+ s ?upstream [\d.]+", text), f"values at the pointer: {text}")


def colours(chromium):
    """Each choice has its colours and its bar; the slider of the displacements magnifies."""
    seen = set()
    for mode in chromium.value(f"[...{VIEW}.modes.options].map(o => o.value)"):
        chromium.value(f"({VIEW}.modes.value = '{mode}', {VIEW}.modes.dispatchEvent(new Event('change')))")
        seen.add((chromium.value(f"Array.from({VIEW}.model.colour.array).join()"), chromium.value("document.querySelector('.view3d-bar').textContent")))
    expect(len(seen) == 4 and len({colour for colour, _ in seen}) == 4, f"{len(seen)} choices of colour")
    pressure(chromium)
    chromium.value(f"({VIEW}.modes.value = 'stress', {VIEW}.modes.dispatchEvent(new Event('change')))")
    factor = chromium.value(f"({VIEW}.factor.value = 1, {VIEW}.factor.dispatchEvent(new Event('input')), {VIEW}.model.factor)")
    expect(factor == 10. and "10" in chromium.value(f"{VIEW}.times.textContent"), f"displacements × {factor}")


def pressure(chromium):
    """The dynamic pressure has its limits in MPa in the bar, the colours of its numbers, and the camera upstream. The last choice shows it."""
    found, at = Frames("run"), chromium.value(f"Math.round({VIEW}.model.at)")
    chromium.value(f"{VIEW}.show({at})")
    values = found.values("pressure", found.strongest(len(found.times)))
    top = float(f"{1e-6 * np.abs(values).max():.2g}")
    bar = chromium.value("document.querySelector('.view3d-bar').textContent")
    digits = 2 if top >= .1 else 4
    expect(bar == f"dynamic water pressure [MPa]\u2212{top:.{digits}f}0{top:.{digits}f}", f"{bar}, largest {top} MPa")
    n = len(found.points)
    numbers = np.array(chromium.value(f"Array.from({VIEW}.model.pressure.subarray({at * n}, {(at + 1) * n}))"))
    error = np.abs((numbers / 127.5 - 1.) * top - np.clip(1e-6 * values[at], -top, top)).max()
    expect(error < .51 / 127.5 * top and np.ptp(numbers) > 20, f"pressures of frame {at} have an error of {error} MPa")
    camera = chromium.value(f"{VIEW}.model.camera.position.x - {VIEW}.model.controls.target.x")
    expect(camera < 0., "the camera is downstream of the wet face")


def paper(chromium):
    """On paper and without scripts there is the picture in place of the view."""
    shown = lambda: chromium.value("['.view3d-live', 'img.view3d-still'].map(s => getComputedStyle(document.querySelector(s)).display != 'none')")
    expect(shown() == [True, False], "view and picture on the screen")
    chromium.call("Emulation.setEmulatedMedia", media="print")
    expect(shown() == [False, True], "view and picture on paper")
    chromium.call("Emulation.setEmulatedMedia", media="")
    chromium.call("Emulation.setScriptExecutionDisabled", value=True)
    chromium.open(Path("run/report.html"), 794)
    chromium.call("Emulation.setScriptExecutionDisabled", value=False)
    expect(shown() == [False, True], "view and picture without scripts")
    expect(not chromium.complaints(), f"{chromium.complaints()}")
    expect(summary("run")["steps"] > 0 and Path("run/report.pdf").stat().st_size > 20000, "the PDF")


if __name__ == "__main__":
    run_cases(frames, times, chosen, without, view)
