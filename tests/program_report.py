#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of `voussoir report`: the page by itself and in a real browser, and the numbers that reports are written with.

    program_report.py VOUSSOIR CASE...

The browser is a headless Chromium; where there is none its case is skipped (status 77), and says so.
"""

import csv
import json
import math
import os
import shutil
import sys
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path
from unittest import mock

from browser import Browser, find_browser
from many_motions import fractile, many_motions, rows_of
from program_physics import Solution, close, read_vtu
from run_program import (arch_mesh, expect, from_file, refused, report, reports, run_cases, runs, settings, summary, voussoir, write_mesh,
                         write_scene)

LIMITS = """
subsection Limits
  set Tensile strength      = 0.6 MPa
  set Static tensile strength = 0.4 MPa
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
        self.images, self.addresses, self.open, self.text, self.tags, self.scripts = [], [], [], "", set(), []
        self.feed(Path(path).read_text(encoding="utf-8"))
        expect(not self.open, f"{path}: not closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags |= {tag, *attributes}
        self.addresses += [attributes[name] for name in ("src", "href", "srcset") if name in attributes]
        if tag == "script":
            self.scripts.append((attributes.get("type"), ""))
        if tag == "img":
            expect(attributes.get("alt"), "an image without an alternative text")
            self.images.append(attributes["src"])
        if tag not in ("img", "meta", "link", "source", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        expect(self.open and self.open.pop() == tag, f"</{tag}> closes something else")

    def handle_data(self, data):
        if "script" in self.open:
            self.scripts[-1] = (self.scripts[-1][0], self.scripts[-1][1] + data)
        elif "style" not in self.open:
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
    for words in (f"{1e3 * found['extremes']['max_slip']['value']:.1f}", "Limits/Tensile strength", "exceeded", found["revision"],
                  "set Opening = 1e-06" if "set Opening = 1e-06" in read.text else "set Opening = 1e-6"):
        expect(words in read.text, f"'{words}' is not on the page")
    n_exceeded = sum(not limit["satisfied"] for limit in found["limits"].values())
    expect(f"{n_exceeded} of {len(found['limits'])} limits" in read.text, "the verdict does not count as the summary does")
    reports("limited", "plain", "tied", "--output", "three.html")
    three = Reader("three.html")
    expect(len(three.images) > 1.5 * len(read.images), f"{len(three.images)} images of three runs")
    for words in ("the runs differ", "Joints/Friction", "tied"):
        expect(words in three.text, f"'{words}' is not on the page of three runs")
    reports("tied", "--output", "tied.html")
    expect("Slip of a joint" not in Reader("tied.html").text, "the tied dam has slips")


def beside_static():
    """A static state beside an earthquake: what moves keeps its figures over time, the static state has no duration of overstress."""
    write_scene("limited.prm", LIMITS)
    runs("limited.prm", "--output", "moving", "--overwrite")
    runs("limited.prm", "--output", "resting", "--overwrite", "--set", "Motion/Source=none")
    reports("moving", "resting", "--output", "pair.html")
    read = Reader("pair.html")
    for words in ("Displacement of the crest", "Opening and slip at the crest over time", "Energies;"):
        expect(words in read.text, f"'{words}' is not on the page of a static state and an earthquake")
    expect("single time" not in read.text and "resting: its response over time" in read.text, read.text[-1500:])
    text = Path("pair.html").read_text(encoding="utf-8")
    row = text[text.index("Duration of overstress"):].partition("</tr>")[0]
    expect(row.count("<td") == 3 and ">–<" in row, row)
    facts = text[text.index("Dam and scene"):text.index("What differs")]
    expect("<td>Tension</td>" not in facts and "largest opening" not in facts, "results stand among what the program understood")
    for strength in ("0.4 MPa", "0.3 MPa"):  # other levels may decide: no title may name that of one run for all
        runs("limited.prm", "--output", strength[:3], "--overwrite", "--set", f"Limits/Static tensile strength={strength}")
    levels = [2. - summary(d)["limits"]["overstress_duration"]["limit"] / .4 for d in ("0.4", "0.3")]
    reports("0.4", "0.3", "--output", "levels.html")
    expect(("at the level that decides in each run" in Reader("levels.html").text) == (abs(levels[0] - levels[1]) > 1e-9), f"{levels}")
    reports("resting", "--output", "rest.html")
    expect("None: the static state alone." in Reader("rest.html").text, "a static state alone")


def analysed():
    """The first page says what was analysed, with the numbers of the files; several runs are one table; places are words."""
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "run")
    runs("scene.prm", "--output", "tied", *settings("Joints/Model=tied"))
    reports("run")
    text = Path("run/report.html").read_text(encoding="utf-8")
    first = text[text.index("What was analysed"):text.index(">Results<")]
    mesh, history = summary("run")["mesh"], table("run/history.csv")
    peak = max(abs(float(row["base_acceleration_x"])) for row in history) / 9.80665
    water = float(next(line for line in Path("run/scene.prm").read_text().splitlines() if "set Water level" in line).split("=")[1].split("#")[0])
    for words in ("210 m high", f"crest {mesh['crest_length']:.0f} m long", f"{mesh['volume'] / 1e6:.3g} million m³", f"{mesh['cells']} elements",
                  "2 contraction joints, law FJA", "friction 0.6", f"level {water:g} m", "motion.txt", f"{peak:.3g} g along the river", "rigid: the base",
                  "The model leaves out cracking", "motions of one spectrum differ (openings by about ±25 %, tensions by about ±10 %)", "set Ensemble"):
        expect(words in first, f"'{words}' is not on the first page: {first}")
    expect("1-16" not in first and text.count("<img") > first.count("<img") == 2, "pictures of the first page")
    reports("run", "tied", "--output", "pair.html")
    text = Path("pair.html").read_text(encoding="utf-8")
    first = text[text.index("<h2>Answers"):text.index("<h2>Results")]
    expect(first.count("<table>") == 1 and first.count("<tr>") == 3 and 'class="answers"' not in first, f"{first}")
    expect(f"{1e3 * summary('run')['extremes']['max_opening']['value']:.3g}"[:4] in first and first.count("leaves out") == 2, f"{first}")
    from voussoir.report_places import Places
    from voussoir.runs import Run
    places = Places(Run("run"))
    for row in table("run/joint_points.csv"):
        place = place_of(row)
        level = "crest" if place[2] > 209.9 else "lowest point" if place[2] < .1 else f"elevation {place[2]:.0f} m"
        expect(places.words("max_opening", place, 0.).startswith(f"joint {row['joint']}, {level}"), f"{row}: {places.words('max_opening', place, 0.)}")
        expect(float(row["depth"]) > 0. or places.words("max_slip", place, 0.).endswith("upstream"), f"{row}: {places.words('max_slip', place, 0.)}")
    for row in table("run/faces.csv"):  # at joints two nodes have one place: the value decides
        words = places.words("max_tension_upstream", place_of(row), float(row["max_principal"]))
        expect(words.startswith(f"monolith {row['monolith']}, ") and words.endswith(row["face"]), f"{row}: {words}")
    from voussoir.drawing import away_from_base
    for face, away in away_from_base(Run("run")).items():
        largest = max(float(row["max_principal"]) for row, counts in zip([row for row in table("run/faces.csv") if row["face"] == face], away) if counts)
        close(largest, summary("run")["extremes"][f"max_tension_{face}_away_from_base"]["value"], 1e-6, f"largest tension in the figure, {face}")
    expect(places.words("max_opening", [900., 0., -5.], 0.) == "at (900, 0, −5) m", places.words("max_opening", [900., 0., -5.], 0.))


def motions():
    """Many motions: the answers are median and band of ensemble.csv; limits and cracks are counted; analyses without result are named."""
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "run", *settings("Joints/Friction=0.3", "Limits/Opening=22 mm", "Limits/Tensile strength=8 MPa"))
    many_motions("run", "many")
    of = lambda name, directory="many": [float(row[name]) for row in rows_of(f"{directory}/ensemble.csv") if row["status"] == "ok" and float(row["factor"]) == 1.]
    from voussoir.report_ensemble import asked
    from voussoir.report_tables import number
    from voussoir.runs import Run
    said = {question: text for question, text in asked(Run("many"))}
    openings = of("max_opening")
    low, median, high = (number(fractile(openings, share), "mm") for share in (.16, .5, .84))
    expect(f"<b>{median} mm</b> in the median, {low} to {high} mm from 16 to 84 %" in said["How far do the joints open?"], f"{said}")
    expect("16 motions: the median is known within 7.5 % (68 %), 15 % (95 %)." in said["How far do the joints open?"], f"{said}")
    tensions = [max(pair) for pair in zip(of("max_tension_upstream_away_from_base"), of("max_tension_downstream_away_from_base"))]
    over = sum(value > 8e6 for value in tensions)
    crack = f"<b class=\"exceeded\">The concrete would crack</b> in {over} of 16 motions" if over else "In no motion is the tension above"
    expect(crack in said["How large are the stresses?"], f"{over}: {said}")
    expect(f"Opening (22 mm) in {sum(x > .022 for x in openings)} of 16 motions" in said["Which limits are exceeded?"] and min(openings) < .022 < max(openings),
           f"{said}, {openings}")
    counted = summary("many")
    counted["ensemble"]["motions_above_limit"] = {"opening": 3, "overstress_duration": 0}
    Path("many/summary.json").write_text(json.dumps(counted))
    said = dict(asked(Run("many")))["Which limits are exceeded?"]
    expect(said == "Exceeded: opening (22 mm) in 3 of 16 motions. Satisfied in all motions: duration of overstress.", said)
    reports("many")
    page = Reader("many/report.html")
    for words in ("16 artificial motions" if "16 artificial" in page.text else "16 motions", "seed 16", "the median over the motions", f"In 8 of 16 motions a joint stays open at the crest from its largest opening to the end of the run, "
                  f"at least by {number(max(of('kept_opening')), 'mm')} mm"):
        expect(words in page.text, f"'{words}' is not on the page of many motions")
    expect("Not shown" not in page.text and "motions of one spectrum differ" not in page.text and len(page.images) >= 10, page.text[-1500:])
    many_motions("run", "alone", n=1)
    expect(dict(asked(Run("alone")))["Do they close again?"].startswith("<b>Yes.</b>"), "the joints of one motion close")
    said = dict(asked(Run("alone")))["How far do the joints open?"]
    expect(said.startswith(f"By <b>{number(of('max_opening', 'alone')[0], 'mm')} mm</b>; joint") and "One motion" in said and " to " not in said, said)
    reports("alone")
    expect("Not shown" not in Reader("alone/report.html").text, "one motion of an ensemble")
    many_motions("run", "factors", n=12, factors=(.5, 1., 2.), failed=(3, 7))
    from voussoir.report_scene import analysed as rows_of_scene
    expect("12 artificial motions" in (said := dict(rows_of_scene(Run("factors")))["Ground motion"]) and "the first, factor 0.5: peak" in said and
           "factors 0.5, 1, 2" in said, said)
    reports("factors", "run", "--output", "two.html")
    text = Reader("two.html").text
    expect("Incremental dynamic analysis" in text and text.count("unstable at 3.2 s") == 2 and f"({low_to_high(of('max_opening', 'factors'))})" in text, text[:3000])
    expect(dict(asked(Run("factors")))["How far do the joints open?"].startswith("With the factor 1, by <b>"), "the factor of the answers")
    said = dict(asked(Run("factors")))["Are the results valid?"]
    expect("2 of 36 analyses have no result:</b> seed 3, factor 2 (unstable at 3.2 s); seed 7, factor 2" in said, said)
    drawn_motions()
    whole = Path("many/ensemble.csv").read_text()
    for damaged in ("", "motion,name\n1,a\n", whole.replace("seed 2,1.0,ok,", "seed 2,1.0,ok,x", 1)):
        Path("many/ensemble.csv").write_text(damaged)
        refused(["many"], "many/ensemble.csv", "Repeat the run", run=report)


