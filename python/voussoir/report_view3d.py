# SPDX-License-Identifier: GPL-3.0-or-later
"""The view of the moving dam in a report: a picture on paper and without scripts, otherwise a model that the reader turns.

The scripts are three.js and dygraphs of Debian's packages libjs-three and libjs-dygraphs, and report_view3d.js. The page contains them
and their data. Without the packages the page has the picture only."""

import json
import os
import re
from base64 import b64encode
from html import escape
from pathlib import Path
from zlib import compress

import numpy as np

from . import picture
from .errors import InputError
from .frames import Frames, edges_of, joint_of
from .report_figures import image
from .runs import Skip, read_table
from .drawing import plt

LIBRARIES = Path("/usr/share/javascript")  # of Debian; the environment variable VOUSSOIR_JAVASCRIPT names another directory, of npm
SCRIPTS = ("three/build/three.min.js", "three/examples/js/controls/OrbitControls.js", "dygraphs/dist/dygraph.min.js")
STYLE = "dygraphs/dist/dygraph.min.css"
LENGTH = 4_100_000  # of the data of all runs: scripts of 1 MB, figures of 2.6 MB, and these data are less than 8 MB
NUMBERS = 500_000  # in the histories of a run
STATIC_WORDS = "The dam with magnified displacements from the grouted state. Tension is positive."
COLUMNS = ("opening_upstream", "opening_downstream", "slip_upstream", "slip_downstream")
LIVE_WORDS = "The dam in its strongest seconds, with magnified displacements from the grouted state. A click on a joint shows its history. Tension is positive."
LICENCE = """/*! three.js, Copyright 2010 three.js authors. dygraphs, Copyright 2006 Dan Vanderkam, Copyright 2009 other contributors.
Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the
"Software"), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish,
distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to the
following conditions: The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF
MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY
CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE
SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE. */
"""


