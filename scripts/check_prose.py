#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the prose of the project: Markdown, comments of C++ sources, docstrings of Python files, and comments of scenes.

    scripts/check_prose.py [--strings] [--worst N] [--limit R] [--total R] [PATH...]

PATH: files (.md, .h, .cc, .py, .prm) or directories. Default: README.md, CONTRIBUTING.md, doc, include, source, python, scripts, prm.
--strings: also checks string literals of .h and .cc files: messages, help texts, documentation of entries.
--worst N: number of places printed for each kind of finding, by default 10.
--limit R: exit status 1 if a file has more than R findings per 1,000 words.
--total R: exit status 1 if all files together have more than R findings per 1,000 words. Prints one line if they have fewer,
           otherwise the worst files.

Kinds of findings:
  long      sentence of more than 35 words
  para      paragraph of more than 120 words
  line      comment line of more than 120 characters (C++)
  phrase    phrase of the list PHRASES, with a suggestion
  people    person in place of a process
  double    two negations in one clause
  pronoun   sentence with more than three pronouns
  start     docstring that begins with a question word or a preposition

Not checked: code blocks, inline code, formulas, headings, block quotes. A Markdown file with the line
<!-- check_prose: skip --> is not read.
"""

import ast
import argparse
import collections
import pathlib
import re
import sys

MAX_SENTENCE, MAX_PARAGRAPH, MAX_LINE = 35, 120, 120
MAX_PRONOUNS = 3
ROOT = pathlib.Path(__file__).resolve().parent.parent
SUFFIXES = (".md", ".h", ".cc", ".py", ".prm")
DEFAULT = ("README.md", "CONTRIBUTING.md", "doc", "include", "source", "python", "scripts", "prm")
KINDS = ("long", "para", "line", "phrase", "people", "double", "pronoun", "start")

# (regular expression, suggestion). Words with a correct technical use are matched in their wrong context only.
PHRASES = [
    # base, foundation
    (r"\bfeet\b", "base nodes"),
    (r"\b(the|its|a|each|dam's|prescribed|heavier) foot\b", "base node; base of the dam; toe; heel"),
    (r"\bfoot of (the|a|joint|its)\b", "base of ..., heel, toe"),
    (r"\b(gives?|gave|giving) way\b", "deforms; is compliant; compliance"),
    (r"\brock's give\b|\bseats? (of \w+ )?gives?\b|\bseats that give\b|\bflanks give\b", "compliance; deforms"),
    (r"\b(led|leads?) (by|the dam)\b|\bwhat leads\b", "is driven by; prescribes the motion of the base nodes"),
    (r"\b(what|that) (the|a) (dam|dam's feet|feet) stands? on\b", "foundation; support"),
    (r"\bsteps? of (its|their) own\b|\bown steps?\b", "subcycling; own time step"),
    (r"\blooks? ahead\b|\blook-ahead\b", "predictor"),
    (r"\bways? of (the )?(crown|crest|S waves|P waves)|\bcrest's way\b", "displacement; travel path"),
    (r"\bthrows? (the )?(\w+ )?(\w+ )?back\b", "reflects"),
    # solvers
    (r"(?<![|+])\bsweeps?\b(?! of Gauss|-|\(|\|| \(Gauss)", "substitutions (linear solver); Gauss-Seidel iterations (contact)"),
    (r"\brounds\b", "iterations"),
    (r"\bsettles?\b|\bsettling\b", "converges; finds the static equilibrium (settlement only for ground)"),
    (r"\bgo(es)? on\b|\bgone on\b|\bwent on\b|\bgoing on\b", "continue; resume"),
    (r"\bwhat (is|was|has) left\b|\bleft over\b|\bwhat it leaves\b", "residual; remainder"),
    (r"\bpass(es)? over the factors\b", "forward and backward substitution"),
    (r"\bsteps? (that|which) (is|are|was|were) halved\b|\bhalved steps?\b", "step with reduced time step"),
    (r"\bmemory of (the )?(laws?|pairs?|other laws)\b|\blaws? (with|without) (a )?memory\b|\blaws' memory\b|"
     r"\bhas a memory\b", "history variables"),
    (r"\bis to be\b|\bare to be\b", "must be"),
    (r"\bcoupled by mean tractions?\b", "coupled by a traction constant over the dam's time step"),
    (r"\bproximal points\b", "proximal point method"),
    (r"\bstand-in\b", "substitute; approximation"),
    # parallel
    (r"\b(the )?same bits\b|\bto the last bit\b|\bother bits\b", "bitwise identical"),
    (r"\bshared? out\b|\bshares .{1,40} out\b", "distributed; partitioned"),
    (r"\b(all|every) rank'?s? (has|have|do|does) alike\b|\ball .{1,20} do alike\b", "replicated on every rank"),
    (r"\bhanded (in|on|out|to|over)\b", "passed; prescribed; given"),
    # report, messages
    (r"\b(is|are|was|be) told\b|\btold (of|by|how|from|to)\b|\btells? (what|how|which|whether|the)\b",
     "reported; printed; distinguished from"),
    (r"\bsays? (so|how|what|which|of|whether|why|it|otherwise|nothing|that)\b|\bsaid (so|of|where|above)\b",
     "states; reports; prints; shows"),
    (r"\b(has|have|had) to say\b|\bwhat .{1,30} (says?|said)\b", "reports; result"),
    (r"\bwarned of\b", "produces a warning"),
    (r"\bmends?\b|\bmended\b|\bmending\b", "fix; correct; remedy"),
    (r"\b(limits?|which|what|conditions?) (is|are) kept\b", "is satisfied"),
    (r"\bis kept (and|or|as|that)\b|\bare kept (and|or|as|that|to)\b", "is stored; is retained; is satisfied"),
    (r"\ba page of the manual\b", "manual page"),
    (r"\bstands? (in|at|on|for|there|behind|beside|below)\b|\bstood (in|at|for|with)\b",
     "is listed in; is printed at; denotes"),
    (r"\bin brackets\b", "in parentheses"),
    (r"\boff by\b|\boff from\b", "error of; differs by"),
    (r"\bat hand\b", "available"),
    (r"\bgood to a (third|factor)\b|\bto a (third|factor of)\b", "accurate to"),
    (r"\bthe (\w+ ){0,2}account (of energy|of energies|of the energies)\b|\benergy account\b|"
     r"\baccount of energy\b|\bthe account closes\b", "energy balance"),
    (r"\bput on\b|\bputs on\b", "applied; applies"),
    (r"\btak(e|es|en|ing) (off|away)\b", "subtract; remove"),
    (r"\bone word too many\b", "unexpected argument"),
    (r"\bneeds? .{1,20} after it\b", "requires a value"),
    (r"\bwish(es)?\b", "target; tolerance"),
    # exclusion, vague reference
    (r"\ball but\b", "all except; almost"),
    (r"\bbut for\b", "except for; apart from; up to"),
    (r"\bbut the \w+ (left|that)\b|\bhave but\b|\bhas but\b", "only"),
    (r"\bnothing but\b|\bnone but\b|\bno(thing)? else\b", "only"),
    (r"\bhardly\b", "almost no; rarely; little"),
    (r"\bas (ever|before)\b|\bas it will\b|\bthe former\b|\bof before\b", "unchanged; name the version or the value"),
    (r"\bbeside (the scene|the dam|them|others|it)\b", "in addition to; next to"),
    (r"\bmeanwhile\b", "in the meantime; name the event"),
    (r"\bthe (next|last) (section|point) but\b|\bnext but one\b", "name the section or the item"),
    (r"\bof (it|them|these|those|its|that) (the|a|all|each|is|are)\b", "name the noun"),
    (r"\bwhat (it|they|he|she) (misses|makes|makes of|gives|takes|takes off|owes|carries|leaves)\b", "name the quantity"),
    (r"\b(nothing|something|anything) (struck|happens|happened|moves|more)\b", "name the event"),
    (r"\bsuch that are\b|\bso many\b|\bof which there are\b", "state the number and the noun"),
    (r"\bby itself\b|\bof itself\b", "alone; automatically"),
    (r"\bat once\b", "immediately; simultaneously; in one call"),
    (r"\bfor ever\b", "indefinitely"),
    (r"\bin the mean\b", "on average"),
    (r"\bin small\b", "on a small scale"),
    (r"\bsome (25|ten|hundred|thousand|800)\b", "about"),
    (r"\bhas but\b|\bhave but\b", "has only"),
    (r"\bin (its|their|the paper's) (order|turn)\b", "in sequence"),
    (r"\bto its end\b|\bto the end\b", "to completion"),
    (r"\bbelow the (step|mesh|entry)\b", "smaller than"),
    (r"\bwhoever\b|\bwhosoever\b", "name the class or the user"),
]
PEOPLE = re.compile(
    r"\b(nobody|somebody|everybody|anybody|no one|someone|anyone|everyone)\b|"
    r"\bone (looks|asks|sees|has|wants|would|can)\b|\bwho (asks?|looks?|runs?|makes?|knows?|wants?|meets?|reads?)\b|"
    r"\b(the )?(program|run|rank|class|law|mesh|file|page|error|region|solver|rock|dam|scene|checkpoint|step)s? "
    r"(asks?|knows?|says?|speaks?|feels?|wants?|forgets?|remembers?|looks?|sees?|owes?|minds?)\b", re.I)
NEGATION = re.compile(r"\b(not|no|never|nor|nothing|none|neither|without|hardly|cannot|nobody|n't)\b", re.I)
START = re.compile(r"^(What|Of|Its|Who|Whose|How|Where|When|Whether|Those|That|As|For|From|With|Without|By|If|At|To|"
                   r"In|On|Is|Are|Does|Do|Has|Have|Must|Can)\b[^:]*[.:;]?")
PRONOUN = re.compile(r"\b(it|its|itself|they|them|their|theirs|those|these|that of|that by|that in|the same|the other|"
                     r"the others|one of them|such)\b", re.I)
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|cf|vs|approx|Fig|Figs|Eq|Eqs|No|Sec|Dr|et al|resp|J|Appl|Mech|Proc|Vol|ed)\.\s")

Place = collections.namedtuple("Place", "file line kind text")
Block = collections.namedtuple("Block", "line text doc")  # doc: the block is a docstring


def words(text):
    """Words with at least one letter; numbers and operators do not count."""
    return [word for word in text.split() if re.search(r"[A-Za-z]", word)]


def sentences(text):
    text = ABBREVIATIONS.sub(lambda match: match.group(0).replace(". ", ".\x00"), text)
    text = re.sub(r"; (?=[\w-]+( [\w-]+)?: )", ". @", text)  # "name: text; name: text" are two sentences
    for part in re.split(r"(?<=[.!?])[\"')\]]?\s+(?=[\"'(\[`*]*[A-Z0-9@`])", text):
        yield part.replace("\x00", " ")


def clean(text):
    """The text without links, images, inline code, emphasis and formulas."""
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", " ", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"<[^>]{1,80}>", " ", text)
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"\$[^$]{1,120}\$", "FORMULA", text)
    text = re.sub(r"@[pcae] (\S+)", r"\1", text)
    text = re.sub(r"@(brief|return|throws?|param(\[\w+\])?|tparam|note|ref)\b", " ", text)
    text = text.replace("**", "").replace("*", " ")
    return re.sub(r"\s+", " ", text).strip()


def markdown_blocks(lines):
    block, first, fenced, before_blank, in_list = [], 0, False, True, False
    for number, line in enumerate(lines + [""], 1):
        stripped = line.strip()
        if stripped.startswith(("```", "~~~")):
            fenced = not fenced
            stripped, line = "", ""
        indented = line.startswith(("    ", "\t")) and before_blank and not in_list
        is_item = bool(re.match(r"\s*([-*+]|\d+\.)\s", line))
        ends = fenced or indented or not stripped or is_item or stripped.startswith(("#", "|", ">", "<!--"))
        if ends and block:
            yield Block(first, " ".join(block), False)
            block = []
        if stripped.startswith("|") and not fenced:
            for cell in re.split(r"(?<!\\)\|", stripped.strip("|")):
                if not re.fullmatch(r"[\s:-]*", cell):
                    yield Block(number, cell.strip(), False)
        elif not ends or (is_item and not fenced and not indented):
            if not block:
                first = number
            block.append(re.sub(r"^\s*([-*+]|\d+\.)\s+", "", line).strip())
        before_blank = not stripped or indented
        if stripped:
            in_list = is_item or (in_list and line.startswith((" ", "\t")))


def without_comments_of_html(text):
    return re.sub(r"<!--.*?-->", lambda match: "\n" * match.group(0).count("\n"), text, flags=re.S)


TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"\w*\(.*?\)\w*"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)


def cpp_blocks(text, with_strings):
    """Comments, consecutive // lines joined; with_strings: also adjacent string literals, joined."""
    found = []  # kind, first line, last line, column, text
    for match in TOKEN.finditer(text):
        token, line = match.group(0), text.count("\n", 0, match.start()) + 1
        column = match.start() - text.rfind("\n", 0, match.start())
        if token.startswith("//"):
            kind, body = ("trail" if token.startswith("///<") else "line"), re.sub(r"^//[/!]?<?", "", token).strip()
        elif token.startswith("/*"):
            body = re.sub(r"^/\*[*!]?<?|\*/$", "", token)
            body = re.sub(r"\n\s*\*(?!\*)", "\n", body)
            kind = "block"
        elif token.startswith('"') and with_strings:
            kind, body = "string", token[1:-1].replace("\\n", " ").replace('\\"', '"')
        else:
            continue
        if re.search(r"SPDX|clang-format|NOLINT|shellcheck", body):
            continue
        last = line + token.count("\n")
        if found and kind in ("line", "trail") and found[-1][0] == kind and found[-1][2] == line - 1 \
                and (kind == "line" or abs(found[-1][3] - column) < 2) \
                and not text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip():
            found[-1][2], found[-1][4] = line, found[-1][4] + " " + body
        elif found and kind == "string" and found[-1][0] == "string" and \
                not text[found[-1][5]:match.start()].strip():
            found[-1][2], found[-1][4], found[-1][5] = last, found[-1][4] + body, match.end()
        else:
            found.append([kind, line, last, column, body, match.end()])
    for kind, line, _, _, body, _ in found:
        if kind == "string" and len(words(body)) < 4:
            continue
        for paragraph in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d\.|@\w+) )", body):
            if words(paragraph):
                yield Block(line, paragraph, kind in ("block", "trail"))
                kind = "rest"