def low_to_high(values):
    from voussoir.report_tables import number
    return f"{number(fractile(values, .16), 'mm')} to {number(fractile(values, .84), 'mm')}"


def drawn_motions():
    """Lines of the figures against ensemble.csv: each motion, median, and a fractile that ends where motions have no result."""
    from voussoir import figures
    from voussoir.ensemble_drawing import draw_distribution, draw_dynamic_analysis, draw_joint_band
    from voussoir.drawing import plt
    from voussoir.runs import Run
    rows, factors = rows_of("factors/ensemble.csv"), (.5, 1., 2.)
    run, (_, axes) = Run("factors"), plt.subplots(1, 3)
    draw_joint_band(axes[0], run, "opening")
    lines = [list(line.get_ydata()) for line in axes[0].lines]
    for row in rows:
        if float(row["factor"]) == 1.:
            expect(any(len(y) == 2 and all(abs(a - 1e3 * float(row[f"opening_{j}"])) < 1e-9 for j, a in enumerate(y, 1)) for y in lines), f"{row['name']} is not drawn")
    draw_distribution(axes[1], run)
    close(max(axes[1].lines[1].get_xdata()), 1e3 * max(float(row["max_opening"]) for row in rows if row["factor"] == "1.0"), 1e-9, "largest opening")
    draw_dynamic_analysis(axes[2], run)
    median, low, high = (line for line in axes[2].lines if len(line.get_ydata()) == 4 and line.get_color() != "0.62")
    for factor, x in zip(factors[:2], list(median.get_xdata())[1:]):
        close(x, 1e3 * fractile([float(row["max_opening"]) for row in rows if float(row["factor"]) == factor], .5), 1e-9, f"median at factor {factor}")
    expect(math.isnan(list(high.get_xdata())[-1]) and not math.isnan(list(low.get_xdata())[-1]), "84 % with 2 of 12 without result")
    plt.close("all")
    with mock.patch.object(sys, "argv", ["figures", "factors", "many"]), mock.patch.object(figures, "envelopes", lambda *_: None):
        expect(figures.main() == 0, "figures")
    for name in ("openings", "slips", "distribution", "spectrum"):
        expect(Path("many/figures", f"{name}.png").exists() and Path("many/figures", f"{name}.pdf").read_bytes()[:4] == b"%PDF", name)
    expect(Path("factors/figures/ida.pdf").exists() and not Path("many/figures/ida.pdf").exists(), "incremental dynamic analysis")


