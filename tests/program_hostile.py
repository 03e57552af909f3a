#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of `voussoir report` with the directory of another person, whose files hold text that would be a part of the page.

    program_hostile.py VOUSSOIR CASE...

The browser is a headless Chromium; where there is none its case is skipped (status 77), and says so.
"""

import contextlib
import copy
import csv
import io
import json
import shutil
import sys
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

from browser import Browser, find_browser
from many_motions import many_motions, rows_of, write_rows
from program_report import LIMITS, Reader
from voussoir import report_view3d as view3d
from run_program import expect, refused, run_cases, runs, settings, summary, voussoir, write_scene

SCRIPTS = view3d.libraries()[0]  # of the view
HOSTILE = """"'></title></style></td><script>document.write('<a href="https://ran.invalid/">x</a>')</script><iframe src="{}"></iframe><x-hostile onload=ran()>&lt;"""


def hostile_run(target="file:///etc/hostname"):
    """The output directory of a run whose files another person has changed: hostile text wherever a report shows a text."""
    write_scene("scene.prm", LIMITS)
    runs("scene.prm", "--output", "sound", "--overwrite", *settings("Joints/Friction=0.3", "Joints/Model=KSM", "Limits/Key shear stress=1 MPa",
                                                                    "Limits/Base friction=1", "Limits/Sliding safety=1.3"))
    text, found = HOSTILE.format(target), summary("sound")
    directory = Path('<img src=x onerror=ran()>"' + "'")
    shutil.rmtree(directory, ignore_errors=True)
    shutil.copytree("sound", directory)
    found = {key: text + value if isinstance(value, str) else value for key, value in found.items()}
    found["blocks"] = {f"monolith {text}{name}": block for name, block in found["blocks"].items()}
    found["extremes"][f"max_{text}"] = {"value": 1.}
    found["limits"][text] = {"value": 2., "limit": 1., "satisfied": False}
    found["limits_not_evaluated"] = {text: text}
    found["warnings"] = [text, "half a character: \ud800"]
    found[text] = found["mesh"][text] = text
    (directory / "summary.json").write_text(json.dumps(found))
    for path in directory.glob("*.csv"):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        names = [name + text if name.startswith("safety_") else name for name in rows[0]] + [f"opening_{text}" if "joint" in path.name else text]
        with open(path, "w", newline="") as file:
            csv.writer(file).writerows([names, *(row + row[-1:] for row in rows[1:])])
    scene = (directory / "scene.prm").read_text()
    (directory / "scene.prm").write_text(scene + f"subsection {text}\n  set {text} = {text} # default: {text}\nend\n")
    log = (directory / "log.txt").read_bytes()
    (directory / "log.txt").write_bytes(f"Joints    {text}\nFaults    {text}\n".encode() + b"Bytes     \xff\xfe\n" + log)
    return directory, text


def report_of(*arguments):
    """It is made; matplotlib may complain about names that are longer than its figures."""
    result = voussoir("report", *arguments)
    expect(result.returncode == 0 and "Traceback" not in result.stderr, f"status {result.returncode}: {result.stderr[-2000:]}")


def harmless(path):
    """The page's text; nothing in it is an element or an attribute of someone else, and its policy forbids what would be."""
    read, html = Reader(path), Path(path).read_text(encoding="utf-8")
    expect(all(kind == "application/json" or text in SCRIPTS for kind, text in read.scripts), f"{path} has a script of someone else")
    expect(not read.tags & {"iframe", "x-hostile", "onload", "onerror", "style=", "base", "form"}, f"{path} has {read.tags}")
    expect(all(address.startswith("data:") for address in read.addresses), f"{path} asks for something outside of it")
    policy = html[html.index("Content-Security-Policy"):].partition(">")[0]
    expect(html.index("Content-Security-Policy") < html.index("<title>") and "default-src 'none'" in policy and "unsafe" not in policy, policy)
    return read.text


def page():
    """Text of files that would be a script, an image or a frame of the page stands there as text: all of it at once, and then in each value
    and each name of summary.json by itself. Thousands of pages, without figures."""
    directory, text = hostile_run()
    from voussoir import report
    from voussoir.runs import Skip
    report.view3d.section = lambda *_: None
    report.figures = type("Figures", (), {"DIRECTIONS": report.figures.DIRECTIONS, "__getattr__": lambda self, name: no_figure(Skip)})()
    for words in ((str(directory),), (str(directory), "sound")):
        expect(page_of(report, words, f"{words}"), "the run of another person is refused")
        # Version, revision, deal.II, law and scene; name of a monolith, extreme and limit; warning; entry and its value; log
        shown = harmless("page.html").count("<x-hostile onload=ran()>&lt;")
        expect(shown > 20, f"the text is on the page {shown} times")
    hostile_motions(report, text)
    found, counts = summary("sound"), {"shown": 0, "refused": 0}
    shutil.copytree("sound", "field")
    for path in places(found):
        for change in ("value", "dictionary", "name", "number"):
            changed = copy.deepcopy(found)
            inner = changed
            for key in path[:-1]:
                inner = inner[key]
            if change == "name":
                if not isinstance(inner, dict):
                    continue
                inner[path[-1] + text] = inner.pop(path[-1])
            else:
                inner[path[-1]] = {"value": text, "dictionary": {text: text}, "number": 10**400}[change]
            Path("field/summary.json").write_text(json.dumps(changed))
            counts["shown" if page_of(report, ("field",), f"{change} of {path}") else "refused"] += 1
    print(f"    one field changed: {counts}")
    expect(min(counts.values()) > 50, f"{counts}")
    Path("field/summary.json").write_text('{"extremes":' + "[" * 100000 + "]" * 100000 + "}")
    refused(["report", "field"], "Repeat the run")