def section(page, runs):
    """Adds the section, its styles and its scripts to the page."""
    views = []
    for run in runs:
        try:
            views.append((run, Frames(run.directory)))
        except Skip as reason:
            page.missing.append(f"{run.name}: the moving dam: {reason}")
    if not views:
        return
    moves = any(len(frames.times) > 1 for _, frames in views)
    page.section("The moving dam" if moves else "The displaced dam")
    scripts, style = libraries()
    page.styles.append(Path(__file__).with_suffix(".css").read_text(encoding="utf-8") + style)
    if scripts:
        page.scripts += scripts
    for run, frames in views:
        found = page.made("the moving dam", lambda run=run, frames=frames: figure_of(run, frames, bool(scripts), LENGTH // len(views)))
        if found is None:
            continue
        still, data, words = found
        title = f'<p class="name">{escape(run.name)}</p>' if len(runs) > 1 else ""
        live = f'<div class="view3d-live"></div><script type="application/json">{data}</script>' if scripts else ""
        of_view = f'<span class="view3d-live">{LIVE_WORDS if moves else STATIC_WORDS}</span>' if scripts else ""
        caption = page.caption(f'<span class="view3d-still">{escape(words)}</span>{of_view}')
        page.add(f'<figure class="view3d">{title}{live}<img class="view3d-still" src="{still}" alt="{escape(words)}">{caption}</figure>')
    if not scripts:
        page.add('<p class="sub view3d-note">With the Debian packages libjs-three and libjs-dygraphs, <code>voussoir report</code> writes a view '
                 'that the reader turns.</p>')


def libraries():
    """Texts of the scripts of the page, and the style of dygraphs. Without the libraries: no scripts."""
    directory = Path(os.environ.get("VOUSSOIR_JAVASCRIPT") or LIBRARIES)
    try:
        texts = [(directory / name).read_text(encoding="utf-8") for name in (*SCRIPTS, STYLE)]
    except OSError:
        return [], ""
    texts = ["\n".join(line for line in text.splitlines() if "# sourceMappingURL=" not in line) for text in texts]
    scripts = [text.replace("</script", "<\\/script").replace("<!--", "\\x3c!--") for text in texts[:-1]]
    own = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")
    return [LICENCE + scripts[0], *scripts[1:], own], texts[-1].replace("</style", "")


def joint_nodes(frames):
    """Nodes on joints, and the joint of each."""
    joints = {}
    for surface, quad in zip(frames.surface.tolist(), frames.quads.tolist()):
        if joint := joint_of(surface):
            joints.update(dict.fromkeys(quad, joint))
    nodes = sorted(joints)
    return np.array(nodes, dtype=np.uint32), np.array([joints[node] for node in nodes], dtype=np.uint16)


def figure_of(run, frames, has_scripts, length):
    """Picture, data of the scripts as JSON of at most `length` characters, and caption."""
    count = len(frames.times)
    while True:
        shown = Shown(run, frames, frames.strongest(count))
        text = json.dumps(shown.data(), allow_nan=False).replace("<", "\\u003c") if has_scripts else ""
        if len(text) <= length or count <= 2:
            return draw_still(frames, shown), text, shown.words()
        count = max(2, min(count - 1, int(.98 * count * length / len(text))))


class Shown:
    """The chosen frames: displacements [m], openings [mm], stresses and pressures of the water [MPa] or None, and the largest ones of the colours."""

    def __init__(self, run, frames, chosen):
        self.run, self.frames, self.times = run, frames, frames.times[chosen]
        self.moved = frames.values("displacement", chosen)
        self.opening = 1e3 * frames.values("opening", chosen)
        self.factor = magnification(frames.points, self.moved)
        self.widest = int(np.argmax(self.opening.max(axis=1) if self.opening.max() > 0. else (self.moved**2).sum(axis=(1, 2))))
        self.stress = 1e-6 * frames.values("stress", chosen) if frames.has_stress else None
        self.pressure = 1e-6 * frames.values("pressure", chosen) if frames.has_pressure else None
        self.envelope = envelope_of(run, frames) if frames.has_stress else None
        top = 0. if self.stress is None else float(np.quantile(np.abs(self.stress if self.envelope is None else self.envelope), .995))
        self.top = float(np.ceil(top)) if top > 1. else float(f"{max(.1, top):.1g}")

    def words(self):
        opening = self.opening[self.widest].max()
        return (f"The dam at t = {self.times[self.widest]:.2f} s" + (f", largest opening {opening:.1f} mm" if opening > .05 else "")
                + f"; displacements from the grouted state × {self.factor:g}"
                + ("; colours: maximum principal stress, tension positive." if self.stress is not None else "."))

    def data(self):
        """Numbers for report_view3d.js. Every text is an array of packed()."""
        nodes, joints = joint_nodes(self.frames)
        edges, of_edges = edges_of(self.frames)
        unit, widest = float(np.abs(self.moved).max()) / 32767. or 1., float(self.opening.max())
        to_byte = lambda values, low, high: np.clip(np.rint(255. * (values - low) / (high - low)), 0, 255).astype(np.uint8)
        stresses = lambda values: None if values is None else to_byte(values, -self.top, self.top)
        pressure_top = 0. if self.pressure is None else float(f"{np.abs(self.pressure).max():.2g}")
        return {"points": packed(self.frames.points, "<f4"), "quads": packed(self.frames.quads, "<u4"), "edges": packed(edges, "<u4"),
                "edgeJoints": packed(of_edges, "<u2"), "times": [round(float(t), 6) for t in self.times], "unit": unit,
                "moved": packed_over_time(np.rint(self.moved / unit).astype(np.int16)), "factor": self.factor, "start": self.widest,
                "stress": self.stress is not None and packed_over_time(stresses(self.stress)), "stressTop": self.top,
                "envelope": self.envelope is not None and packed(stresses(self.envelope), "u1"),
                "pressure": pressure_top > 0. and packed_over_time(to_byte(self.pressure, -pressure_top, pressure_top)), "pressureTop": pressure_top,
                "jointNodes": packed(nodes, "<u4"), "nodeJoints": packed(joints, "<u2"),
                "opening": packed_over_time(to_byte(self.opening[:, nodes], 0., max(widest, 1e-9))), "openingTop": widest if widest > .05 else 0.,
                "history": history_of(self.run)}


def packed(values, kind):
    """Numbers of this type as text: compressed, in base64."""
    return b64encode(compress(np.ascontiguousarray(values).astype(kind).tobytes())).decode()


def packed_over_time(values):
    """The same for integers of 8 or 16 bits over time, as second differences, and low bytes before high bytes: half as long."""
    differences = values.copy()
    differences[1:] -= values[:-1]
    second = differences.copy()
    second[1:] -= differences[:-1]
    data = second.astype(f"<{values.dtype.kind}{values.dtype.itemsize}").tobytes()
    return packed(np.frombuffer(data, np.uint8).reshape(-1, values.dtype.itemsize).T, "u1")


def magnification(points, moved):
    """Factor 1, 2 or 5 times a power of ten: the largest displacement is at most a twelfth of the height of the dam."""
    most = np.sqrt((moved**2).sum(axis=2).max())
    if not most > 0.:
        return 1.
    wanted = np.ptp(points[:, 2]) / 12. / most
    power = 10.**np.floor(np.log10(wanted))
    return max(1., float(max(m * power for m in (1., 2., 5.) if m * power <= wanted)))


def envelope_of(run, frames):
    """Largest principal stress over time at the nodes [MPa], or None."""
    try:
        data = picture.read_solution(run.directory / "envelope.vtu", max_principal=1, monolith=1)
    except (InputError, OSError):
        return None
    keys = lambda monolith, points: map(tuple, np.column_stack([monolith, np.rint(50. * points)]).astype(int).tolist())
    known = dict(zip(keys(data["monolith"], data["Points"]), 1e-6 * data["max_principal"]))
    monolith = np.zeros(len(frames.points))
    monolith[frames.quads] = frames.monolith[:, None]
    return np.array([known.get(key, 0.) for key in keys(monolith, frames.points)])


def thinned(columns, most):
    """At most `most` rows: the value of the largest magnitude of each group of rows."""
    every = -(-len(columns["time"]) // most)
    if every == 1:
        return columns
    result = {}
    for name, values in columns.items():
        groups = np.append(values, np.repeat(values[-1], -len(values) % every)).reshape(-1, every)
        result[name] = groups[:, 0] if name == "time" else groups[np.arange(len(groups)), np.abs(groups).argmax(axis=1)]
    return result


def history_of(run):
    """Crest displacement, and opening and slip of the joints [mm], as numbers of 16 bits."""
    def numbers(values):
        unit = float(np.abs(values).max()) / 32767. or 1.
        return {"unit": unit, "numbers": packed(np.rint(values / unit), "<i2")}

    result = {"joints": {}, "crest": None}
    try:
        table = read_table(run.directory / "history.csv")
        columns = thinned({"time": table["time"], "crest": 1e3 * table["crest_x"]}, 8192)
        result["crest"] = {"time": packed(columns["time"], "<f4"), **numbers(columns["crest"])}
        table = read_table(run.directory / "joint_history.csv")
    except Skip:
        return result
    if len(table["time"]) < 2:
        return {**result, "crest": None}
    joints = [name[17:] for name in table if re.fullmatch(r"opening_upstream_\d+", name)]
    columns = thinned({"time": table["time"]} | {f"{name}_{joint}": 1e3 * table[f"{name}_{joint}"] for joint in joints for name in COLUMNS},
                      min(8192, NUMBERS // (4 * len(joints) + 1)))
    result["time"] = packed(columns["time"], "<f4")
    result["joints"] = {joint: {name: numbers(columns[f"{name}_{joint}"]) for name in COLUMNS} for joint in joints}
    result["names"] = [[joint, run.joint_name(int(joint))] for joint in joints]  # lists are not packed
    return result


def draw_still(frames, shown):
    """The displaced dam at the time of the largest opening, as an image."""
    stress, top = None if shown.stress is None else shown.stress[shown.widest], shown.top
    x = frames.points + shown.factor * shown.moved[shown.widest]
    corners, points = x[frames.quads].astype(float), frames.points.astype(float)
    values = np.zeros(corners.shape[:2]) if stress is None else stress[frames.quads]
    view = picture.view_of(points)
    n = picture.normals(corners)
    eye = view.centre + view.distance * view.back
    seen = np.einsum("ij,ij->i", n, eye - corners.mean(axis=1)) > 0
    sides = {}
    for k, quad in enumerate(frames.quads.tolist()):
        for a, b in zip(quad, quad[1:] + quad[:1]):
            sides.setdefault((min(a, b), max(a, b)), []).append(k)
    edges, _ = edges_of(frames)
    place, depth = view(corners)
    light = .5 * view.back + .75 * view.up - .5 * view.right
    brightness = .76 + .28 * np.clip(n @ (light / np.linalg.norm(light)), 0, 1)
    tones = plt.get_cmap("RdBu_r")(.5 + .5 * np.clip(values.mean(axis=1) / top, -1, 1))[:, :3]
    if stress is None:
        tones = np.tile(picture.CONCRETE[0], (len(n), 1))
    items = [(d, p, c, .4) for d, p, c, v in zip(depth.mean(axis=1), place, np.clip(tones * brightness[:, None], 0, 1), seen) if v]
    for a, b in edges.tolist():
        if any(seen[k] for k in sides[min(a, b), max(a, b)]):
            path, far = view(np.array([x[a], x[b]], dtype=float))
            items.append((far.mean() + .01 * np.ptp(points[:, 1]), path, (.13, .14, .17), .7))
    items.sort(key=lambda item: item[0])
    _, shapes, colours, widths = zip(*items)
    figure, axes = plt.subplots(figsize=(7.2, 4.4))
    axes.add_collection(picture.PolyCollection(shapes, facecolors=colours, edgecolors=colours, linewidths=widths, joinstyle="round", capstyle="round"))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")
    if stress is not None:
        bar = figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(-top, top), "RdBu_r"), ax=axes, orientation="horizontal", shrink=.4, aspect=36, pad=.02)
        bar.set_label("maximum principal stress [MPa]", fontsize=8.5)
        bar.ax.tick_params(labelsize=8)
        bar.outline.set_visible(False)
    return image(figure, "png")