def browser():
    """Chromium shows the page: no error, every figure, no sideways scrolling on a telephone, a PDF."""
    if find_browser() is None:
        print("SKIPPED: no Chromium, so the page is not looked at (on Debian: apt-get install chromium)")
        sys.exit(77)
    two_runs()
    runs("limited.prm", "--output", "limited", "--overwrite", "--set", "Output/Solution interval=10")
    runs("modes", "limited.prm", "--output", "limited/modes")
    runs("report", "limited", "plain", "tied", "--output", "both.html")
    runs("report", "limited", "--pdf")
    expect(Path("limited/report.pdf").read_bytes()[:5] == b"%PDF-", "no PDF")
    with Browser() as chromium:
        for path in ("both.html", "limited/report.html"):
            for width in (360, 390, 680, 794, 1280):  # telephones, A4 within its margins, A4, a desk
                chromium.call("Emulation.setEmulatedMedia", media="print" if width == 680 else "")
                chromium.open(Path(path), width)
                sizes = chromium.value("[...document.images].filter(i => i.getClientRects().length).map(i => [i.complete, i.naturalWidth, i.naturalHeight, i.width])")
                expect(len(sizes) >= 12 and all(all(size) for size in sizes), f"{path} at {width}: images {sizes}")
                expect(max(size[3] for size in sizes) <= width, f"{path} at {width}: an image is wider than the page")
                scroll = chromium.value("document.documentElement.scrollWidth")
                expect(scroll <= width, f"{path} scrolls sideways at {width}: {scroll}")
                beyond = chromium.value("[...document.querySelectorAll('body *')].filter(e => e.getBoundingClientRect().right > innerWidth + .5 || "
                                        "e.className === 'table' && e.scrollWidth > e.clientWidth).map(e => e.outerHTML.slice(0, 100))")
                expect(not beyond, f"{path} at {width}: beyond the screen: {beyond}")
                expect(not chromium.complaints(), f"{path} at {width}: {chromium.complaints()}")
                end = chromium.value("(document.querySelector('.answers') || document.querySelector('.first table')).getBoundingClientRect().bottom + scrollY")
                expect(width != 680 or end < 263 * 96 / 25.4, f"{path}: the answers end at {end} px, A4 within its margins has 994")
                small = chromium.value("Math.min(...[...document.querySelectorAll('p,td,th,figcaption,li,pre,code')]"
                                       ".map(e => parseFloat(getComputedStyle(e).fontSize)))")
                expect(small >= (28 / 3 if width == 680 else 11),  # 7 pt on paper
                       f"{path} at {width}: letters of {small} px")
                print(f"    {path} at {width} px: {len(sizes)} images, smallest letters {small:.1f} px")


def linear(colour):
    """Linear RGB of a colour "#rrggbb" of sRGB."""
    return [c / 12.92 if (c := int(colour[k:k + 2], 16) / 255.) <= .04045 else ((c + .055) / 1.055) ** 2.4 for k in (1, 3, 5)]


def lab(rgb):
    """CIE L*a*b* of linear RGB of sRGB, white D65."""
    rows = ((.4124564, .3575761, .1804375), (.2126729, .7151522, .0721750), (.0193339, .1191920, .9503041))
    f = [x ** (1 / 3) if (x := sum(m * min(max(c, 0.), 1.) for m, c in zip(row, rgb)) / white) > 216 / 24389 else (24389 / 27 * x + 16.) / 116.
         for row, white in zip(rows, (.95047, 1., 1.08883))]
    return 116. * f[1] - 16., 500. * (f[0] - f[1]), 200. * (f[1] - f[2])


def colours():
    """Any two colours of the figures, and those of satisfied and exceeded limits, differ clearly for all readers: by 15 in CIE L*a*b*, of which
    about 2 are visible. Protanopia and deuteranopia by the matrices of Machado, Oliveira, Fernandes (2009), IEEE TVCG 15(6), severity 1."""
    vision = {"normal": ((1., 0., 0.), (0., 1., 0.), (0., 0., 1.)),
              "protanopia": ((.152286, 1.052583, -.204868), (.114503, .786281, .099216), (-.003882, -.048116, 1.051998)),
              "deuteranopia": ((.367322, .860646, -.227968), (.280085, .672501, .047413), (-.011820, .042940, .968881))}
    from voussoir.drawing import DOWNSTREAM, UPSTREAM
    from voussoir.palette import COLOURS, line
    style = (Path(__file__).resolve().parent.parent / "python" / "voussoir" / "report.css").read_text()
    states = [style.partition(f"--{name}: ")[2][:7] for name in ("bad", "good")]
    contrasts(*style.partition("prefers-color-scheme: dark")[::2])

    def least(listed, matrix):
        seen = [lab([sum(m * c for m, c in zip(row, linear(colour))) for row in matrix]) for colour in listed]
        return min(math.dist(a, b) for i, a in enumerate(seen) for b in seen[:i])
    close(math.dist(lab([1., 1., 1.]), lab([0., 0., 0.])), 100., 1e-3, "lightness of white")
    for name, matrix in vision.items():
        found = [least(COLOURS + ["#000000"], matrix), least(states, matrix), least([UPSTREAM, DOWNSTREAM], matrix)]
        print(f"    {name}: colours {found[0]:.1f}, states {found[1]:.1f}, faces {found[2]:.1f}")
        expect(found[0] > 15. and min(found[1:]) > 60., f"{name}: {found}")
    former = ["#0b5394", "#cc4125", "#38761d", "#b45f06", "#674ea7", "#45818e", "#7f6000"]
    expect(least(former, vision["protanopia"]) < 5., "the measure does not see colours that look alike")
    expect(len({str(line(k)) for k in range(4 * len(COLOURS))}) == 4 * len(COLOURS), "two lines with the same style")


def contrasts(light, dark):
    """Text and page of both colour schemes, by WCAG 2.2, 1.4.3: a contrast of at least 4.5."""
    for theme, text in (("light", light), ("dark", dark)):
        found = {}
        for name in ("ink", "soft", "accent", "bad", "good", "page", "code", "shade"):
            colour = text.partition(f"--{name}: ")[2].partition(";")[0]
            colour = colour if len(colour) == 7 else "#" + "".join(2 * c for c in colour[1:])
            found[name] = .05 + sum(weight * c for weight, c in zip((.2126, .7152, .0722), linear(colour)))
        ratios = {(a, b): max(found[a], found[b]) / min(found[a], found[b]) for a in ("ink", "soft", "accent", "bad", "good") for b in ("page", "code", "shade")}
        print(f"    {theme}: least contrast {min(ratios.values()):.2f}")
        expect(min(ratios.values()) > 4.5, f"{theme}: {ratios}")


def units():
    """Units of entries by scene.prm are those of the program's help, and the page writes entries and lines of the log with them."""
    from voussoir.units import readable, typeset, units_of, with_prefix
    for value, unit, text in ((27e9, "Pa", "27 GPa"), (2.5e6, "Pa", "2.5 MPa"), (1e6, "Pa", "1 MPa"), (999e3, "Pa", "999 kPa"), (-3e6, "N", "−3 MN"),
                              (7500., "N", "7.5 kN"), (.02, "m", "20 mm"), (210., "m", "210 m"), (2400., "kg/m^3", "2400 kg/m³"), (.8, "-", "0.8"),
                              (-10., "degC", "−10 °C"), (1e-11, "m/Pa", "1 × 10⁻¹¹ m/Pa"), (9.81, "m/s^2", "9.81 m/s²")):
        expect(with_prefix(value, unit) == text, f"{value} {unit}: {with_prefix(value, unit)}")
    for value, unit, text in (("27000000000", "Pa", "27 GPa"), ("-1", "s", "-1"), ("-1", "degC", "−1 °C"), ("FJA", None, "FJA"), ("1 2", "m", "1 2"), ("0", "Pa", "0")):
        expect(readable(value, unit) == text, f"{value}: {readable(value, unit)}")
    expect(typeset("volume 3.199e+06 m3, 1e-10 s^2, 2e3") == "volume 3.199 × 10⁶ m³, 1 × 10⁻¹⁰ s², 2 × 10³", typeset("volume 3.199e+06 m3, 1e-10 s^2, 2e3"))
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "run", *settings("Concrete/Young's modulus=27 GPa", "Motion/Duration=0.1"))
    found, known = units_of(Path("run/scene.prm").read_text()), {}

    def walk(tree, path):
        for name, child in tree.items():
            if "pattern_description" not in child:
                walk(child, [*path, name])
            elif child["documentation"].count("[") == 1 and " " not in (unit := child["documentation"].partition("[")[2].partition("]")[0]):
                known["/".join([*path, name])] = unit
    walk(json.loads(runs("parameters", "json")), [])
    expect(found == known and len(found) > 100, f"{set(found.items()) ^ set(known.items())}")
    reports("run")
    text = Path("run/report.html").read_text(encoding="utf-8")
    row = text[text.index("<td>Concrete/Young"):].partition("</tr>")[0]
    expect(">27 GPa<" in row and ">21 GPa<" in row, row)
    tables_only = text[:text.index("How to repeat it")]
    cells = [cell.partition("</td>")[0] for cell in tables_only.split("<td")[1:]]
    bare = [cell for cell in cells if any(len(word.strip(".,;()")) > 7 and word.strip(".,;()").isdigit() for word in cell.replace(">", " ").split())]
    expect(len(cells) > 100 and not bare, f"numbers of more than seven digits: {bare}")
    head = text[text.index("Monoliths on their bases"):].partition("</thead>")[0]
    expect("compression at most [MN]" in head and "uplift [MN]" in head, head)