def paragraphs(line, text):
    """Blocks of a docstring. Indented lines are commands and tables: they are not read."""
    text = re.sub(r"(?m)^\s+\S.*$", "", text)
    is_first = True
    for paragraph in re.finditer(r"(?:[^\n]+\n?)+", text):
        for part in re.split(r"\n(?=(?:[-*]|\d\.) |[\w/, -]{1,30}: )", paragraph.group(0)):
            yield Block(line + text.count("\n", 0, paragraph.start()), part, is_first)
            is_first = False


def python_blocks(text):
    """Docstrings of modules, classes and functions."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)) and ast.get_docstring(node):
            yield from paragraphs(node.body[0].lineno, ast.get_docstring(node))


def scene_blocks(text):
    """Comments of a scene, consecutive lines joined."""
    block, first = [], 0
    for number, line in enumerate(text.split("\n") + [""], 1):
        comment = line.strip()[1:].strip() if line.strip().startswith("#") else ""
        if not comment or re.match(r"set \w|subsection |SPDX|include ", comment):
            if block:
                yield Block(first, " ".join(block), False)
            block = []
        else:
            first = first if block else number
            block.append(comment)
        if not comment and "#" in line:
            yield Block(number, line[line.index("#") + 1:].strip(), False)


def blocks_of(path, with_strings):
    """Text blocks of a file, or None if the file is skipped."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix in (".h", ".cc"):
        return list(cpp_blocks(text, with_strings))
    if path.suffix == ".py":
        return list(python_blocks(text))
    if path.suffix == ".prm":
        return list(scene_blocks(text))
    if "<!-- check_prose: skip -->" in text:
        return None
    return list(markdown_blocks(without_comments_of_html(text).split("\n")))


