# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a self-contained page about a run of voussoir, or about several runs side by side.

    voussoir report DIR... [--output FILE.html] [--pdf] [--title TEXT] [--owner TEXT] [--author TEXT] [--date TEXT]

DIR are output directories of finished runs. The page contains its figures and its style, and loads nothing from the network.
The files of the directories may come from other persons. Therefore all texts are escaped, and the Content-Security-Policy of the page forbids
other files, and scripts except those of the view of the moving dam. --pdf prints the page to FILE.pdf with an installed Chromium (on Debian:
apt-get install chromium), without scripts.
"""

import shlex
import sys
from base64 import b64encode
from datetime import datetime
from hashlib import sha256
from html import escape
from pathlib import Path

from . import report_ensemble as ensemble
from . import report_figures as figures
from . import report_view3d as view3d
from .chromium import find_browser, print_page
from .command import Parser, write_whole
from .drawing import draw_overstress
from .ensemble_drawing import draw_distribution, draw_dynamic_analysis, draw_joint_band
from .error_bars import bar_text
from .errors import ComputationError, InputError
from .prm import prm_text
from .report_answers import accuracy_sentence, answers, compared, mesh_quality, modes, modes_of, notes
from .report_needs import needs_of
from .report_scene import analysed, factor_of_first
from .report_tables import MINUS, blocks, blocks_of, differences, extremes, facts, html_table, number, table, verdict, wedges, wedges_of
from .runs import NotComputed, Run, Skip, name_apart, refuse_links


STUDY = ("title", "owner", "author", "date")  # options with the texts of the title page


MARKED = "Marked: the extreme value away from the base."


class Page:
    """Text of the page, and what could not be shown."""

    def __init__(self):
        self.parts, self.missing, self.further, self.figures = [], [], [], 0
        self.styles, self.scripts = [], []  # of the page, in this order
        self.title = ""  # of the tab, and of a PDF

    def add(self, text):
        self.parts.append(text)

    def section(self, title):
        self.add(f"<h2>{escape(title)}</h2>")

    def caption(self, text):
        self.figures += 1
        return f"<figcaption><b>Figure {self.figures}.</b> {text}</figcaption>"

    def wide(self, caption, alt, make):
        """A figure that is drawn twice: for wide screens and paper, and for narrow screens."""
        if (pair := self.made(alt, make)) is not None:
            self.add(f'<figure><picture><source media="(max-width: 640px)" srcset="{pair[1]}">'
                     f'<img src="{pair[0]}" alt="{escape(alt)}"></picture>{self.caption(caption)}</figure>')

    def whole(self, caption, alt, make):
        """One image as wide as the page; its caption is a function of the words that come with the image."""
        if (made := self.made(alt, make)) is not None:
            self.add(f'<figure><img src="{made[0]}" alt="{escape(alt)}">{self.caption(caption(made[1]))}</figure>')

    def row(self, caption, panels):
        """Panels side by side, each with its name: (name, alternative text, how to make it)."""
        cells = []
        for name, alt, make in panels:
            if (source := self.made(alt, make)) is not None:
                title = f'<p class="name">{escape(name)}</p>' if name else ""
                cells.append(f'<div>{title}<img src="{source}" alt="{escape(alt)}"></div>')
        if cells:
            self.add(f'<figure><div class="row">{"".join(cells)}</div>{self.caption(caption)}</figure>')

    def made(self, what, make):
        """Result of `make`. If data are missing: None, and a remark at the end of the page."""
        try:
            return make()
        except NotComputed as command:
            self.further.append(f"{what}: {command}")
        except Skip as reason:
            self.missing.append(f"{what}: {reason}")
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
            self.missing.append(f"{what}: the data are not understood ({type(error).__name__}: {error})")
            print(f"voussoir: warning: {what}: {type(error).__name__}: {error}", file=sys.stderr)
        return None


def named(runs, run, what=""):
    """The name over a panel: of the run, where there are several, and of what it shows."""
    return ", ".join(text for text in (run.name if len(runs) > 1 else "", what) if text)


def moving_of(page, runs, what):
    """Runs with an earthquake. The other runs produce a remark at the end of the page."""
    page.missing += [f"{run.name}: {what}, the run is of the static state alone" for run in runs if not run.moves]
    return [run for run in runs if run.moves]


def single(runs):
    """Runs of one motion, which have tables over time."""
    return [run for run in runs if not run.ensemble]


# ---------------------------------------------------------------- sections

def head(page, runs, study):
    """Title page. study: title, owner, author and date of the command line, None if not given."""
    run, several = runs[0], len(runs) > 1
    title = " and ".join(run.scene for run in runs[:2]) if several and len({r.scene for r in runs}) > 1 else run.scene
    if len({r.scene for r in runs}) > 2:
        title = ""
    title = study.get("title") or f"Earthquake analysis of {f'the arch dam “{title}”' if title else f'an arch dam: {len(runs)} runs'}"
    page.title = study.get("title") or ", ".join(run.heading for run in runs)
    page.add(f'<div class="first"><header><h1>{escape(title)}</h1>')
    rows = [("Owner", study.get("owner")), ("Author", study.get("author")), ("Date", study.get("date") or date_of(datetime.now())),
            ("Runs", ", ".join(r.name for r in runs) if several else ""),
            ("Computed", f"{date_of(datetime.fromtimestamp((run.directory / 'summary.json').stat().st_mtime))} with Voussoir {run.summary.get('version', '')}")]
    page.add("<dl>" + "".join(f"<dt>{name}</dt><dd>{escape(text)}</dd>" for name, text in rows if text) + "</dl></header>")


def date_of(day):
    return day.strftime("%-d %B %Y")


def what_was_analysed(page, runs):
    """Dam, joints, water, foundation and motion in words, the dam as a picture, and the spectrum of the motion."""
    page.section("What was analysed")
    found = [dict(analysed(run)) for run in runs]
    titles = list(dict.fromkeys(title for rows in found for title in rows))
    same = [title for title in titles if len({rows.get(title) for rows in found}) == 1]
    page.add('<dl class="analysed">' + "".join(f"<dt>{title}</dt><dd>{escape(found[0][title])}</dd>" for title in same) + "</dl>")
    if apart := [title for title in titles if title not in same]:
        page.add(table(["run", *apart], [((run.name, *(rows.get(title, "–") for title in apart)), False) for run, rows in zip(runs, found)]))
    pictured = {str([run.summary.get("mesh", {}).get(key) for key in ("cells", "volume", "crest_length")]): run for run in reversed(runs)}
    shown = [run for run in runs if run in pictured.values()]
    panels = [(named(shown, run), f"mesh of {run.name}", lambda run=run: figures.dam(run)) for run in shown]
    caption = "The dam, seen from downstream, the right bank at the left; heavy lines are joints."
    moving = [run for run in runs if run.moves]
    if moving and (moving[0].directory / "spectrum.csv").exists():
        panels += [(named(shown, moving[0]), f"spectrum of {moving[0].name}", lambda: figures.motion_spectrum(moving[0]))]
        has_target = page.made("target spectrum", lambda: any(name.startswith("target") for name in moving[0].table("spectrum.csv")))
        caption += (f" Response spectra of the {'first ' if moving[0].ensemble else ''}ground motion{factor_of_first(moving[0])}"
                    f"{'; dashed: the target' if has_target else ''}.")
    page.row(caption, panels)


def summary(page, runs):
    page.section("Answers")
    if len(runs) > 1:
        page.add(compared(runs) + notes(runs))
    else:
        run = runs[0]
        state, text = (ensemble.state(run), answers(run, ensemble.asked(run))) if run.ensemble else (verdict(run)[0], answers(run))
        page.add(f'<div class="verdict {state}">{text}</div>')
    warnings(page, runs)


def warnings(page, runs):
    """Warnings of the program about the physics, and remarks on the input file."""
    page.add("<h3>Warnings</h3>")
    found = [(run, warning) for run in runs for warning in run.warnings]
    rows = "".join(f'<li{"" if warning["class"] == "input" else " class=warning"}>{escape(named(runs, run))}{": " if len(runs) > 1 else ""}'
                   f'{escape(str(warning["text"]))}</li>' for run, warning in found)
    page.add(f"<ul>{rows}</ul>" if found else "<p>None.</p>")


def open_dam(page, runs):
    for run in single(runs):
        if run.moves and not run.tied:
            page.whole(lambda words, run=run: f"The dam {'of ' + escape(run.name) + ' ' if len(runs) > 1 else ''}at its widest opening, seen from downstream: "
                       f"{escape(words)}.", f"open dam of {run.name}", lambda run=run: figures.open_dam(run))


def results(page, runs):
    page.add("</div>")
    page.section("Results")
    one_ensemble = len(runs) == 1 and runs[0].ensemble
    page.add(ensemble.extremes(runs[0]) if one_ensemble else extremes(runs))
    page.add('<p class="sub">Opening and slip are counted from the grouted state, with the dam under its own weight. Tension is positive. '
             + ('Known within: half width of the interval of the median that the scatter of the motions allows.' if one_ensemble else
                'Joints and monoliths are numbered as in the figures.') + "</p>")
    for run in runs:
        if run.ensemble:
            page.add(f"<h3>Motions{' of ' + escape(run.name) if len(runs) > 1 else ''}</h3>{ensemble.motions(run)}")
    error_bars(page, runs)
    if any("value_with_base" in limit for run in runs for limit in run.summary.get("limits", {}).values()):
        page.add('<p class="sub">Limits of stresses are compared with the values away from the base: farther from it than a tenth of the '
                 'dam’s height. Closer to the base the stress of an elastic dam grows with refinement of the mesh.</p>')
    open_dam(page, runs)


def error_bars(page, runs):
    """What the error bars are, or why a run has none."""
    for run in runs:
        bars, reason = run.error_bars
        of = f"{escape(run.name)}: " if len(runs) > 1 else ""
        if any({"motion", "damping"} & set(bar) for bar in bars.values()):
            page.add(f'<p class="sub">{of}Parts of the errors, by <code>voussoir accuracy</code>, the motions and <code>voussoir needs</code>: '
                     f"{escape('; '.join(bar_text(name, bar) for name, bar in bars.items()))}.</p>".replace(" -", f" {MINUS}"))
        if bars and not run.ensemble:
            page.add(f'<p class="sub">{of}Behind a value: its error bar of mesh and time step, by <code>voussoir accuracy</code> over the strongest '
                     'seconds of the motion; the relative error of these seconds is applied to the whole run. A limit within the bar is '
                     "undecided. Values without a bar are compared as they are.</p>")
        elif reason:
            page.add(f'<p class="sub">{of}{escape(reason)}</p>')


def moving_dam(page, runs):
    view3d.section(page, single(runs))


def dam_and_scene(page, runs):
    page.section("Dam and scene")
    pictured = {str(run.summary.get("mesh", {})): run for run in reversed(runs)}
    shown = [run for run in runs if run in pictured.values()]
    page.add(facts(runs))
    for run in shown:
        if (rows := page.made(f"quality of the mesh of {run.name}", lambda run=run: mesh_quality(run))) is not None:
            page.add(table([named(shown, run, "mesh"), ""], [(row, False) for row in rows]))
    natural_modes(page, runs)
    page.add("<h3>What differs from the defaults</h3>")
    page.add(differences(runs))


def natural_modes(page, runs):
    """Frequencies and shapes, of each scene once."""
    for run in {run.scene: run for run in reversed(runs)}.values():
        if (found := page.made(f"natural modes of {run.name}", lambda run=run: modes_of(run))) is None:
            continue
        page.add(f"<h3>Natural modes{' of ' + escape(run.scene) if len(runs) > 1 else ''}, joints closed</h3>")
        page.add(modes(run))
        shapes, directory = found
        page.row("Shapes of the first modes, coloured by the displacement downstream; dashed: the dam at rest.",
                 [(f"{k + 1}: {shapes['frequency'][k]:.3g} Hz", f"mode {k + 1} of {run.name}", lambda k=k: figures.mode(directory, k))
                  for k in range(min(6, len(shapes["mode"])))])


def motion(page, runs):
    page.section("Ground motion")
    seen = {run.name: run for run in runs if run.ensemble}
    for run in single(runs):
        if not run.moves:
            continue
        try:
            seen.setdefault(tuple((d, a.tobytes()) for d, a in sorted(run.base_acceleration.items())), run)
        except Skip as reason:
            page.missing.append(f"motion of {run.name}: {reason}")
    moving = list(seen.values())
    if not any(run.moves for run in runs):
        page.add("<p>None: the static state alone.</p>")
    for run in single(moving):
        title = f" of {escape(run.name)}" if len(moving) > 1 else ""
        page.wide(f"Acceleration of the base{title}.", f"acceleration of the base of {run.name}", lambda run=run: figures.accelerations(run))
    for run in moving:
        top = page.made("spectra", lambda: figures.highest_spectrum(moving))
        images = page.made("spectra", lambda run=run: figures.spectra(run, top)) if top else None
        if images:
            damping = 100. * run.table("spectrum.csv")["damping"][0]
            of = f" of {escape(run.name)}" if len(moving) > 1 else ""
            page.row(f"Response spectra of the {'first ' if run.ensemble else ''}motion{of}, damping {damping:g} %{target_words(page, run)}.",
                     [("", f"response spectrum, {name}", lambda source=source: source) for name, source in images.items()])


def target_words(page, run):
    """What the dashed lines of the spectra are, and how well the motion matches them."""
    ratios = page.made("deviation of the spectra", lambda: figures.deviation(run.table("spectrum.csv")))
    return f"; dashed: the target spectrum; between 0.1 and 2 s the motion has {ratios[0]:.2f} to {ratios[1]:.2f} of it" if ratios else ""


def response(page, runs):
    page.section("Response")
    scatter(page, [run for run in runs if run.ensemble], len(runs) > 1)
    runs = single(runs)
    moving = moving_of(page, runs, "its response over time")
    if moving:
        page.wide("Displacement of the crest at the crown against the base, downstream positive. It begins with the static state.",
                  "displacement of the crest", lambda: figures.crest(moving))
    for run in moving:
        of = f" of {escape(run.name)}" if len(runs) > 1 else ""
        if page.made(f"accelerations of {run.name}", lambda run=run: figures.points_with_acceleration(run)):
            page.wide(f"Absolute accelerations of points of the dam{of}.", f"accelerations of points of {run.name}",
                      lambda run=run: figures.point_accelerations(run))
        if (run.directory / "floor_spectra.csv").exists():
            page.wide(f"Floor spectra{of}.", f"floor spectra of {run.name}", lambda run=run: figures.floor_spectra(run))
    open_ = [run for run in runs if not run.tied]
    if open_:
        page.row("Largest openings and slips at the crest, joint by joint.",
                 [(named(open_, run, ""), f"largest {quantity}s of {run.name}",
                   lambda run=run, quantity=quantity: figures.crest_bars(run, quantity, open_)) for run in open_ for quantity in ("opening", "slip")])
        top = {q: page.made(f"{q} over the height", lambda q=q: figures.highest_point(open_, q)) for q in ("opening", "slip")}
        page.row("Largest openings and slips over the height, of the joints that move most.",
                 [(named(open_, run), f"{q} over the height of {run.name}",
                   lambda run=run, q=q: figures.over_height(run, q, top[q])) for run in open_ for q in ("opening", "slip") if top[q] is not None])
    moving = [run for run in moving if not run.tied]
    if moving:
        highest = {q: page.made(f"{q} over time", lambda q=q: figures.highest_at_crest(moving, q)) for q in ("opening", "slip")}
        page.row("Opening and slip at the crest over time, of the joints that open most.",
                 [(named(runs, run), f"{q} over time of {run.name}", lambda run=run, q=q: figures.over_time(run, q, highest[q]))
                  for run in moving for q in ("opening", "slip") if highest[q] is not None])


def scatter(page, runs, several):
    """Openings and slips along the crest over many motions, their distributions, and incremental dynamic analyses."""
    for run in runs:
        of = f" of {escape(run.name)}" if several else ""
        if not run.tied:
            page.row(f"Largest openings and slips along the crest{of}: median, 16 to 84 %, and each motion.",
                     [("", f"{quantity}s of {run.name}", lambda run=run, q=quantity: figures.drawn(2.7, draw_joint_band, run, q))
                      for quantity in ("opening", "slip")])
        measures = (["max_opening"] if not run.tied else []) + ["tension"]
        page.row(f"Share of the motions{of} up to a value.",
                 [("", f"distribution of {measure.replace('_', ' ')} of {run.name}",
                  lambda run=run, m=measure: figures.drawn(2.5, draw_distribution, run, m))
                  for measure in measures if run.ensemble.n > 1])
        if len(run.ensemble.factors) > 1:
            page.row(f"Incremental dynamic analysis{of}: factor of the motions, and largest value.",
                     [("", f"dynamic analysis, {measure.replace('_', ' ')} of {run.name}",
                      lambda run=run, m=measure: figures.drawn(2.9, draw_dynamic_analysis, run, m))
                      for measure in measures])


def stresses(page, runs):
    strength = any(run.limit("Tensile strength") > 0. for run in runs)
    page.section("Stresses")
    for column, kind in (("max_principal", "Largest principal stress"), ("min_principal", "Smallest principal stress")):
        heavy = "; the heavy line is the tensile strength" if strength and column == "max_principal" else ""
        median = f"; {'of many motions ' if len(runs) > 1 else ''}the median over the motions" if any(run.ensemble for run in runs) else ""
        page.row(f"{kind} of every point over time{median}, self-weight included, on the developed faces{heavy}. {MARKED}",
                 [(named(runs, run, f"{name} face"), f"{kind.lower()}, {name} face of {run.name}",
                   lambda run=run, name=name, column=column: figures.face(run, name, column, runs))
                  for run in runs for name in ("upstream", "downstream")])
    directed = page.made("arch and cantilever stresses", lambda: figures.directed(runs)) or []
    for column, kind in (("arch_stress_max", "arch"), ("cantilever_stress_max", "cantilever")):
        page.row(f"Largest {kind} stress of every point over time, on the developed faces. {MARKED}",
                 [(named(runs, run, f"{name} face"), f"{kind} stress, {name} face of {run.name}",
                   lambda run=run, name=name, column=column: figures.directed_face(run, name, column, directed))
                  for run in directed for name in ("upstream", "downstream")])
    strong = [run for run in runs if run.static_strength > 0. and (run.directory / "faces.csv").exists()]
    page.row("Demand-capacity ratio of every point: largest principal stress over the static tensile strength; heavy lines: 1 and 2 (USACE EM 1110-2-6053). "
             + MARKED,
             [(named(runs, run, f"{name} face"), f"demand-capacity ratio, {name} face of {run.name}", lambda run=run, name=name: figures.demand(run, name))
              for run in strong for name in ("upstream", "downstream")])
    page.row("Cumulative duration for which the stress at any one point of a face is above a multiple of the static tensile strength "
             "(USACE EM 1110-2-6053).",
             [(named(runs, run), f"duration of overstress of {run.name}", lambda run=run: figures.drawn(2.5, draw_overstress, run))
              for run in single(strong) if run.moves])


def bases(page, runs):
    shown = [run for run in runs if blocks_of(run)]
    if not shown:
        return
    page.section("Monoliths on their bases")
    for run in shown:
        if len(runs) > 1:
            page.add(f"<h3>{escape(run.name)}</h3>")
        page.add(blocks(run))
    page.add('<p class="sub">Force of the foundation on the base of each monolith: normal to its mean plane, and in it. In brackets: the time.</p>')
    safe = [run for run in shown if any("min_sliding_safety" in block for block in blocks_of(run).values())]
    if safe:
        page.row("Safety against sliding on the base over time, of the monoliths that have the least.",
                 [(named(runs, run), f"safety against sliding of {run.name}", lambda run=run: figures.sliding(run, safe)) for run in safe])


def rock_wedges(page, runs):
    shown = [run for run in runs if wedges_of(run)]
    if not shown:
        return
    page.section("Rock wedges")
    for run in shown:
        if len(runs) > 1:
            page.add(f"<h3>{escape(run.name)}</h3>")
        page.add(wedges(run))
    page.add('<p class="sub">Limit equilibrium of rigid wedges: mode and force of the dam on the wedge at the time of the smallest safety.</p>')


def needs(page, runs):
    """Table of `voussoir needs`, of each scene once."""
    for run in {run.scene: run for run in reversed(runs)}.values():
        if run.moves and (found := page.made(f"what the scene of {run.name} needs", lambda run=run: needs_of(run))) is not None:
            page.section(f"What the scene{' ' + run.scene if len(runs) > 1 else ''} needs")
            page.add(f"<p>{found[0]}</p>{found[1]}")
            page.add(f'<p class="sub">Change of each result in percent, over the strongest {found[2]:g} s of the motion; cost as a ratio. In brackets: '
                     "negligible differences.</p>")


def checks(page, runs):
    page.section("Energy and checks")
    moving = [run for run in single(runs) if run.moves]
    page.row("Energies; on rock also what has left through the artificial boundary.",
             [(named(runs, run), f"energies of {run.name}", lambda run=run: figures.energies(run, moving)) for run in moving])
    rows = [("Energy balance, over the largest energy", lambda s: number(s["energy_balance_error"], "")),
            ("Residual of the contact problems, relative", lambda s: number(s["contact_residual"], "")),
            ("Newton steps per time step, mean and largest", lambda s: f"{s['newton_iterations']['mean']:.2f}, {s['newton_iterations']['max']:.0f}"),
            ("Time steps", lambda s: f"{s['steps']} of {s['time_step']:g} s" if s["steps"] else "the static state")]
    body = []
    for title, value in rows:
        cells = []
        for run in runs:
            try:
                cells.append(value(run.summary))
            except (KeyError, TypeError, ValueError):
                cells.append("")
        if any(cells):
            body.append(("", [title, *map(escape, cells)]))
    if body:
        page.add(html_table([("check", ""), *((escape(run.name), "n") for run in runs)], body))
    for run in runs:
        if sentence := page.made(f"error of mesh and time step of {run.name}", lambda run=run: accuracy_sentence(run)):
            page.add(f"<p>{f'<b>{escape(run.name)}.</b> ' if len(runs) > 1 else ''}{sentence}</p>")


def repeat(page, runs, study):
    page.section("How to repeat it")
    page.add("<p>Write the scene below to a file, beside the meshes and records that it names, and run:</p>")
    for run in runs:
        summary = run.summary
        scene = f"{run.scene}.prm" if len({r.scene for r in runs}) == len(runs) else f"{run.directory.resolve().name}.prm"
        own = {entry: value for entry, (value, default) in run.entries.items() if default is not None}
        page.add(f'<h3>{escape(run.name)}</h3><pre>voussoir {escape(scene)} --output {escape(run.directory.resolve().name)}</pre>'
                 f"<p class=\"sub\">Voussoir {escape(str(summary.get('version', '?')))}, revision {escape(str(summary.get('revision', '?')))}, "
                 f"deal.II {escape(str(summary.get('dealii', '?')))}; it took {summary.get('seconds', {}).get('wall', 0.):.0f} s and "
                 f"{summary.get('memory_bytes', 0.) / 2**30:.2g} GiB.</p>"
                 f'<details{" open" if len(runs) == 1 else ""}><summary>{escape(scene)}</summary><pre>{escape(prm_text(own))}</pre></details>')
    words = [run.directory.resolve().name for run in runs] + [word for name, text in study.items() if text for word in (f"--{name}", text)]
    page.add(f"<p>This page: <code>voussoir report {escape(shlex.join(words))}</code></p>")


def listed(texts):
    return "<ul>" + "".join(f"<li>{escape(text)}</li>" for text in dict.fromkeys(texts)) + "</ul>"


def allowed(directive, texts):
    """Directive of the Content-Security-Policy that allows these inline texts by their hashes; none for no texts."""
    hashes = " ".join(f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'" for text in texts)
    return f"{directive} {hashes}; " if texts else ""


def page_of(runs, study):
    page = Page()
    head(page, runs, study)
    for section in (what_was_analysed, summary, results, moving_dam, dam_and_scene, motion, response, stresses, bases, rock_wedges, needs, checks):
        section(page, runs)
    repeat(page, runs, study)
    if page.missing:
        page.add(f"<h3>Not shown</h3>{listed(page.missing)}")
    if page.further:
        page.add(f"<h3>Further content, and the command that adds it</h3>{listed(page.further)}")
    page.add("<footer>Made by Voussoir’s <code>report</code>. Units are SI; openings and slips in mm, stresses in MPa, forces in MN.</footer>")
    styles = [(Path(__file__).resolve().parent / "report.css").read_text(), *page.styles]
    policy = ("default-src 'none'; img-src data:; " + allowed("style-src", styles) + allowed("script-src", page.scripts)
              + "base-uri 'none'; form-action 'none'")
    text = (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{policy}">'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            f'<title>{escape(page.title)}</title><link rel="icon" href="data:,">' + "".join(f"<style>{style}</style>" for style in styles)
            + "</head><body>\n" + "\n".join(page.parts) + "".join(f"\n<script>{script}</script>" for script in page.scripts)
            + "\n</body></html>\n")
    return text.encode("utf-8", "backslashreplace").decode()  # JSON may hold halves of characters


# ---------------------------------------------------------------- files

def print_pdf(page, text, pdf):
    """The page's text as PDF. Throws InputError where there is no Chromium."""
    if (browser := find_browser()) is None:
        raise InputError("--pdf needs a Chromium, and none is on the PATH. On Debian: apt-get install chromium; or open "
                         f"{page} in any browser and print it; the environment variable VOUSSOIR_BROWSER may name one.")
    try:
        write_whole(pdf, print_page(text))
    except OSError as error:
        raise ComputationError(f"{browser} did not print {pdf}: {error}. The page {page} is complete.") from error