def answered(directory):
    """The answers of the first page of a run: {question: text}."""
    from voussoir.report_answers import answers as write
    from voussoir.runs import Run
    text = write(Run(directory))
    answers = text[text.index('<dl class="answers">'):].partition("</dl>")[0]
    return {part.partition("</dt>")[0]: part.partition("<dd>")[2].partition("</dd>")[0] for part in answers.split("<dt>")[1:]}


def answers():
    """The first page answers with the numbers of the run's files; title, owner, author and date are those of the command line."""
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "run", *settings("Joints/Friction=0.3"))
    found, history = summary("run"), table("run/joint_history.csv")
    said = answered("run")
    reports("run", "--title", "Dam <1>", "--owner", "A & B", "--author", "C", "--date", "1 May 2030")
    expect(all(text in Path("run/report.html").read_text(encoding="utf-8") for text in said.values()), f"{said} are not on the page")
    read = Reader("run/report.html")
    for words in ("Dam <1>", "A & B", "Author", "1 May 2030", "--title 'Dam <1>' --owner 'A & B'"):
        expect(words in read.text, f"'{words}' is not on the page")
    expect(f"{1e3 * found['extremes']['max_opening']['value']:.3g} mm" in said["How far do the joints open?"], f"{said}")
    expect(f"{1e-6 * found['extremes']['max_tension_upstream_away_from_base']['value']:.3g}"[:4] in said["How large are the stresses?"], f"{said}")
    names, stay, opened = [name for name in history[0] if name.startswith("opening_")], {}, set()
    for name in names:
        values = [float(row[name]) for row in history]
        after = min(values[values.index(max(values)):])
        opened |= {name.rsplit("_", 1)[1]} if max(values) > 1e-4 else set()
        if max(values) > 1e-4 and after > .01 * max(values):
            stay[name.rsplit("_", 1)[1]] = after
    print(f"    {stay} of {opened} stay open [m]: {said['Do they close again?']}")
    expect(opened and (f"Of {len(opened)} joints that open at the crest, {len(stay)} stay" if stay else "<b>Yes.</b>") in said["Do they close again?"], f"{stay}, {said}")
    for shift in (0., .005):  # one joint stays open by 5 mm after its largest opening, or is closed from the start to the end
        rows = [{name: (float(value) * (name == "time") + (.01 * (k == 3) + shift * (k > 3)) * (name == names[0])) for name, value in row.items()}
                for k, row in enumerate(history)]
        with open("run/joint_history.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, list(history[0]))
            writer.writeheader()
            writer.writerows(rows)
        text = answered("run")["Do they close again?"]
        expect("the joint that opens closes again" in text if shift == 0. else "Of 1 joints that open at the crest, 1 stays open" in text and "joint 1 (5.00 mm)" in text and f"{float(history[-1]['time']):.2f} s" in text, text)
    found["warnings"] = []
    log = Path("run/log.txt").read_text()
    Path("run/log.txt").write_text("\n".join(line for line in log.splitlines() if not line.startswith("warning: ")))
    cracking("run", found)
    said = answered("run")["Are the results valid?"]
    expect("passes its checks" in said and "not estimated" in said, said)
    for key, value, words in (("energy_balance_error", 2e-4, "energy balance 2.0 × 10⁻⁴"), ("contact_residual", 3e-9, "contact residual 3.0 × 10⁻⁹"),
                              ("warnings", ["look"], "warnings of the program: 1 (look)"),
                              ("warnings", [{"class": "physics", "text": "It cavitates. See there.", "place": ""}], "warnings of the program: 1 (It cavitates)")):
        Path("run/summary.json").write_text(json.dumps({**found, key: value}))
        said = answered("run")["Are the results valid?"]
        expect(f"Not all checks are satisfied:</b> {words}" in said, said)
    Path("run/summary.json").write_text(json.dumps({**found, "warnings": [{"class": "input", "text": "A/B has no effect.", "place": "a.prm, line 2"}]}))
    said = answered("run")["Are the results valid?"]
    expect("passes its checks" in said and "remarks on the input file: 1" in said and "none" not in said, said)
    reports("run")
    expect("A/B has no effect." in Reader("run/report.html").text, "a remark on the input is not in the list")
    Path("run/log.txt").write_text(log + "warning: Only the log has this.\n")
    expect("Only the log has this" in answered("run")["Are the results valid?"], "a warning that only the log has")
    reports("run")
    text = Reader("run/report.html").text
    expect("Only the log has this." in text and "None." not in text.partition("Warnings")[2][:200], "none beside a warning")


def cracking(directory, found):
    """Whether the concrete would crack: the tension against the strength of the scene, or a usual one."""
    tension = max(found["extremes"][f"max_tension_{face}_away_from_base"]["value"] for face in ("upstream", "downstream"))
    scene = Path(directory, "scene.prm").read_text()
    line = next(line for line in scene[scene.index("subsection Limits"):].splitlines() if "set Tensile strength" in line)
    for strength, usual in ((tension / 2., False), (tension * 1.01, False), (0., True)):
        Path(directory, "scene.prm").write_text(scene.replace(line, f"  set Tensile strength = {strength}"))
        for factor in (1., 10.) if usual else (1.,):
            changed = json.loads(json.dumps(found))
            for face in ("upstream", "downstream"):
                changed["extremes"][f"max_tension_{face}_away_from_base"]["value"] *= factor
            Path(directory, "summary.json").write_text(json.dumps(changed))
            said = answered(directory)
            over = tension * factor / (3e6 if usual else strength)
            print(f"    tension over strength {over:.3g}: {said['How large are the stresses?'][-150:]}")
            expect((over > 1.) == ("The concrete would crack" in said["How large are the stresses?"]) == ("beyond their validity" in said["Are the results valid?"]),
                   f"{over}: {said}")
            expect(over <= 1. or f"{over:.2g} times" in said["How large are the stresses?"], f"{over}: {said}")
    Path(directory, "scene.prm").write_text(scene)
    Path(directory, "summary.json").write_text(json.dumps(found))


def content():
    """What other commands and later files add: modes, error of mesh and time step, open dam, quality of the mesh, accelerations, arch stresses."""
    write_scene("scene.prm")
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=10", "Joints/Friction=0.3"))
    reports("run")
    bare = Reader("run/report.html")
    for words in ("voussoir modes scene.prm --output run/modes", "voussoir accuracy scene.prm --output run/accuracy"):
        expect(words in bare.text, f"'{words}' is not on the page")
    expect("at its widest opening" in bare.text and "Not shown" not in bare.text, bare.text[-1500:])
    mesh = runs("mesh", "scene.prm", "--output", "mesh.msh")
    edges = mesh.partition("edges ")[2].split()[0], mesh.partition("edges ")[2].split()[2]
    text = Path("run/report.html").read_text(encoding="utf-8")
    jacobian = text[text.index("smallest scaled Jacobian"):].partition('">')[2].partition("</td>")[0]
    print(f"    {mesh.splitlines()[-1]}; on the page {jacobian}")
    expect(f"{edges[0]} m, {edges[1]} m" in text and abs(float(jacobian) - float(mesh.partition("Jacobian ")[2].partition(",")[0])) < .0051, f"{mesh}")
    runs("modes", "scene.prm", "--output", "run/modes", "--count", "4")
    Path("scene-accuracy").mkdir()
    entries = of_scene("run")
    told = {"error": {"openings": .0123, "tension": .034}, "wish": .02, "error_bars": {}}
    Path("scene-accuracy/accuracy.json").write_text(json.dumps({**told, "entries": {**entries, "Joints/Friction": "0.6"}}))
    reports("run")
    expect("is of another scene (Joints/Friction = 0.6, here 0.3)" in Reader("run/report.html").text, "the error of another scene is on the page")
    Path("scene-accuracy/accuracy.json").write_text(json.dumps({**told, "entries": entries}))
    changes = dict.fromkeys(("opening", "slip", "tension_upstream", "tension_downstream", "base_shear", "sliding_safety", "crest"), .07)
    row = {"group": "water", "name": "empty reservoir", "changes": changes, "counts": dict.fromkeys(changes, True), "cost": .9, "verdict": "matters", "reason": ""}
    Path("scene-needs").mkdir()
    Path("scene-needs/needs.json").write_text(json.dumps({"rows": [row], "smallest": {"rows": []}, "target": ".05", "seconds": "5", "entries": {}}))
    added_columns("run")
    reports("run")
    full = Reader("run/report.html")
    frequency = [float(row["frequency"]) for row in table("run/modes/modes.csv")]
    expect("Natural modes" in full.text and all(f"{k + 1}: {f:.3g} Hz" in full.text for k, f in enumerate(frequency)), "the modes are not on the page")
    expect("1.2 % for the openings and 3.4 % for the tensile stress, above its target of 2.0 %" in full.text, full.text[:3000])
    expect("What the scene needs" in full.text and "empty reservoir" in full.text and "+7.0" in full.text, "the table of needs is not on the page")
    for words in ("Absolute accelerations", "Floor spectra", "Largest arch stress", "Largest cantilever stress"):
        expect(words in full.text and words in bare.text, f"'{words}'")
    expect(len(full.images) == len(bare.images) + 4, f"{len(full.images)} images, {len(bare.images)} without")
    expect("Further content" not in full.text and "Not shown" not in full.text, full.text[-1500:])
    for name, said in (("run/modes/modes.csv", "is not of voussoir modes"), ("scene-accuracy/accuracy.json", "is not of this version of voussoir accuracy"),
                       ("scene-needs/needs.json", "is not of voussoir needs")):
        Path(name).write_text("mode,frequency\n1,x\n")
        reports("run")
        expect(said in Reader("run/report.html").text, f"damaged {name}")


def of_scene(directory):
    """Entries of a run's scene, as accuracy.json has them."""
    from voussoir.error_bars import relevant
    from voussoir.prm import read_entries
    return relevant({entry: value for entry, (value, _) in read_entries(Path(directory, "scene.prm").read_text()).items()})


def added_columns(directory):
    """Finds the columns of accelerations and arch stresses in a run, and their lack in a run of an earlier version."""
    from voussoir.report_figures import directed, points_with_acceleration
    from voussoir.runs import Run
    run = Run(directory)
    expect(points_with_acceleration(run) == ["crest"] and directed([run]) == [run], "the columns are not found")
    for face in run.faces.values():  # as in runs of earlier versions
        del face["arch_stress_max"]
    expect(directed([run]) == [], "a run without the columns")


def refusals():
    """What is no run, and what is no page."""
    Path("empty").mkdir(exist_ok=True)
    refused(["report", "empty"], "empty", "summary.json")
    refused(["nowhere"], "nowhere", run=report)
    refused(["report"], "voussoir report output/")
    Path("broken").mkdir(exist_ok=True)
    Path("broken/summary.json").write_text("{")
    refused(["broken"], "not valid JSON", run=report)
    for text in ("[]", '{"limits": 3}', '{"extremes": {"max_slip": {"value": "much"}}, "warnings": 7}'):
        Path("broken/summary.json").write_text(text)
        refused(["broken"], "Repeat the run", run=report)
    write_scene()
    runs("scene.prm", "--output", "run", "--overwrite", "--set", "Output/Envelope interval=0")
    refused(["run", "--output", "page.txt"], "page.txt", ".html", run=report)
    refused(["run", "--output", "no/such/place.html"], "no/such/place.html", run=report)
    history = Path("run/history.csv").read_text().splitlines()
    for text, said in (("\n".join(history[:9] + [history[9][:12]] + history[10:]), "line 10 has"), ("\n".join(history[:5]) + "\n0.05,what" + ",0" * (len(history[0].split(",")) - 2), "what"),
                       ("\n".join(line.partition(",")[2] for line in history), "no column time")):
        Path("run/history.csv").write_text(text)
        refused(["run"], "run/history.csv is damaged", said, "Repeat the run", run=report)
    for text in (history[0][:30], history[0] + "\n" + history[1][:20], "", "\n".join(history)[:-7]):  # stopped while it wrote
        Path("run/history.csv").write_text(text)
        reports("run")
    Path("run/history.csv").write_text("\n".join(history))
    reports("run")  # without stresses
    expect("Not shown" in Reader("run/report.html").text, "what is missing is not said")


def received():
    """The directory of another person: no link in it is read or written through. Title of the tab."""
    write_scene()
    runs("scene.prm", "--output", "run")
    Path("mine.txt").write_text("mine")
    Path("run/figures").mkdir()
    links = [Path("run/report.html"), Path("run/figures/energy.png")]
    for link in links:
        link.symlink_to(Path("mine.txt").resolve())
        refused(["run"], str(link), "link out of the directory", run=report)
        link.unlink()
    Path("run/copy.txt").symlink_to("log.txt")  # a link within the directory
    links[0].symlink_to("../mine.txt")
    from voussoir import figures, report as page
    with mock.patch.object(page, "refuse_links"):
        reports("run", "--title", "Dam <A>")
    expect(not links[0].is_symlink() and "<title>Dam &lt;A&gt;</title>" in links[0].read_text(encoding="utf-8"), "the page")
    links[1].symlink_to("../../mine.txt")
    with mock.patch.object(sys, "argv", ["figures", "run"]):
        expect(figures.main() == 0, "figures")
    expect(links[1].read_bytes()[1:4] == b"PNG" and not links[1].is_symlink() and Path("mine.txt").read_text() == "mine", "written through a link")
    os.mkfifo("run/pipe")
    refused(["run"], "run/pipe", "a pipe", run=report)
    Path("run/pipe").unlink()
    Path("run/copy.txt").unlink()
    for name, target in (("run/log.txt", "/etc/hostname"), ("run/loop", "loop")):
        Path(name).unlink(missing_ok=True)
        Path(name).symlink_to(target)
        refused(["run"], name, "link out of the directory", run=report)
        Path(name).unlink()
    Path("scene-modes").mkdir()
    Path("scene-modes/modes.csv").symlink_to("../mine.txt")
    reports("run")
    expect("modes.csv is a link out of the directory" in Reader("run/report.html").text, "a link in a directory beside the run")


def numbers():
    """Overstress, shares, waterstops and what remains, against the fields of every step."""
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=1", "Joints/Friction=0.3"))
    found, faces = summary("run"), table("run/faces.csv")
    times = [float(row["time"]) for row in table("run/history.csv")]
    solutions = [Solution(f"run/solution-{k:05d}.vtu") for k in range(len(times))]
    strength, overstress = 0.4e6, found["overstress"]
    levels, ratios = overstress["levels"], [0., 0.]
    shares = [0.] * len(levels), [0.] * len(levels)
    durations, with_base = ([0.] * len(levels) for _ in range(2))
    base = base_of(faces, table("run/faces_cells.csv"))
    near_base = lambda place: min(math.dist(place, b) for b in base) < 21.
    expect(all(abs(level - 1. - k / 10.) < 1e-12 for k, level in enumerate(levels)) and len(levels) == 11, f"levels {levels}")
    for face in ("upstream", "downstream"):
        nodes = [row for row in faces if row["face"] == face]
        index = {id(row): i for i, row in enumerate(faces)}
        most = [float(row["max_principal"]) / strength for row in faces]
        for every, end in enumerate(("_away_from_base", "")):
            ratio = max(most[index[id(row)]] for row in nodes if every or not near_base(place_of(row)))
            close(overstress[face][f"demand_capacity{end}"], ratio, 1e-5, f"{face}: demand over capacity{end}")
            ratios[every] = max(ratios[every], ratio)
        for direction in ("arch", "cantilever"):
            ratio = max(float(row[f"{direction}_stress_max"]) / strength for row in nodes if not near_base(place_of(row)))
            close(overstress[face][f"demand_capacity_{direction}_away_from_base"], ratio, 1e-5, f"{face}: demand over capacity, {direction}")
        quads = [[int(row[f"n{k}"]) for k in range(4)] for row in table("run/faces_cells.csv") if row["face"] == face]
        for k, level in enumerate(overstress["levels"]):
            for every, end in enumerate(("_away_from_base", "")):
                whole = above = 0.
                for quad in quads:
                    part = area([place_of(faces[n]) for n in quad]) / 4.
                    counts = [n for n in quad if every or not near_base(place_of(faces[n]))]
                    whole += part * len(counts)
                    above += part * sum(most[n] > level for n in counts)
                close(overstress[face][f"share{end}"][k], above / whole, 1e-4, f"{face}: share above {level}{end}")
                shares[every][k] = max(shares[every][k], above / whole)
        for k in range(len(levels)):
            longest = away = 0.
            for row in nodes:
                at = solutions[0].near([float(row[c]) for c in "xyz"])
                own = [i for i in at if close_enough(max(s.data["max_principal"][i] for s in solutions), float(row["max_principal"]))]
                limit = overstress["levels"][k] * strength
                longest = max([longest] + (mine := [.01 * sum(s.data["max_principal"][i] > limit for s in solutions[1:]) for i in own]))
                away = max([away] + ([] if near_base(place_of(row)) else mine))
            expect(abs(overstress[face]["duration"][k] - longest) < 1e-5 and abs(overstress[face]["duration_away_from_base"][k] - away) < 1e-5,
                   f"{face}, level {overstress['levels'][k]}: {overstress[face]}, by the fields {away} and {longest} s")
            durations[k], with_base[k] = max(durations[k], away), max(with_base[k], longest)
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
        expect(limit["satisfied"] == limit["kept"] == (limit["value"] <= limit["limit"]), f"{name}: {limit}")
    satisfied = {name: limit["satisfied"] for name, limit in found["limits"].items()}
    expect(not satisfied["opening"] and satisfied["slip"] and satisfied["compression"], f"limits: {satisfied}")
    compressions = [-min(s.data["min_principal"][i] for s in solutions for i in range(len(solutions[0].points)) if every or not near_base(solutions[0].points[i]))
                    for every in (False, True)]
    for name, expected, accuracy in (("compression", compressions, 1e-5), ("demand_capacity", ratios, 1e-5)):
        close(found["limits"][name]["value"], expected[0], accuracy, f"{name}, away from the base, of the worse face")
        close(found["limits"][name]["value_with_base"], expected[1], accuracy, f"{name}, with the base, of the worse face")
    limit, excess = found["limits"]["overstressed_share"], [share - .2 * (2. - level) for share, level in zip(shares[0], levels)]
    k = excess.index(max(excess)) if max(excess) > 0. else 0
    close(limit["limit"], .2 * (2. - levels[k]), 1e-9, "limit of the share at the level that decides")
    for key, share in (("value", shares[0][k]), ("value_with_base", shares[1][k])):
        close(limit[key], share, 1e-4, f"share of the worse face, {key}")
    expect(shares[0] != shares[1] and ratios[0] < ratios[1], "the base changes nothing: this scene tells nothing")
    for key, name in (("value", "max_tension_upstream_away_from_base"), ("value_with_base", "max_tension_upstream")):
        close(found["limits"]["tension_upstream"][key], found["extremes"][name]["value"], 1e-9, "tension")
    for allowed in (0.4, 0.05, 2.):  # at the strength itself; falls to none at twice the strength
        runs("scene.prm", "--output", "run", *settings("Output/Solution interval=0", "Joints/Friction=0.3", f"Limits/Overstress duration={allowed}"))
        limit = summary("run")["limits"]["overstress_duration"]
        excess = [duration - allowed * (2. - level) for duration, level in zip(durations, levels)]
        k = excess.index(max(excess)) if max(excess) > 0. else 0
        print(f"    allowed {allowed} s: longest {[round(x, 2) for x in durations]} s, told {limit}")
        expect(abs(limit["value"] - durations[k]) < 1e-5 and abs(limit["limit"] - allowed * (2. - levels[k])) < 1e-9 and
               limit["satisfied"] == (max(excess) <= 1e-9), f"duration of overstress: {limit}, expected level {levels[k]}, {excess}")
        expect(abs(limit["value_with_base"] - with_base[k]) < 1e-5, f"duration of overstress with the base: {limit}, {with_base[k]}")
    expect(with_base != durations, "the base changes no duration: this scene tells nothing")
    expect("Limits    exceeded: " in Path("run/log.txt").read_text(), "the log does not say which limits are exceeded")
    write_scene()
    runs("scene.prm", "--output", "free", *settings("Joints/Friction=0.3"))
    expect("limits" not in summary("free") and "overstress" not in summary("free"), "limits that nobody gave")
    expect(summary("free")["extremes"] == found["extremes"], "limits change the results")


def worse_faces():
    """What is held against the limits is that of the worse face: upstream under water alone, downstream under the weight alone."""
    for worse, *entries in (("upstream", "Limits/Static tensile strength=2.5 MPa", "Statics/Self-weight=none"), ("downstream", "Limits/Static tensile strength=2.4 MPa", "Reservoir/Density=0")):
        runs("scene.prm", "--output", worse, *settings(*entries, "Limits/Overstress duration=100", "Limits/Overstressed share=1", "Motion/Duration=0.2"))
        found, limits = summary(worse)["overstress"], summary(worse)["limits"]
        for limit, of in (("demand_capacity", lambda face, end: face[f"demand_capacity{end}"]), ("overstressed_share", lambda face, end: face[f"share{end}"][0]),
                          ("overstress_duration", lambda face, end: face[f"duration{end}"][0])):
            for end, key in (("", "value_with_base"), ("_away_from_base", "value")):
                values = {face: of(found[face], end) for face in ("upstream", "downstream")}
                print(f"    {limit}, {key}: {values}")
                if end == "" and limit != "demand_capacity":  # at the base, higher levels than the strength itself decide
                    continue
                expect(limits[limit][key] == max(values.values()) == values[worse], f"{limit}: {limits[limit]}, {values}")
                expect(end == "" or min(values.values()) < values[worse], f"{limit}: {values}")


def assumed_strength():
    """Without a static strength it is two thirds of the dynamic one, and a warning says so."""
    entries = settings("Motion/Duration=0.1", "Limits/Tensile strength=0.6 MPa")
    shown = voussoir("scene.prm", "--output", "assumed", *entries, *settings("Limits/Static tensile strength=0"))
    expect(shown.returncode == 0 and "two thirds of Limits/Tensile strength, 0.4 MPa" in shown.stdout + shown.stderr, shown.stdout + shown.stderr)
    runs("scene.prm", "--output", "given", *entries)
    expect(summary("assumed")["overstress"] == summary("given")["overstress"], "two thirds of the dynamic strength")


def one_face():
    """A mesh without a surface "downstream": tension there is none, and what it would be held against is not evaluated."""
    mesh = arch_mesh()
    mesh["elements"] = [element for element in mesh["elements"] if element[:2] != (3, 3)]
    write_mesh("one.msh", mesh)
    write_scene("scene.prm", LIMITS)
    log = runs("scene.prm", "--output", "one", *from_file("one.msh"), *settings("Motion/Duration=0.1"))
    told, found = summary("one")["limits_not_evaluated"], summary("one")["limits"]
    expect(set(told) == {"tension_downstream", "demand_capacity", "overstressed_share", "overstress_duration"}
           and all("no surface 'downstream'" in why for why in told.values()) and "tension_upstream" in found, f"{told}, {found}")
    expect("nan" not in log and "none downstream" in log, log)


def unjudged():
    """Limits for which there is no result: they are named with the reason, and not told as satisfied."""
    write_scene("scene.prm", LIMITS)
    stresses = {"tension", "compression", "demand_capacity", "overstressed_share", "overstress_duration"}
    joints = {"opening", "slip", "waterstop_opening"}
    for name, reason, missing, *entries in (
            ("nothing", "", set()),
            ("no_stress", "Output/Envelope interval", stresses, "Output/Envelope interval=0"),
            ("skipped", "Output/Envelope interval is 2", stresses, "Output/Envelope interval=2"),
            ("rest_of_one", "one time only", {"overstress_duration"}, "Output/Envelope interval=2", "Motion/Source=none"),
            ("no_strength", "Limits/Static tensile strength", stresses - {"tension", "compression"}, "Limits/Tensile strength=0", "Limits/Static tensile strength=0"),
            ("no_motion", "one time only", {"overstress_duration"}, "Motion/Source=none"),
            ("no_joint", "no joint", joints, "Joints/Model=tied"),
            ("too_deep", "Waterstop depth", {"waterstop_opening"}, "Limits/Waterstop depth=500"),
            ("no_keys", "KSM", {"key_shear_stress"}, "Limits/Key shear stress=1 MPa")):
        runs("scene.prm", "--output", name, *settings(*entries, "Motion/Duration=0.1"))
        found, log = summary(name), Path(name, "log.txt").read_text()
        told = found.get("limits_not_evaluated", {})
        expect(told == found.get("limits_not_judged", {}), "the name of earlier versions")
        expect(set(told) == missing and all(reason in why for why in told.values()), f"{name}: {told}")
        limits = {limit.replace("_upstream", "").replace("_downstream", "") for limit in found["limits"]}
        expect(limits == (stresses | joints) - missing, f"{name}: {limits}")
        all_good = not missing and all(limit["satisfied"] for limit in found["limits"].values())
        expect(("not evaluated" in log) == bool(missing) and ("all are satisfied" in log) == all_good, f"{name}: {log[-600:]}")
    worse_faces()
    assumed_strength()
    one_face()
    deep = runs("scene.prm", "--output", "deep", *settings("Limits/Waterstop depth=18", "Motion/Duration=0.1"))
    expect("is thinner than Limits/Waterstop depth (18 m)" in deep, f"waterstops that end below the crest: {deep}")
    reports("no_motion")
    text = Reader("no_motion/report.html").text
    expect("Not evaluated: duration of overstress (the stresses are recorded at one time only)" in text, "the page does not say what is not evaluated")


def undecided():
    """A limit within the error bar is undecided; a bar on one side of it decides. The bars are in the table, or the command that makes them."""
    write_scene("scene.prm", "subsection Limits\nset Opening = 1\nset Tension = 1 MPa\nend\n")
    runs("scene.prm", "--output", "run")
    reports("run")
    expect("no error bar: run voussoir accuracy scene.prm" in Reader("run/report.html").text, "the command is not on the page")
    from voussoir.report_tables import items, verdict
    from voussoir.runs import Run
    found, entries = summary("run"), of_scene("run")
    value = found["extremes"]["max_opening"]["value"]
    Path("scene-accuracy").mkdir(exist_ok=True)
    for low, high, limit, state in ((.9, 1.2, 1.3, "satisfied"), (.9, 1.2, 1.1, "undecided"), (.9, 1.2, .95, "undecided"), (.9, 1.2, .8, "exceeded")):
        bar = {"value": 2., "combined": 2., "low": 2. * low, "high": 2. * high, "parts": {"up": .1}, "unit": "m"}  # of other seconds
        Path("scene-accuracy/accuracy.json").write_text(json.dumps({"error": {"openings": .01, "tension": .01}, "wish": .02, "error_bars": {"max_opening": bar}, "entries": entries}))
        found["limits"] = {"opening": {"value": value, "limit": limit * value, "unit": "m", "satisfied": limit >= 1.}}
        Path("run/summary.json").write_text(json.dumps(found))
        run = Run("run")
        item = items(run)["max_opening"]
        expect(item.state == state == verdict(run)[0], f"limit {limit}: {item.state}, {verdict(run)}")
        close(item.bar[0], low * value, 1e-9, "low end")
        close(item.bar[1], high * value, 1e-9, "high end")
        expect(items(run)["max_slip"].bar is None, "a bar that accuracy.json does not have")
        expect(("undecided" in verdict(run)[1]) == (state == "undecided"), verdict(run)[1])
    reports("run")
    text = Reader("run/report.html").text
    expect("1 of 1 limits is exceeded" in text and f"+{200. * value:.1f}"[:3] in text and "no error bar" not in text, text[:3000])


def earlier():
    """Which stress is compared with a limit is on the page; a run of version 0.3, whose limits were compared with the base, is read."""
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "now", *settings("Joints/Model=KSM", "Motion/Duration=0.1"))
    reports("now")
    text = Path("now/report.html").read_text(encoding="utf-8")
    row = lambda text, title: text[text.index(f"<td>{title}"):].partition("</tr>")[0]
    states = ("satisfied", "exceeded")
    found = summary("now")
    level = 2. - found["limits"]["overstressed_share"]["limit"] / .2  # that decides
    share = f"Share of the upstream face above {f'{level:.2g} times ' if level > 1.05 else ''}the static tensile strength"
    for title in ("Tension upstream", "Compression", "Demand-capacity ratio", share):
        away, base = row(text, f"{title}, away from the base"), row(text, f"{title}, with the base")
        expect(any(state in away for state in states) and not any(state in base for state in states), f"{away}, {base}")
    expect("compared with the values away from the base" in text, "the page does not say what is compared")
    found["overstress"]["tensile_strength"] = found["overstress"].pop("static_tensile_strength")
    for face in ("upstream", "downstream"):
        found["extremes"].pop(f"max_tension_{face}_away_from_base")
        found["overstress"][face] = {name: value for name, value in found["overstress"][face].items() if "away" not in name}
    found["extremes"].pop("max_compression_away_from_base")
    for limit in found["limits"].values():
        limit.pop("satisfied")
        if limit.pop("value_with_base", None) and limit["unit"] == "Pa":
            limit["kept"] = False
    shutil.copytree("now", "then")
    Path("then/summary.json").write_text(json.dumps(found))
    energy = Path("then/energy.csv").read_text().replace("joint_stored", "unknown")
    Path("then/energy.csv").write_text(energy)
    reports("then")
    text = Path("then/report.html").read_text(encoding="utf-8")
    expect("exceeded" in row(text, "Tension upstream, with the base") and "exceeded" not in row(text, "Tension upstream, away from the base"), "limits of 0.3")
    expect("exceeded" in row(text, "Compression, with the base") and "Not shown" not in text, "compression of 0.3")
    expect("Demand-capacity ratio " in row(text, "Demand-capacity ratio") and "compared with the values away" not in text, "demand of 0.3")


