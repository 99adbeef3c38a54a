#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Follows a page of the documents to the letter: tst_pages.py PAGE FOLDER_OF_PROGRAMS

Blocks of the page are carried out in their order, in an empty folder:
  ```sh           commands; the first that fails ends the test
  ```text         what the commands before it print: `...` stands for anything, alone in a line for any lines
  ```LANGUAGE NAME  a file of this name, whatever the language; commands behind it can use it
  ```json, ```python, ```cpp, ```c  without a name: must be read by a JSON parser, Python, the compiler

A command whose line ends with `# until Ctrl+C` is interrupted after three seconds. `pitchboard` opens its window without
a screen and closes it after a second. Folders of this repository that a page names are there.

A table between `<!-- options COMMAND -->` and `<!-- end -->` lists what `pitchboard-cli COMMAND --help-all` does;
PITCHBOARD_WRITE_DOCS=1 writes these tables into the page. docs/cli.md has a table for every command.

A block that cannot run here says so where it begins, with the reason: ```sh not-run: it needs a robot
NOT_RUN has their number for each page, so that each new one is a decision.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NOT_RUN = {"agent": 4, "building": 2, "install": 1, "learning": 1, "performance": 1, "readme": 1, "referee": 1, "sessions": 1}
REPOSITORY = ("tests/data", "docs/examples", "docs/recipes", "resources")
STUDIO = """#!/bin/bash
# The studio as a page starts it, without a screen: it takes a picture of its window after a second and ends.
for word in "$@"; do
  case $word in --screenshot-to | --paint | --render-scenario | --help | --version) exec "{studio}" "$@" ;; esac
done
exec "{studio}" --settings "{folder}/studio.ini" --screenshot-to "{folder}/window.png" --after 1 "$@"
"""


def matches(expected, printed):
    """Whether the printed lines are those expected, in order."""
    pattern = ""
    for line in expected:
        if line.strip() == "...":
            pattern += r"(?:.*\n)*?"
        else:
            words = re.split(r"\s+", line.strip())
            pattern += r"\s*" + r"\s+".join(re.escape(word).replace(r"\.\.\.", ".*?") for word in words) + r"[^\n]*\n"
    return re.fullmatch(pattern, "".join(line.rstrip() + "\n" for line in printed)) is not None


def interrupted(body):
    """The same commands, those that run until Ctrl+C ended after three seconds."""
    return re.sub(r"^(.*?)\s*# until Ctrl\+C$", r"timeout --preserve-status -s INT 3 \1 || [ $? -eq 130 ]", body, flags=re.M)


def check(language, body):
    """Reads a block that belongs to no command."""
    if language == "json":
        # A part of an object, or messages that go to a program (→) and come from it (←), one in a line.
        texts = [line[2:] for line in body.splitlines()] if body.startswith("→") else [
            "{" + body + "}" if body.startswith('"') else body]
        for text in texts:
            json.loads(text)
    elif language == "python":
        compile(body, "page", "exec")
    elif language in ("c", "cpp"):
        standard = {"c": "-std=c11", "cpp": "-std=c++20"}[language]
        subprocess.run(["g++" if language == "cpp" else "gcc", standard, "-x", {"c": "c", "cpp": "c++"}[language],
                        "-D_DEFAULT_SOURCE", "-fsyntax-only", "-I", str(ROOT / "robotlink/capi/include"), "-"],
                       input=body, text=True, check=True)
    elif language not in ("text", "ini", ""):
        raise ValueError(f"unknown kind of block: {language}")
    elif re.search(r"^(\$ )?(\./\w|pitchboard(-robot|-agent)? -|pitchboard-cli \w|scripts/|g\+\+|python3 )", body, re.M) and language == "":
        raise ValueError("commands belong into a block that begins with ```sh")


def helped(programs, command, option="--help-all"):
    run = subprocess.run([pathlib.Path(programs, "pitchboard-cli"), *command.split(), option], text=True,
                         capture_output=True, env=dict(os.environ, LC_ALL="C.UTF-8"))
    return run.stdout if run.returncode == 0 or option == "--help" else helped(programs, command, "--help")


