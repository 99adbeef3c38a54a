#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documents name is there: check_docs.py [FILE.md ...]

Of README, ARCHITECTURE, CONVENTIONS and docs/ (or the given files) it checks
  - links to files of this repository, and to headings (#...);
  - paths and file names in `code`: `robotlink/match`, `docs/live.md`, `resources/**/*.json`, `skills.h`;
  - options in `code` and in blocks of commands: a program or a script of ours has to know `--debug-port`;
  - without files given, that every command of pitchboard-cli is shown by one of them, that every page has a picture,
    and that docs/building.md names the versions of libraries that CMakeLists.txt asks for.
Prints "file:line: what" for each that is not, and ends with 1. Example: scripts/check_docs.py docs/live.md
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCUMENTS = ["*.md", "docs/**/*.md"]
# Options of other programs that the documents show.
FOREIGN_OPTIONS = {
    "--preset", "--build", "--target", "--install", "--prefix", "--output-on-failure", "--parallel",
    "--recursive", "--array", "--version", "--help", "--benchmark_filter", "--no-install-recommends", "--test-dir",
    "--idle", "--file", "--tag", "--build-arg", "--now", "--benchmark_repetitions", "--benchmark_enable_random_interleaving", "--cflags", "--libs",
}
SOURCES = (".h", ".cpp", ".py", ".sh", ".json", ".md", ".mjs", ".txt", ".cmake", ".supp", ".dict", ".svg",
           ".png", ".bin", ".mcap")

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)")
CODE = re.compile(r"(?<!`)(`+)(?!`)(.+?)(?<!`)\1(?!`)")
PATH = re.compile(r"^(?:\./)?[\w.*-]+(?:/[\w.*{},-]+)*/?$")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9_-]+")


def tracked():
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "--cached", "--others", "--exclude-standard"],
                            check=True, capture_output=True, text=True).stdout.split("\n")
    return [name for name in listed if name and (ROOT / name).exists()]


FILES = tracked()
NAMES = {Path(name).name for name in FILES}
TOP = {name.split("/")[0] for name in FILES if "/" in name}


def own_options():
    """Every --option that our programs and scripts spell."""
    found = set()
    for name in FILES:
        if name.startswith(("app/", "scripts/", "docs/examples/")) or name in ("install", "run", "test"):
            if name.endswith((".bin", ".mcap", ".png")):
                continue
            text = (ROOT / name).read_text(encoding="utf-8", errors="replace")
            if name != "scripts/check_docs.py":
                found.update(OPTION.findall(text))
        if name.endswith(".cpp") and not name.startswith("tests/"):  # rows of tables of options
            rows = (ROOT / name).read_text(encoding="utf-8")
            found.update("--" + row for row in re.findall(r"\{\.name = \"([\w-]+)\"", rows))
    return found


def anchors(path):
    """The headings of a document as GitHub and others make anchors of them."""
    made, fenced = set(), False
    for line in path.read_text(encoding="utf-8").split("\n"):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        if fenced or not line.startswith("#"):
            continue
        words = re.sub(r"[`*]", "", line.lstrip("#").strip()).lower()
        made.add(re.sub(r"[^\w\- ]", "", words).replace(" ", "-"))
    return made


def expand(pattern):
    """`a/{b,c}.h` is two paths."""
    braces = re.search(r"\{([^{}]*)\}", pattern)
    if not braces:
        return [pattern]
    head, tail = pattern[:braces.start()], pattern[braces.end():]
    return [path for part in braces.group(1).split(",") for path in expand(head + part + tail)]


def is_there(name, document):
    for path in expand(name.removeprefix("./").rstrip("/")):
        below = [ROOT, document.parent]
        if "*" in path:
            if not any(any(base.glob(path)) for base in below):
                return False
        elif not any((base / path).exists() for base in below):
            # The path of an include: <robotlink/match/moment.h>
            if not any(file.endswith("/include/" + path) for file in FILES):
                return False
    return True