def keys():
    """The shear that the keys of a joint carry beyond the friction of its faces, against the pairs of every step."""
    write_scene("scene.prm", "subsection Limits\nset Key shear stress = 2e5\nend\n")
    chosen = settings("Output/Solution interval=1", "Joints/Model=KSM", "Joints/Overrides=2: FJA", "Joints/Friction=0.3")
    runs("scene.prm", "--output", "run", *chosen)
    found, points = summary("run"), [row for row in table("run/joint_points.csv") if row["joint"] == "1"]
    times, forces = [float(row["time"]) for row in table("run/history.csv")], []
    area_of = {tuple(round(float(row[c]), 2) for c in "xyz"): float(row["area"]) for row in points}
    for k in range(len(times)):
        data, force, seen = Solution(f"run/joints-{k:05d}.vtu").data, 0., set()
        for i, (pressure, *place) in enumerate(zip(data["pressure"], *(data["Points"][c::3] for c in range(3)))):
            key = tuple(round(x, 2) for x in place)
            if key in area_of and key not in seen:
                seen.add(key)
                shear = math.hypot(*data["shear_stress"][3 * i:3 * i + 3])
                force += area_of[key] * max(0., shear - .3 * max(0., pressure))
        expect(len(seen) == len(points), f"{len(seen)} of {len(points)} pairs are in the fields")
        forces.append(force)
    largest, whole = max(forces), sum(area_of.values())
    print(f"    {found['keys']}; by the fields {largest:.6g} N on {whole:.6g} m2 at {times[forces.index(largest)]} s")
    expect(found["keys"]["joints"] == [1] and largest > 0., f"{found['keys']}")
    close(found["keys"]["force"][0], largest, 1e-4, "force on the keys")
    close(found["keys"]["max_shear_stress"]["value"], largest / whole, 1e-4, "shear stress of the keys")
    expect(found["keys"]["max_shear_stress"]["joint"] == 1, "the joint of the keys")
    expect(abs(found["keys"]["max_shear_stress"]["time"] - times[forces.index(largest)]) < 1e-6, "the time of the keys' force")
    limit = found["limits"]["key_shear_stress"]
    close(limit["value"], largest / whole, 1e-4, "what is held against the limit")
    expect(limit["satisfied"] == (largest / whole <= 2e5) and limit["limit"] == 2e5, f"{limit}")
    reports("run")
    expect("Shear stress of the keys, joint 1" in Reader("run/report.html").text, "the page leaves out the keys")


