#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of `voussoir report`: the page by itself and in a real browser, and the numbers that reports are written with.

    program_report.py VOUSSOIR CASE...

The browser is a headless Chromium; where there is none its case is skipped (status 77), and says so.
"""

import csv
import sys
from html.parser import HTMLParser
from pathlib import Path

from browser import Browser, find_browser
from program_physics import Solution, close
from run_program import expect, refused, run_cases, runs, summary, write_scene

LIMITS = """
subsection Limits
  set Tensile strength      = 0.4 MPa
  set Demand-capacity ratio = 2
  set Overstress duration   = 0.4
  set Overstressed share    = 0.2
  set Tension               = 1 MPa
  set Compression           = 900 MPa
  set Opening               = 1e-6
  set Slip                  = 10
  set Waterstop depth       = 1.5
  set Waterstop opening     = 5 mm
end
"""


def two_runs():
    """With limits and without, flat joints and tied."""
    write_scene("limited.prm", LIMITS)
    write_scene("plain.prm")
    runs("limited.prm", "--output", "limited", "--overwrite")
    runs("plain.prm", "--output", "plain", "--overwrite", "--set", "Joints/Friction=0.2")
    runs("plain.prm", "--output", "tied", "--overwrite", "--set", "Joints/Model=tied")


class Reader(HTMLParser):
    """Images, addresses, and the text of a page; every tag must be closed."""

    def __init__(self, path):
        super().__init__()
        self.images, self.addresses, self.open, self.text = [], [], [], ""
        self.feed(Path(path).read_text(encoding="utf-8"))
        expect(not self.open, f"{path}: not closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.addresses += [attributes[name] for name in ("src", "href", "srcset") if name in attributes]
        if tag == "img":
            expect(attributes.get("alt"), "an image without an alternative text")
            self.images.append(attributes["src"])
        if tag not in ("img", "meta", "link", "source", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        expect(self.open and self.open.pop() == tag, f"</{tag}> closes something else")

    def handle_data(self, data):
        if "style" not in self.open:
            self.text += data


def page():
    """One page for a run: all in it, its numbers those of the summary, and what is said of the limits."""
    two_runs()
    runs("report", "limited")
    read = Reader("limited/report.html")
    expect(len(read.images) >= 12, f"{len(read.images)} images")
    expect(all(address.startswith("data:") for address in read.addresses), "the page asks for something outside of it")
    expect("Not shown" not in read.text, read.text[-1500:])
    found = summary("limited")
    for words in (f"{1e3 * found['extremes']['max_slip']['value']:.2f}"[:4], "Limits/Tensile strength", "exceeded", found["revision"],
                  "set Opening = 1e-06" if "set Opening = 1e-06" in read.text else "set Opening = 1e-6"):
        expect(words in read.text, f"'{words}' is not on the page")
    n_exceeded = sum(not limit["kept"] for limit in found["limits"].values())
    expect(f"{n_exceeded} of {len(found['limits'])} limits" in read.text, "the verdict does not count as the summary does")
    runs("report", "limited", "plain", "tied", "--output", "three.html")
    three = Reader("three.html")
    expect(len(three.images) > 1.5 * len(read.images), f"{len(three.images)} images of three runs")
    for words in ("the runs differ", "Joints/Friction", "tied"):
        expect(words in three.text, f"'{words}' is not on the page of three runs")
    runs("report", "tied", "--output", "tied.html")
    expect("Slip of a joint" not in Reader("tied.html").text, "the tied dam has slips")


def browser():
    """Chromium shows the page: no error, every figure, no sideways scrolling on a telephone, a PDF."""
    if find_browser() is None:
        print("SKIPPED: no Chromium, so the page is not looked at (on Debian: apt-get install chromium)")
        sys.exit(77)
    two_runs()
    runs("report", "limited", "plain", "--output", "both.html")
    runs("report", "limited", "--pdf")
    expect(Path("limited/report.pdf").read_bytes()[:5] == b"%PDF-", "no PDF")
    with Browser() as chromium:
        for path in ("both.html", "limited/report.html"):
            for width in (390, 794, 1280):  # a telephone, A4, a desk
                chromium.open(Path(path), width)
                sizes = chromium.value("[...document.images].map(i => [i.complete, i.naturalWidth, i.naturalHeight, i.width])")
                expect(len(sizes) >= 12 and all(all(size) for size in sizes), f"{path} at {width}: images {sizes}")
                expect(max(size[3] for size in sizes) <= width, f"{path} at {width}: an image is wider than the page")
                scroll = chromium.value("document.documentElement.scrollWidth")
                expect(scroll <= width, f"{path} scrolls sideways at {width}: {scroll}")
                expect(not chromium.complaints(), f"{path} at {width}: {chromium.complaints()}")
                small = chromium.value("Math.min(...[...document.querySelectorAll('p,td,th,figcaption,li,pre,code')]"
                                       ".map(e => parseFloat(getComputedStyle(e).fontSize)))")
                expect(small >= 11, f"{path} at {width}: letters of {small} px")
                print(f"    {path} at {width} px: {len(sizes)} images, smallest letters {small:.1f} px")


def refusals():
    """What is no run, and what is no page."""
    Path("empty").mkdir(exist_ok=True)
    refused(["report", "empty"], "empty", "summary.json")
    refused(["report", "nowhere"], "nowhere")
    refused(["report"], "voussoir report output/")
    Path("broken").mkdir(exist_ok=True)
    Path("broken/summary.json").write_text("{")
    refused(["report", "broken"], "not valid JSON")
    for text in ("[]", '{"limits": 3}', '{"extremes": {"max_slip": {"value": "much"}}, "warnings": 7}'):
        Path("broken/summary.json").write_text(text)
        refused(["report", "broken"], "Repeat the run")
    write_scene()
    runs("scene.prm", "--output", "run", "--overwrite", "--set", "Output/Envelope interval=0")
    refused(["report", "run", "--output", "page.txt"], "page.txt", ".html")
    refused(["report", "run", "--output", "no/such/place.html"], "no/such/place.html")
    runs("report", "run")  # without stresses
    expect("Not shown" in Reader("run/report.html").text, "what is missing is not said")


def numbers():
    """Overstress, shares, waterstops and what remains, against the fields of every step."""
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=1", "Joints/Friction=0.3"))
    found, faces = summary("run"), table("run/faces.csv")
    times = [float(row["time"]) for row in table("run/history.csv")]
    solutions = [Solution(f"run/solution-{k:05d}.vtu") for k in range(len(times))]
    strength, overstress = 0.4e6, found["overstress"]
    for face in ("upstream", "downstream"):
        nodes = [row for row in faces if row["face"] == face]
        index = {id(row): i for i, row in enumerate(faces)}
        most = [float(row["max_principal"]) / strength for row in faces]
        close(overstress[face]["demand_capacity"], max(most[index[id(row)]] for row in nodes), 1e-5, f"{face}: demand over capacity")
        quads = [[int(row[f"n{k}"]) for k in range(4)] for row in table("run/faces_cells.csv") if row["face"] == face]
        for k, level in enumerate(overstress["levels"]):
            whole = above = 0.
            for quad in quads:
                part = area([[float(faces[n][c]) for c in "xyz"] for n in quad]) / 4.
                whole += 4 * part
                above += part * sum(most[n] > level for n in quad)
            close(overstress[face]["share"][k], above / whole, 1e-4, f"{face}: share above {level}")
        for k in (0, 3, 10):
            longest = 0.
            for row in nodes:
                at = solutions[0].near([float(row[c]) for c in "xyz"])
                own = [i for i in at if close_enough(max(s.data["max_principal"][i] for s in solutions), float(row["max_principal"]))]
                limit = overstress["levels"][k] * strength
                longest = max([longest] + [.01 * sum(s.data["max_principal"][i] > limit for s in solutions[1:]) for i in own])
            expect(abs(overstress[face]["duration"][k] - longest) < 1e-5,
                   f"{face}, level {overstress['levels'][k]}: {overstress[face]['duration'][k]} s, by the fields {longest} s")
    expect(overstress["upstream"]["duration"][0] > 0, "nothing is overstressed: this scene tells nothing")
    last = solutions[-1].data
    for quantity in ("opening", "slip"):
        close(found["residual"][f"max_{quantity}"]["value"], max(x for x, state in zip(last[quantity], last["joint_state"]) if state >= 0), 1e-5, f"{quantity} that remains")
        points = table("run/joint_points.csv")
        close(found["extremes"][f"max_{quantity}"]["value"], max(float(row[f"max_{quantity}"]) for row in points), 1e-5,
              f"joint_points.csv, {quantity}")
        expect(found["waterstop"][f"max_{quantity}"]["value"] <= found["extremes"][f"max_{quantity}"]["value"], "more at the waterstop")
    waterstop(found, points, solutions)
    for name, limit in found["limits"].items():
        expect(limit["kept"] == (limit["value"] <= limit["limit"]), f"{name}: {limit}")
    expect(not found["limits"]["opening"]["kept"] and found["limits"]["slip"]["kept"] and found["limits"]["compression"]["kept"], "limits")
    close(found["limits"]["tension_upstream"]["value"], found["extremes"]["max_tension_upstream"]["value"], 1e-9, "tension")
    expect("Limits    exceeded: " in Path("run/log.txt").read_text(), "the log does not say which limits are exceeded")
    write_scene()
    runs("scene.prm", "--output", "free", *settings("Joints/Friction=0.3"))
    expect("limits" not in summary("free") and "overstress" not in summary("free"), "limits that nobody gave")
    expect(summary("free")["extremes"] == found["extremes"], "limits change the results")


def waterstop(found, points, solutions):
    """Its largest opening: between the pairs of an edge of the joint's quadrilaterals that crosses its depth."""
    depth, places = [float(row["depth"]) for row in points], [[float(row[c]) for c in "xyz"] for row in points]
    expect(min(depth) == 0. and max(depth) > 5., "depths from the upstream face")
    at = [next(i for i in solutions[0].near(place) if solutions[0].data["joint_state"][i] >= 0) for place in places]
    largest = 0.
    for row in table("run/joint_cells.csv"):
        quad = [int(row[f"n{k}"]) for k in range(4)]
        for a, b in zip(quad, quad[1:] + quad[:1]):
            a, b = sorted((a, b), key=lambda n: depth[n])
            if depth[a] <= 1.5 < depth[b]:
                w = (1.5 - depth[a]) / (depth[b] - depth[a])
                largest = max(largest, max((1 - w) * s.data["opening"][at[a]] + w * s.data["opening"][at[b]] for s in solutions))
    expect(largest > 0., "no waterstop")
    close(found["waterstop"]["max_opening"]["value"], largest, 1e-4, "opening at the waterstop")