def check(path, name, with_strings):
    """Counts and places of the findings in a file."""
    blocks = blocks_of(path, with_strings)
    if blocks is None:
        return None
    count, places, phrases, n_words = collections.Counter(), [], collections.Counter(), 0

    def find(kind, line, shown):
        count[kind] += 1
        places.append(Place(name, line, kind, shown))

    for block in blocks:
        prose = clean(block.text)
        length = len(words(prose))
        n_words += length
        if length > MAX_PARAGRAPH:
            find("para", block.line, f"{length} words: {prose[:110]}")
        if block.doc and START.match(prose):
            find("start", block.line, prose[:110])
        for sentence in sentences(prose):
            n = len(words(sentence))
            if n > MAX_SENTENCE:
                find("long", block.line, f"{n} words: {sentence[:110]}")
            n = len(PRONOUN.findall(sentence))
            if n > MAX_PRONOUNS:
                find("pronoun", block.line, f"{n}: {sentence[:110]}")
            for clause in re.split(r"[,;:()]|\bbut\b|\band\b|\bor\b", sentence):
                negations = list(NEGATION.finditer(clause))
                if len(negations) > 1 and len(clause[negations[0].end():negations[1].start()].split()) < 9:
                    find("double", block.line, clause.strip()[:110])
        for match in PEOPLE.finditer(prose):
            find("people", block.line, context(prose, match))
        for pattern, suggestion in COMPILED:
            for match in pattern.finditer(prose):
                find("phrase", block.line, f"{context(prose, match)}  ->  {suggestion}")
                phrases[match.group(0).lower()] += 1
    if path.suffix in (".h", ".cc"):
        for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").split("\n"), 1):
            if len(line) > MAX_LINE and re.search(r"//|/\*|^\s*\*", line):
                find("line", number, f"{len(line)} characters")
    return count, places, phrases, n_words