def ended():
    """A run that could not write its results goes on after its last step: all numbers are those of the run that could."""
    write_scene("scene.prm", LIMITS)
    chosen = settings("Output/Solution interval=25", "Joints/Friction=0.3", "Joints/Model=KSM", "Limits/Key shear stress=1 MPa")
    runs("scene.prm", "--output", "whole", *chosen)
    for in_the_way in ("envelope.vtu", "solution-00050.vtu"):
        shutil.rmtree("late", ignore_errors=True)
        Path("late", in_the_way).mkdir(parents=True)
        result = voussoir("scene.prm", "--output", "late", *chosen)
        expect(result.returncode == 1 and "step 50 of 50" in result.stderr, f"{result.stderr}")
        Path("late", in_the_way).rmdir()
        runs("scene.prm", "--output", "late", *chosen, "--resume")
        late, whole = summary("late"), summary("whole")
        for entry in ("overstress", "waterstop", "residual", "keys", "limits", "extremes", "steps"):
            expect(late[entry] == whole[entry], f"{entry} after {in_the_way}: {late[entry]}, of the whole run {whole[entry]}")
        for name in ("joint_points.csv", "faces.csv", "history.csv", "energy.csv", "frames.bin", "solution.pvd"):
            expect(Path("late", name).read_bytes() == Path("whole", name).read_bytes(), f"{name} after {in_the_way} is not that of the whole run")
        for name in ("solution-00025.vtu", "solution-00050.vtu", "envelope.vtu"):  # which have the time at which they were written
            expect(read_vtu(f"late/{name}") == read_vtu(f"whole/{name}"), f"{name} after {in_the_way} is not that of the whole run")