def spectrum():
    """spectrum.csv: of a harmonic motion the resonant peak; of an artificial one the design spectrum beside it."""
    write_scene()
    runs("scene.prm", "--output", "run")
    rows = table("run/spectrum.csv")
    expect("target_x" not in rows[0] and float(rows[0]["damping"]) == .05, f"columns {list(rows[0])}")
    largest = max(rows, key=lambda row: float(row["spectrum_x"]))
    expect(abs(float(largest["period"]) - 6.2832 / 17) < .08, f"a motion of 17 rad/s is strongest at {largest['period']} s")
    runs("scene.prm", "--output", "artificial", *settings("Motion/Source=artificial", "Motion/File=", "Motion/Duration=8", "Motion/Unit=m/s^2",
                                                          "Motion/Scale y=0", "Motion/Factor=0.1"))
    for row in table("artificial/spectrum.csv"):
        expect(float(row["spectrum_y"]) == 0. == float(row["target_y"]), "a component that is off")
        if .05 < float(row["period"]) < 2.9:
            expect(abs(float(row["spectrum_x"]) / float(row["target_x"]) - 1.) < .12, f"off the design spectrum: {row}")
        if .1 <= float(row["period"]) <= .2:
            close(float(row["target_x"]), 2.5 * .5575 * .1 * 9.80665, 1e-6, "plateau of the design spectrum")


def table(name):
    with open(name) as file:
        return list(csv.DictReader(file))


def settings(*entries):
    return [word for entry in entries for word in ("--set", entry)]


def close_enough(a, b):
    return abs(a - b) <= 1e-5 * abs(b) + 1e-3


def area(corners):
    a, b = ([q - p for p, q in zip(corners[i], corners[i + 2])] for i in (0, 1))
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return .5 * sum(x * x for x in cross) ** .5


if __name__ == "__main__":
    run_cases(page, browser, refusals, numbers, spectrum)