def link_problem(target, document):
    if re.match(r"^[a-z]+:", target):
        return None
    path, _, heading = target.partition("#")
    goal = (document.parent / path).resolve() if path else document
    if not goal.exists():
        return f"the link leads nowhere: {target}"
    if heading and goal.suffix == ".md" and heading not in anchors(goal):
        return f"no such heading: {target}"
    return None


def code_problem(code, document):
    """A path below a folder of ours, or the name of a source file."""
    if not PATH.match(code) or ".." in code:
        return None
    first = code.removeprefix("./").split("/")[0]
    if "/" in code.removeprefix("./").rstrip("/"):
        if first in TOP and not is_there(code, document):
            return f"no such file: {code}"
    elif code.startswith("./") and not is_there(code, document):
        return f"no such file: {code}"
    elif code.endswith((".h", ".cpp")) and "*" not in code and code not in NAMES:
        return f"no file of this name: {code}"
    return None


def check(document, options):
    problems, fence = [], None
    for number, line in enumerate(document.read_text(encoding="utf-8").split("\n"), 1):
        opening = re.match(r"^\s*```(\w*)", line)
        if opening:
            fence = None if fence is not None else opening.group(1)
            continue
        if fence is None:
            found = [link_problem(target, document) for target in LINK.findall(re.sub(CODE, "", line))]
            spans = [code for _, code in CODE.findall(line)]
            found += [code_problem(word, document) for span in spans for word in [span.split()[0]] if span.strip()]
        else:
            spans, found = ([line] if fence in ("", "sh", "bash", "console") else []), []
        for span in spans:
            found += [f"no program of ours has the option {option}" for option in OPTION.findall(span)
                      if option not in options and option not in FOREIGN_OPTIONS]
        problems += [f"{document.relative_to(ROOT)}:{number}: {problem}" for problem in found if problem]
    return problems


def commands_without_document():
    """A new command is not finished before a document shows how it is used."""
    everything = "\n".join(path.read_text(encoding="utf-8") for pattern in DOCUMENTS for path in ROOT.glob(pattern))
    for name in FILES:
        if not re.match(r"app/cli/\w+\.cpp$", name):
            continue
        source = (ROOT / name).read_text(encoding="utf-8")
        for command in re.findall(r"parent\.add_subcommand\(\s*\"([\w-]+)\"", source):
            # A command of a group stands behind the group: `pitchboard-cli blackboard dump`.
            if not re.search(rf"pitchboard-cli (?:[\w-]+ )?{command}\b", everything):
                yield f"{name}: no document shows `pitchboard-cli {command}`"


def pages_without_picture():
    for page in sorted(ROOT.glob("docs/*.md")):
        if "](images/" not in page.read_text(encoding="utf-8"):
            yield f"{page.relative_to(ROOT)}: no picture (scripts/docs_pictures.sh)"


def versions_not_in_table():
    """docs/building.md says which versions are needed, CMakeLists.txt asks for them."""
    table = dict(re.findall(r"\| ([\w.+-]+) \| ([\d.]+) (?=\|)", (ROOT / "docs/building.md").read_text(encoding="utf-8")))
    build = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    asked = dict(re.findall(r"(?:pitchboard_needs\(|IMPORTED_TARGET )([\w-]+?)(?: |>=)([\d.]+)", build))
    asked["CMake"] = re.search(r"cmake_minimum_required\(VERSION ([\d.]+)\)", build).group(1)
    for name, version in asked.items():
        if table.get(name) != version:
            yield f"docs/building.md: {name} {version} is needed (CMakeLists.txt), but its table says {table.get(name)}"


def main():
    if "--help" in sys.argv or "-h" in sys.argv:
        print(__doc__)
        return 0
    given = [Path(name).resolve() for name in sys.argv[1:]]
    documents = given or sorted(path for pattern in DOCUMENTS for path in ROOT.glob(pattern))
    options = own_options()
    problems = [problem for document in documents for problem in check(document, options)]
    if not given:
        problems += [*commands_without_document(), *pages_without_picture(), *versions_not_in_table()]
    print("\n".join(problems) if problems else f"{len(documents)} documents name nothing that is not there")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