def place_of(row):
    return [float(row[c]) for c in "xyz"]


def base_of(faces, quads):
    """The places of the base: the ends of the faces but for the crest."""
    at = [tuple(round(x, 2) for x in place_of(row)) for row in faces]
    edges = Counter((quad["face"], *sorted((at[int(quad[f"n{a}"])], at[int(quad[f"n{(a + 1) % 4}"])]))) for quad in quads for a in range(4))
    return {place for (_, *places), n in edges.items() if n == 1 and min(place[2] for place in places) < 209.9 for place in places}


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
            close(float(row["target_z"]), 2.5 * .5575 * .1 * 9.80665 * .666667, 1e-6, "plateau of the vertical one")
        x, mean, most = (float(row[name]) for name in ("spectrum_x", "rotd50", "rotd100"))
        expect(abs(most / x - 1.) < 1e-6 and abs(mean / most - math.sqrt(.5)) < 1e-6, f"RotD50 and RotD100 of one component: {row}")
    rotated()


def rotated():
    """RotD50 and RotD100 of both horizontal components are in the figures of the report, with the target; of one component there are none."""
    runs("scene.prm", "--output", "both", *settings("Motion/Source=artificial", "Motion/File=", "Motion/Duration=8", "Motion/Unit=m/s^2"))
    rows = table("both/spectrum.csv")
    for row in rows:
        x, y, mean, most = (float(row[name]) for name in ("spectrum_x", "spectrum_y", "rotd50", "rotd100"))
        expect(mean <= most <= 1.000001 * math.hypot(x, y) and most >= .999999 * max(x, y), f"{row}")
    expect(any(float(row["rotd100"]) > 1.05 * max(float(row["spectrum_x"]), float(row["spectrum_y"])) for row in rows), "no other direction has a larger response")
    reports("both", "artificial")
    page = Path("both/report.html").read_text()
    expect(page.count('alt="response spectrum, RotD50 and RotD100') == 1, "one of both motions has two horizontal components")
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
    from voussoir import drawing, runs as package_runs
    labels = {}
    for name, directions in (("both", "xyz"), ("both", "xy"), ("both", "x"), ("artificial", "xz")):
        axes = drawing.plt.subplots()[1]
        drawing.draw_spectra(axes, package_runs.Run(name).table("spectrum.csv"), directions)
        labels[name, directions] = axes.get_legend_handles_labels()[1]
        shown = {line.get_label(): line.get_ydata() for line in axes.lines}
        expect("RotD100" not in shown or list(shown["RotD100"]) == [float(row["rotd100"]) for row in rows], f"{shown}")
    expect(labels == {("both", "xyz"): ["stream", "cross", "vertical", "RotD50", "RotD100", "target"], ("both", "xy"): ["stream", "cross", "RotD50", "RotD100", "target"],
                      ("both", "x"): ["stream", "target"], ("artificial", "xz"): ["stream", "vertical", "target"]}, f"{labels}")


def table(name):
    with open(name) as file:
        return list(csv.DictReader(file))


def close_enough(a, b):
    return abs(a - b) <= 1e-5 * abs(b) + 1e-3


def area(corners):
    a, b = ([q - p for p, q in zip(corners[i], corners[i + 2])] for i in (0, 1))
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return .5 * sum(x * x for x in cross) ** .5


if __name__ == "__main__":
    run_cases(page, beside_static, analysed, motions, browser, colours, units, answers, content, refusals, received, numbers, unjudged, undecided, earlier, keys, ended, spectrum)