def hostile_motions(report, text):
    """Many motions whose names, states and extremes are hostile text."""
    many_motions("sound", "many", n=4, factors=(1., 2.), failed=(2,))
    rows, found = rows_of("many/ensemble.csv"), summary("many")
    write_rows("many/ensemble.csv", [row | {"name": text, "status": text if row["status"] != "ok" else "ok", f"max_{text}": 1.} for row in rows])
    found["ensemble"] |= {"names": [text] * 4, f"max_{text}": found["ensemble"]["max_slip"], "motions_above_limit": {text: 1}}
    (Path("many") / "summary.json").write_text(json.dumps(found))
    expect(page_of(report, ("many",), "many motions") and page_of(report, ("many", "sound"), "many motions and a run"), "many motions are refused")
    expect(harmless("page.html").count("<x-hostile onload=ran()>&lt;") > 5, "the text is not on the page of many motions")


def figures():
    """The same with all figures, by the program."""
    directory, _ = hostile_run()
    report_of(str(directory), "sound", "--output", "page.html")
    harmless("page.html")
    expect(len(Reader("page.html").images) > 10, "figures are missing")


def no_figure(skip):
    def make(*_):
        raise skip("not drawn")
    return make


def places(value, path=()):
    """Paths to all entries of nested dictionaries, and to the first of lists."""
    entries = value.items() if isinstance(value, dict) else list(enumerate(value))[:1] if isinstance(value, list) else ()
    for key, inner in entries:
        yield (*path, key)
        yield from places(inner, (*path, key))


def page_of(report, words, what):
    """Is page.html made? It is harmless, or the run is refused in the program's words."""
    sys.argv = ["report", *words, "--output", "page.html"]
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        try:
            report.main()
        except report.InputError as error:
            expect("Repeat the run" in str(error), f"{what}: {error}")
            return False
    harmless("page.html")
    return True


def pdf():
    """Printing runs no script, shows no file and asks for nothing in the network, even if the page were to ask for it."""
    if find_browser() is None:
        print("SKIPPED: no Chromium, so no page is printed (on Debian: apt-get install chromium)")
        sys.exit(77)
    asked = []

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            asked.append(self.path)
            self.send_error(404)

    server = HTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}/"
    secret = Path("secret.html")
    secret.write_text('<a href="https://secret.invalid/">secret</a>')
    directory, _ = hostile_run(secret.resolve().as_uri())
    report_of(str(directory), "--pdf", "--output", "page.html")
    links_of("page.pdf", plain=False)
    with Browser() as chromium:
        chromium.open(Path("page.html"), 794)
        expect(chromium.value("document.querySelectorAll('iframe, x-hostile').length") == 0, "elements of another person")
        expect(chromium.value("document.scripts.length") == len(Reader("page.html").scripts), "scripts of another person")
        expect(not chromium.complaints(), f"{chromium.complaints()}")
    from voussoir.chromium import print_page
    Path("bare.pdf").write_bytes(print_page(
        f'<!DOCTYPE html><meta http-equiv="refresh" content="0; url={secret.resolve().as_uri()}">{HOSTILE.format(secret.resolve().as_uri())}'
        f'<object data="{secret.resolve().as_uri()}"></object><img src="{address}image"><link rel="stylesheet" href="{address}style">'
        f'<iframe src="{address}frame"></iframe><img src=x onerror="document.write(1)"><p><a href="https://plain.invalid/">plain</a>'))
    links_of("bare.pdf", plain=True)
    server.shutdown()
    expect(not asked, f"the network was asked for {asked}")


def links_of(pdf, plain):
    """Links of a PDF: none that a script wrote, none of the file beside it."""
    data = Path(pdf).read_bytes()
    expect(data[:5] == b"%PDF-" and len(data) > 5000, f"{pdf} is no PDF")
    for name, there in (("ran", False), ("secret", False), ("plain", plain)):
        expect((f"/URI (https://{name}.invalid/)".encode() in data) == there, f"{pdf}: the link {name}.invalid is {'missing' if there else 'there'}")


if __name__ == "__main__":
    run_cases(page, figures, pdf)