def main():
    parser = Parser(prog="voussoir report", description=__doc__)
    parser.add_argument("directories", nargs="*", metavar="DIR")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--pdf", action="store_true")
    for name in STUDY:
        parser.add_argument(f"--{name}")
    options = parser.parse_args()
    if not options.directories:
        raise InputError("`voussoir report` needs the output directory of a run, or of several: voussoir report output/quickstart")
    for directory in options.directories:
        refuse_links(directory)
    runs = [Run(directory) for directory in options.directories]
    name_apart(runs)
    output = options.output or runs[0].directory / "report.html"
    if output.suffix not in (".html", ".htm"):
        raise InputError(f"The report is a page: give --output a name that ends in .html, instead of {output}.")
    try:
        text = page_of(runs, {name: getattr(options, name) for name in STUDY})
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise InputError(f"summary.json of {', '.join(options.directories)} is not what this version writes ({type(error).__name__}: {error}). "
                         "Repeat the run.") from error
    try:
        write_whole(output, text)
    except OSError as error:
        raise InputError(f"{output} cannot be written: {error.strerror}. Choose another file with --output.") from error
    print(f"Report    {output}")
    if options.pdf:
        print_pdf(output, text, output.with_suffix(".pdf"))
        print(f"          {output.with_suffix('.pdf')}")
    return 0
