# SPDX-License-Identifier: GPL-3.0-or-later
"""The view of the moving dam in a report: a picture on paper and without scripts, otherwise a model that the reader turns.

The scripts are three.js and dygraphs of Debian's packages libjs-three and libjs-dygraphs, and report_view3d.js. The page contains them
and their data. Without the packages the page has the picture only."""

import json
import os
from base64 import b64encode
from html import escape
from pathlib import Path

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
BYTES = 3_600_000     # of the frames of all runs, before base64: below 8 MB for a page with its figures
NUMBERS = 500_000     # in the histories of a run
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
    page.section("The moving dam")
    scripts, style = libraries()
    own = Path(__file__).resolve()
    page.styles.append(own.with_suffix(".css").read_text(encoding="utf-8") + style)
    if scripts:
        page.scripts += [LICENCE + script for script in scripts[:1]] + scripts[1:]
    for run, frames in views:
        part = bytes_per_frame(frames)
        chosen = frames.strongest(min(len(frames.times), max(2, int(BYTES / len(views) / part))))
        if (found := page.made("the moving dam", lambda run=run, frames=frames, chosen=chosen: figure_of(run, frames, chosen, scripts))) is None:
            continue
        picture_, data, words = found
        title = f'<p class="name">{escape(run.name)}</p>' if len(runs) > 1 else ""
        live = f'<div class="view3d-live"></div><script type="application/json">{data}</script>' if scripts else ""
        caption = page.caption(f'<span class="view3d-still">{escape(words)}</span>' + (f'<span class="view3d-live">{LIVE_WORDS}</span>' if scripts else ""))
        page.add(f'<figure class="view3d">{title}{live}<img class="view3d-still" src="{picture_}" alt="{escape(words)}">{caption}</figure>')
    if scripts:
        page.scripts.append(own.with_suffix(".js").read_text(encoding="utf-8"))
    else:
        page.add('<p class="sub view3d-note">With the Debian packages libjs-three and libjs-dygraphs, <code>voussoir report</code> writes a view '
                 'that the reader turns.</p>')


def libraries():
    """Texts of the scripts, and their style. Without the libraries: no scripts."""
    directory = Path(os.environ.get("VOUSSOIR_JAVASCRIPT") or LIBRARIES)
    try:
        texts = [(directory / name).read_text(encoding="utf-8") for name in (*SCRIPTS, STYLE)]
    except OSError:
        return [], ""
    texts = ["\n".join(line for line in text.splitlines() if "# sourceMappingURL=" not in line) for text in texts]
    return [text.replace("</script", "<\\/script").replace("<!--", "\\x3c!--") for text in texts[:-1]], texts[-1].replace("</style", "")


def bytes_per_frame(frames):
    """Displacements of 16 bits, stress of 8 bits; opening of 8 bits at the joints."""
    return len(frames.points) * (7 if frames.has_stress else 6) + len(joint_nodes(frames)[0])


def joint_nodes(frames):
    """Nodes on joints, and the joint of each."""
    joints = {}
    for surface, quad in zip(frames.surface.tolist(), frames.quads.tolist()):
        if joint := joint_of(surface):
            joints.update(dict.fromkeys(quad, joint))
    nodes = sorted(joints)
    return np.array(nodes, dtype=np.uint32), np.array([joints[node] for node in nodes], dtype=np.uint16)


def figure_of(run, frames, chosen, scripts):
    """Picture, data of the scripts as JSON, and caption."""
    moved = frames.values("displacement", chosen)
    opening = 1e3 * frames.values("opening", chosen)
    factor = magnification(frames.points, moved)
    widest = int(np.argmax(opening.max(axis=1) if opening.max() > 0. else (moved**2).sum(axis=(1, 2))))
    stress = 1e-6 * frames.values("stress", chosen) if frames.has_stress else None
    envelope = envelope_of(run, frames) if frames.has_stress else None
    top = 1. if stress is None else max(.1, float(np.quantile(np.abs(stress if envelope is None else envelope), .995)))
    top = float(f"{top:.1g}") if top < 1. else float(np.ceil(top))
    colours = "; colours: maximum principal stress, tension positive" if stress is not None else ""
    words = (f"The dam at t = {frames.times[chosen[widest]]:.2f} s" + (f", largest opening {opening[widest].max():.1f} mm" if opening.max() > 0. else "")
             + f"; displacements from the grouted state × {factor:g}{colours}.")
    still = draw_still(frames, moved[widest], factor, None if stress is None else stress[widest], top)
    if not scripts:
        return still, "", words
    nodes, joints = joint_nodes(frames)
    edges, of_edges = edges_of(frames)
    unit = float(np.abs(moved).max()) / 32767. or 1.
    to_byte = lambda values, low, high: np.clip(np.rint(255. * (values - low) / (high - low)), 0, 255).astype(np.uint8)
    data = {"points": packed(frames.points, "<f4"), "quads": packed(frames.quads, "<u4"), "edges": packed(edges, "<u4"),
            "edgeJoints": packed(of_edges, "<u2"), "times": [round(float(t), 6) for t in frames.times[chosen]], "unit": unit,
            "moved": packed(np.rint(moved / unit), "<i2"), "factor": factor, "start": widest,
            "stress": None if stress is None else packed(to_byte(stress, -top, top), "u1"), "stressTop": top,
            "envelope": None if envelope is None else packed(to_byte(envelope, -top, top), "u1"),
            "jointNodes": packed(nodes, "<u4"), "nodeJoints": packed(joints, "<u2"),
            "opening": packed(to_byte(opening[:, nodes], 0., max(float(opening.max()), 1e-9)), "u1"), "openingTop": float(opening.max()),
            "history": history_of(run)}
    return still, json.dumps(data, allow_nan=False).replace("<", "\\u003c"), words


def packed(values, kind):
    return b64encode(np.ascontiguousarray(values).astype(kind).tobytes()).decode()


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
    result = {"joints": {}, "crest": None}

    def numbers(values):
        unit = float(np.abs(values).max()) / 32767. or 1.
        return {"unit": unit, "numbers": packed(np.rint(values / unit), "<i2")}

    for name, table in (("crest", run.directory / "history.csv"), ("joints", run.directory / "joint_history.csv")):
        try:
            columns = read_table(table)
        except Skip:
            continue
        wanted = {"time": columns["time"]}
        if name == "crest":
            wanted["crest"] = 1e3 * columns["crest_x"]
        else:
            wanted.update({key: 1e3 * values for key, values in columns.items() if key.rsplit("_", 1)[0] in
                           [f"{quantity}_{face}" for quantity in ("opening", "slip") for face in ("upstream", "downstream")]})
        columns = thinned(wanted, max(200, min(8192, NUMBERS // len(wanted))))
        time = packed(columns.pop("time"), "<f4")
        if name == "crest":
            result["crest"] = {"time": time, **numbers(columns["crest"])}
            continue
        result["time"] = time
        for key, values in columns.items():
            what, number = key.rsplit("_", 1)
            result["joints"].setdefault(number, {})[what] = numbers(values)
    return result


def draw_still(frames, moved, factor, stress, top):
    """The displaced dam as an image."""
    x = frames.points + factor * moved
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
