#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the site: README, tutorials, all pages of doc/ and examples/, with search (MkDocs with the theme Material, Debian:
mkdocs-material).

    scripts/site.py [--output build/site]

A link to a page or figure that is not there is an error, and so is a page without a place in NAVIGATION.
`python3 -m http.server -d build/site` shows the site. The search needs a server.
"""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OTHERS = ("CONTRIBUTING.md", "CITATION.cff", "LICENSE")
MATHJAX = Path("/usr/share/javascript/mathjax")
NAVIGATION = {  # pages of doc/, in this order; index: README, pages: doc/index.md
    "Start": ("index", "install", "tutorials/1_first_run", "limits", "comparison", "read_results", "pages"),
    "How-to": ("tutorials/2_own_dam", "accuracy", "needs", "tutorials/3_own_records", "ensembles", "studies", "report",
               "messages", "parallel"),
    "Reference": ("input_file", "generated/entries", "generated/commands", "output", "generated/columns", "mesh", "loads", "python",
                  "base_joints", "generated/refused_pairs", "generated/messages", "glossary", "changes"),
    "Examples": ("examples/README", *(f"examples/{name}/README" for name in ("first_run", "own_dam", "keys", "base_joint", "rock", "water", "ensemble",
                                                                             "koyna", "snap_back", "bricks"))),
    "Theory": ("method", "water", "keys", "rock", "boundary", "damping"),
    "Evidence": ("verification", "performance", "paper", "failures"),
    "Develop": ("CONTRIBUTING", "tutorials/4_own_law", "release"),
}


def title_of(page):
    """The first heading."""
    return next(line[2:].strip() for line in page.read_text(encoding="utf-8").splitlines() if line.startswith("# "))


def stage_examples(pages):
    """The pages and figures of examples/, each page with its input file."""
    shutil.copytree(ROOT / "examples", pages / "examples", ignore=shutil.ignore_patterns("*.py", "*.prm", "*.csv"))
    for page in (pages / "examples").glob("*/README.md"):
        scene = (ROOT / page.relative_to(pages)).with_name("scene.prm").read_text(encoding="utf-8")
        text = page.read_text(encoding="utf-8").replace("](../../doc/", "](../../")
        page.write_text(f"{text}\n## scene.prm\n\n```\n{scene}```\n", encoding="utf-8")


def stage(pages):
    """All pages as the site has them: README is the first one, what the sources alone have is named, not linked."""
    shutil.copytree(ROOT / "doc", pages, ignore=shutil.ignore_patterns("Doxyfile.in", "mainpage.md", "*.csv"))
    (pages / "index.md").rename(pages / "pages.md")
    readme = (ROOT / "README.md").read_text(encoding="utf-8").replace("](doc/", "](").replace("](index.md)", "](pages.md)")
    (pages / "index.md").write_text(readme, encoding="utf-8")
    for name in OTHERS:
        shutil.copy(ROOT / name, pages / name)
    stage_examples(pages)
    for page in pages.rglob("*.md"):
        text, here = page.read_text(encoding="utf-8"), page.parent

        def link(match, here=here):
            target = match[2].split("#")[0]
            if "://" in target or not target or (here / target).is_file():
                return match[0]
            if (here / target / "README.md").is_file():
                return f"[{match[1]}]({target}/README.md)"
            if any((ROOT / top / target).exists() for top in ("", here.relative_to(pages), "doc" / here.relative_to(pages))):
                return f"`{match[1]}`"  # a file of the sources
            return match[0]

        text = re.sub(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)", link, text.replace("](../../CONTRIBUTING.md)", "](../CONTRIBUTING.md)")
                      .replace("](doc/", "](").replace("](../examples", "](examples").replace("](../../examples", "](../examples"))
        page.write_text(text, encoding="utf-8")


def check_navigation(pages):
    """Ends with a message if NAVIGATION and the pages differ."""
    listed = [name for names in NAVIGATION.values() for name in names]
    found = {page.relative_to(pages).with_suffix("").as_posix() for page in pages.rglob("*.md")}
    for names, text in ((found - set(listed), "not in NAVIGATION"), (set(listed) - found, "in NAVIGATION, but not in doc/"),
                        ({name for name in listed if listed.count(name) > 1}, "more than once in NAVIGATION")):
        if names:
            sys.exit(f"site: these pages are {text} (scripts/site.py): {', '.join(sorted(names))}.")


def formulas(pages):
    """Copies the part of MathJax that draws formulas. Without it, the site has their source text."""
    if not MATHJAX.is_dir():
        print("site: formulas stay text (on Debian: apt-get install libjs-mathjax).", file=sys.stderr)
        return
    for name in ("MathJax.js", "config/TeX-AMS_CHTML.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/CommonHTML",
                 "fonts/HTML-CSS/TeX/woff"):
        (shutil.copytree if (MATHJAX / name).is_dir() else shutil.copy)(MATHJAX / name, made(pages / "mathjax" / name))
    (pages / "formulas.js").write_text('window.MathJax = {tex2jax: {inlineMath: [["\\\\(", "\\\\)"]], displayMath: [["\\\\[", "\\\\]"]]}, '
                                       'messageStyle: "none", menuSettings: {zoom: "None"}};\n', encoding="utf-8")


def made(path):
    """The path, whose directory now exists."""
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def configuration(directory, pages):
    """mkdocs.yml with the pages of NAVIGATION."""
    check_navigation(pages)
    nav = [{part: [{"Voussoir" if name == "index" else title_of(pages / f"{name}.md"): f"{name}.md"} for name in names]} for part, names in NAVIGATION.items()]
    text = {"site_name": "Voussoir", "docs_dir": str(pages), "nav": nav, "use_directory_urls": False,
            "theme": {"name": "material", "font": False, "features": ["navigation.sections"]},  # no fonts from the network
            "plugins": [{"search": {"separator": r"[\s\-/]+"}}],  # the words of Section/Entry
            "markdown_extensions": [{"pymdownx.arithmatex": {"generic": True}}],
            "extra_javascript": ["formulas.js", "mathjax/MathJax.js?config=TeX-AMS_CHTML"] if MATHJAX.is_dir() else [],
            "extra_css": ["tables.css"]}
    formulas(pages)
    (pages / "tables.css").write_text("thead:not(:has(th:not(:empty))) { display: none; }\n"
                                      "div.arithmatex { overflow-x: auto; }\n"
                                      "@media (max-width: 600px) { .md-typeset table:not([class]) :is(th, td) { min-width: 0; padding: .5em; } }\n",
                                      encoding="utf-8")
    path = directory / "mkdocs.yml"
    path.write_text(json.dumps(text, indent=1), encoding="utf-8")  # JSON is YAML
    return path


def has_theme():
    """True if MkDocs is installed and lists the theme. The theme readthedocs of Debian 12 lacks the files of its search."""
    if shutil.which("mkdocs") is None:
        return False
    return "material" in subprocess.run(["mkdocs", "build", "--help"], capture_output=True, text=True, check=False).stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--output", default=ROOT / "build" / "site", type=Path)
    options = parser.parse_args()
    if not has_theme():
        sys.exit("site: MkDocs or its theme Material is not there (on Debian: apt-get install mkdocs-material).")
    with tempfile.TemporaryDirectory() as temporary:
        directory = Path(temporary)
        stage(directory / "pages")
        yml = configuration(directory, directory / "pages")
        return subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--config-file", str(yml), "--site-dir", str(options.output.resolve())],
                              check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