def context(prose, match):
    return "..." + prose[max(0, match.start() - 30):match.start()] + "[" + match.group(0) + "]" + \
        prose[match.end():match.end() + 30]


COMPILED = [(re.compile(pattern, re.I), suggestion) for pattern, suggestion in PHRASES]


def files_of(paths):
    for path in paths:
        if path.is_dir():
            yield from sorted(file for file in path.rglob("*") if file.suffix in SUFFIXES)
        elif path.exists():
            yield path


def row_of(name, count, n_words):
    total = sum(count.values())
    return f"{name[-52:]:52} {n_words:7}" + "".join(f"{count[kind]:7}" for kind in KINDS) + f"{total:7} {rate(count, n_words):7.1f}"


def rate(count, n_words):
    """Findings per 1,000 words."""
    return 1000. * sum(count.values()) / max(n_words, 1)


def print_places(places, phrases, worst):
    for kind in KINDS:
        of_kind = [place for place in places if place.kind == kind]
        if kind in ("long", "para", "line", "pronoun"):
            of_kind.sort(key=lambda place: -int(re.match(r"\d+", place.text).group(0)))
        if of_kind:
            print(f"\n{kind}: {len(of_kind)}")
            for place in of_kind[:worst]:
                print(f"  {place.file}:{place.line}: {place.text}")
    if phrases:
        print("\nphrases: " + ", ".join(f"{name} {n}" for name, n in phrases.most_common(40)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", nargs="*", type=pathlib.Path)
    parser.add_argument("--worst", type=int, default=10, help="number of places printed for each kind")
    parser.add_argument("--strings", action="store_true", help="also checks string literals of C++ sources")
    parser.add_argument("--limit", type=float, help="largest number of findings per 1,000 words of a file")
    parser.add_argument("--total", type=float, help="largest number of findings per 1,000 words of all files")
    arguments = parser.parse_args()
    rows, places, phrases = [], [], collections.Counter()
    whole, n_whole = collections.Counter(), 0
    for file in files_of(arguments.path or [ROOT / name for name in DEFAULT]):
        name = str(file.relative_to(ROOT) if file.is_relative_to(ROOT) else file)
        result = check(file, name, arguments.strings)
        if result is None:
            continue
        count, found, used, n_words = result
        rows.append((name, count, n_words))
        places += found
        phrases += used
        whole += count
        n_whole += n_words
    summary = f"prose: {rate(whole, n_whole):.1f} findings per 1,000 words, {sum(whole.values())} in {n_whole} words"
    if arguments.total is not None and rate(whole, n_whole) <= arguments.total:
        print(summary)
    else:
        print(f"{'file':52} {'words':>7}" + "".join(f"{kind:>7}" for kind in KINDS) + f"{'total':>7} {'/1000':>7}")
        with_findings = sorted((row for row in rows if row[1]), key=lambda row: -sum(row[1].values()))
        for row in with_findings[:None if arguments.total is None else 20]:
            print(row_of(*row))
        print(row_of("ALL", whole, n_whole))
        if arguments.worst:
            print_places(places, phrases, arguments.worst)
    failed = False
    if arguments.total is not None and rate(whole, n_whole) > arguments.total:
        print(f"\n{summary}; at most {arguments.total:g} are allowed. Reword the places above.", file=sys.stderr)
        failed = True
    too_many = [name for name, count, n_words in rows
                if arguments.limit is not None and sum(count.values()) > arguments.limit * max(n_words, 200) / 1000.]
    if too_many:
        print(f"\nmore than {arguments.limit:g} findings per 1,000 words: " + ", ".join(too_many), file=sys.stderr)
        failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
