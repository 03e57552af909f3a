#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the whole tree: budgets of lines and words, files that pages name, one version number, doc/generated/columns.md, the licence in
each source, and how many sources and headers reach the grids of deal.II.

    scripts/check_tree.py

A budget goes down with each deletion: lower it then. A contribution may raise it by its own lines and words. Exit status 1 if a check fails."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUDGETS = {"lines of C++ in source and include": 65391, "words of pages written by hand": 31527,
           "sources that include grids of deal.II": 28, "headers that include grids of deal.II": 5}
TOPS = "benchmarks|cmake|container|doc|examples|include|meshes|packaging|prm|python|scripts|source|studies|tests"
ROOMS = "app|base|contact|dam|dynamics|foundation|joints|mesh|motion|output|rock|solid|water"
GRIDS = re.compile(r"#include <(deal\.II/(grid|dofs|fe|numerics)/[^>]*|voussoir/solid/(solid_grid|for_faces|cell_elasticity|triangulation)\.h)>")


def tracked(*patterns):
    """Files of the repository, also new ones, that match a pattern of git."""
    names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns], cwd=ROOT, capture_output=True,
                           text=True, check=True).stdout.split("\n")
    return [ROOT / name for name in sorted(set(names)) if name and (ROOT / name).is_file()]


def counts(cpp, pages):
    """The numbers of BUDGETS, in its order."""
    def with_grids(suffix):
        return sum(1 for path in cpp if path.suffix == suffix and GRIDS.search(path.read_text()))
    by_hand = [page for page in pages if "generated" not in page.parts]
    return [sum(path.read_bytes().count(b"\n") for path in cpp), sum(len(page.read_text().split()) for page in by_hand),
            with_grids(".cc"), with_grids(".h")]


def unknown_files(pages):
    """Names of files in pages that do not exist. Capitals, * and ... stand for any name."""
    for page in pages:
        if page.name == "changes.md":
            continue
        for name in re.findall(rf"(?<![\w/.-])((?:{TOPS})/[\w./*-]*\w\.(?:cc|h|py|sh|prm|msh|md|csv|txt|json|png|cmake)|"
                               rf"(?:{ROOMS})/[\w*]*\w\.(?:cc|h))\b", page.read_text()):
            if re.search(r"[A-Z]{3}|\*|\.\.\.", name):
                continue
            places = [ROOT / name, page.parent / name, ROOT / "source" / name, ROOT / "include/voussoir" / name]
            if not any(place.exists() for place in places):
                yield f"{page.relative_to(ROOT)} names {name}, which does not exist"


def broken_links(pages):
    """Links of pages to files and headings that do not exist."""
    def anchors(page):
        text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.S | re.M)
        heads = (re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", head) for head in re.findall(r"^#+ (.*)", text, re.M))
        return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}
    for page in pages:
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", page.read_text())):
            name, _, anchor = target.partition("#")
            path = page.parent / name if name else page
            if "://" not in target and not (path.exists() and (not anchor or anchor in anchors(path))):
                yield f"{page.relative_to(ROOT)} links {target}, which does not exist"


def unlisted_pages(pages):
    """Pages of doc/ that doc/index.md does not link."""
    index = (ROOT / "doc/index.md").read_text()
    for page in pages:
        name = page.relative_to(ROOT / "doc").as_posix() if ROOT / "doc" in page.parents else "index.md"
        if name != "index.md" and f"]({name}" not in index:
            yield f"doc/index.md does not link {name}"


def unknown_entries(pages):
    """Entries of the input file that pages name and doc/generated/entries.md does not have. changes.md may name old entries;
    studies have entries of their own."""
    known = set(re.findall(r"^\| `([^`]+)`", (ROOT / "doc/generated/entries.md").read_text(), re.M))
    sections = {name.split("/")[0] for name in known}
    for page in pages:
        for name in re.findall(r"""(?:`|--set '?)([A-Z]\w+/[^`'=\n]*?)(?:\\? )?(?:[`'=]| = )""", page.read_text()):
            name = name.replace("\\ ", " ")
            if name.split("/")[0] in sections and page.name not in ("changes.md", "studies.md") and "..." not in name and "*" not in name \
                    and not any(entry == name or entry.startswith(f"{name}/") for entry in known):
                yield f"{page.relative_to(ROOT)} names the entry {name}, which does not exist"


def unknown_messages():
    """Messages that doc/messages.md quotes (`...`, N: any text) and no source has."""
    text = "\n".join(path.read_text() for path in tracked("source/*.cc", "python/*.py"))
    text = re.sub(r'"\s*\n\s*f?"', "", text)  # adjacent literals
    for row in re.findall(r"^\| (`.*?) \|", (ROOT / "doc/messages.md").read_text(), re.M):
        for part in re.split(r"`, `|`|\.\.\.|\bN\b", row):
            if len(part.strip()) > 5 and part.strip() not in text:
                yield f"doc/messages.md quotes \"{part.strip()}\", which no source has"


def other_versions():
    """Files that state another version than CMakeLists.txt."""
    version = re.search(r"project\(voussoir VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    for name, pattern in (("README.md", r"The version is ([\d.]*\d)"), ("CITATION.cff", r"(?m)^version: ([\d.]+)"),
                          ("python/pyproject.toml", r'(?m)^version = "([\d.]+)"'), ("packaging/conda/meta.yaml", r'set version = "([\d.]+)"'),
                          ("packaging/debian/changelog", r"^voussoir \(([\d.]+)-")):
        found = re.search(pattern, (ROOT / name).read_text())
        if not found or found.group(1) != version:
            yield f"{name} states the version {found.group(1) if found else 'nowhere'}, CMakeLists.txt {version}"


def main():
    cpp = tracked("source/*.cc", "source/*.h", "include/*.h")
    pages = tracked("README.md", "CONTRIBUTING.md", "doc/*.md")
    errors = []
    for (what, budget), count in zip(BUDGETS.items(), counts(cpp, pages)):
        print(f"tree: {count} {what} (budget {budget})")
        if count > budget:
            errors.append(f"{count} {what}, more than {budget}. Delete what the change made superfluous")
    errors += unknown_files(pages)
    by_hand = [page for page in pages if "generated" not in page.parts]
    errors += broken_links(pages)
    errors += unlisted_pages(pages)
    errors += unknown_entries(by_hand + tracked("examples/*.md", "benchmarks/*.md"))
    errors += unknown_messages()
    errors += other_versions()
    checked = subprocess.run([sys.executable, ROOT / "scripts" / "reference.py", "--check"], capture_output=True, text=True, check=False)
    errors += checked.stderr.splitlines()
    errors += [f"{path.relative_to(ROOT)} does not state its licence in the first lines (SPDX)"
               for path in tracked("*.cc", "*.h", "*.py", "*.sh", "*.cmake", "*CMakeLists.txt")
               if "SPDX-License-Identifier" not in "".join(path.read_text().splitlines(True)[:3])]
    for error in errors:
        print(f"tree: {error}", file=sys.stderr)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