def options_table(text):
    """The arguments and options of a page of help; a group of rare options has its name in a row."""
    rows, group = [], ""
    for line in text.splitlines():
        if re.fullmatch(r"[A-Z][\w ]+:", line):
            group = line[:-1]
            if group not in ("Options", "Arguments", "Commands", "Example", "Examples", "Rare options (--help-all)"):
                rows.append([f"**{group}**", ""])
        elif group and re.match(r"  \S", line) and not group.startswith(("Example", "Commands")):
            name, _, meaning = line.strip().partition("  ")
            rows.append([f"`{name}`", meaning.strip()])
        elif group and line.startswith(" " * 20) and rows and not group.startswith(("Example", "Commands")):
            rows[-1][1] += " " + line.strip()
    rows = [row for row in rows if not re.search(r"--help", row[0])]
    cells = [" | ".join(cell.strip().replace("|", r"\|") for cell in row) for row in rows]
    return "| option | meaning |\n|---|---|\n" + "".join(f"| {row} |\n" for row in cells)


def check_options(page, text, programs):
    """Returns the page with the tables of options that the program's help gives."""
    right = text
    for command in re.findall(r"^<!-- options (.*) -->$", text, re.M):
        mark = f"<!-- options {command} -->\n"
        begin = right.index(mark) + len(mark)
        right = right[:begin] + options_table(helped(programs, command)) + right[right.index("<!-- end -->", begin):]
    if os.environ.get("PITCHBOARD_WRITE_DOCS"):
        pathlib.Path(page).write_text(right, encoding="utf-8")
    elif right != text:
        sys.exit(f"{page}: options differ from --help; run PITCHBOARD_WRITE_DOCS=1 {sys.argv[0]} {page} {programs}")
    if pathlib.Path(page).stem == "cli":
        commands = helped(programs, "", "--help").partition("Commands:")[2].partition("Options:")[0]
        for command in re.findall(r"^  (\w+)", commands, re.M):
            if f"\n## {command}\n" not in text:
                sys.exit(f"{page}: no section for `pitchboard-cli {command}`")
    return right


def main(page, programs):
    name = pathlib.Path(page).stem
    text = pathlib.Path(page).read_text(encoding="utf-8")
    text = check_options(page, text, programs)
    printed, ran, compared, not_run = [], 0, 0, 0
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as own:
        studio = pathlib.Path(own, "pitchboard")
        studio.write_text(STUDIO.format(studio=pathlib.Path(programs, "pitchboard"), folder=own))
        studio.chmod(0o755)
        for part in REPOSITORY:
            if part in text:
                pathlib.Path(folder, part).parent.mkdir(parents=True, exist_ok=True)
                pathlib.Path(folder, part).symlink_to(ROOT / part)
        environment = dict(os.environ, PATH=os.pathsep.join([own, programs, os.environ["PATH"]]), LC_ALL="C.UTF-8",
                           QT_QPA_PLATFORM="offscreen", LIBRARY_PATH=str(pathlib.Path(programs).parent / "lib"),
                           LD_LIBRARY_PATH=str(pathlib.Path(programs).parent / "lib"),
                           CPATH=str(ROOT / "robotlink/capi/include"))
        for block in re.finditer(r"^( *)```(\w*)(?: ([^\n]+))?\n(.*?)^ *```$", text, re.M | re.S):
            indent, language, note, body = block.groups()
            body = re.sub("^" + indent, "", body, flags=re.M)
            line = text.count("\n", 0, block.start()) + 1
            if note and note.startswith("not-run:"):
                if len(note) < len("not-run: why"):
                    sys.exit(f"{page}:{line}: say why this block is not run")
                not_run += 1
            elif note:
                file = pathlib.Path(folder, note)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(body, encoding="utf-8")
            elif language == "sh":
                run = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", interrupted(body)], cwd=folder,
                                     env=environment, capture_output=True, text=True, timeout=240,
                                     stdin=subprocess.DEVNULL)
                printed = run.stdout.splitlines()
                ran += 1
                if run.returncode:
                    sys.exit(f"{page}:{line}: exit code {run.returncode}\n{body}{run.stdout}{run.stderr}")
            elif language == "text":
                compared += 1
                if not matches(body.splitlines(), printed):
                    sys.exit(f"{page}:{line}: expected\n{body}but it printed\n" + "\n".join(printed))
            else:
                try:
                    check(language, body)
                except (ValueError, SyntaxError, subprocess.CalledProcessError) as error:
                    sys.exit(f"{page}:{line}: {error}\n{body}")
    if not_run != NOT_RUN.get(name.lower(), 0):
        sys.exit(f"{page}: {not_run} blocks are not run, and {sys.argv[0]} says {NOT_RUN.get(name.lower(), 0)}")
    if name.startswith("tutorial") and not (ran and compared):
        sys.exit(f"{page}: nothing to carry out, or nothing to compare")
    print(f"{page}: {ran} blocks of commands ran, {compared} outputs compared, {not_run} not run")


if __name__ == "__main__":
    main(*sys.argv[1:])
