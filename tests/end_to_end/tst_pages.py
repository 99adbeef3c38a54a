#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Follows a page of the documents to the letter: tst_pages.py PAGE FOLDER_OF_PROGRAMS

Blocks of the page are carried out in their order, in an empty folder:
  ```sh           commands; the first that fails ends the test
  ```text         what the commands before it print: `...` stands for anything, alone in a line for any lines
  ```LANGUAGE NAME  a file of this name, whatever the language; commands behind it can use it
  ```json, ```python, ```cpp, ```c  without a name: must be read by a JSON parser, Python, the compiler

On a page with the line <!-- notebook -->, blocks of python run, too, one after the other in one interpreter.

A command whose line ends with `# until Ctrl+C` is interrupted after three seconds. `pitchboard` opens its window without
a screen and closes it after a second. Folders of this repository that a page names are there.

A table between `<!-- options COMMAND -->` and `<!-- end -->` lists what `pitchboard-cli COMMAND --help-all` does;
PITCHBOARD_WRITE_DOCS=1 writes these tables into the page. docs/cli.md has a table for every command.

Readers try twice: on tutorials and on pages that begin with match.mcap, each block of commands runs twice, and has to print
the same.

A block that cannot run here says so where it begins, with the reason: ```sh not-run: it needs a robot
NOT_RUN has their number for each page, so that each new one is a decision.
"""
import fcntl
import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NOT_RUN = {"agent": 6, "building": 2, "continuous-integration": 1, "install": 2, "learning": 1, "performance": 1, "readme": 2, "referee": 1, "sessions": 1}
REPOSITORY = ("tests/data", "docs/examples", "docs/recipes", "resources")
NOTEBOOK = """
import contextlib, io, json, sys, traceback
names = {"__name__": "__main__"}
for line in sys.stdin:
    out, failed = io.StringIO(), False
    with contextlib.redirect_stdout(out):
        try:
            exec(compile(json.loads(line), "page", "exec"), names)
        except Exception:
            failed = True
            traceback.print_exc(file=out)
    print(json.dumps([failed, out.getvalue()]), flush=True)
"""
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
                        "-D_DEFAULT_SOURCE", "-fsyntax-only", "-I", str(ROOT / "robotlink/laboratory/capi/include"), "-"],
                       input=body, text=True, check=True)
    elif language not in ("text", "ini", ""):
        raise ValueError(f"unknown kind of block: {language}")
    elif re.search(r"^(\$ )?(\./\w|pitchboard(-robot|-agent)? -|pitchboard-cli \w|scripts/|g\+\+|python3 )", body, re.M) and language == "":
        raise ValueError("commands belong into a block that begins with ```sh")


def commands_of(workflow):
    """Every command that a workflow of GitHub or GitLab runs, without where its output goes."""
    if isinstance(workflow, dict):
        for key, value in workflow.items():
            if key in ("run", "script"):
                yield from (line.split(" >>")[0] for line in (value.splitlines() if isinstance(value, str) else value))
            else:
                yield from commands_of(value)
    elif isinstance(workflow, list):
        for value in workflow:
            yield from commands_of(value)


def check_workflow(body, text):
    """A workflow runs what the page runs, too."""
    import yaml  # Debian: python3-yaml
    commands = list(commands_of(yaml.safe_load(body)))
    if not commands:
        raise ValueError("this workflow runs nothing")
    for command in commands:
        if not re.search(r"^```sh\n(?:(?!^```).*\n)*?" + re.escape(command) + "$", text, re.M):
            raise ValueError(f"no block of the page runs what this workflow runs: {command}")


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


def repeated(name, text):
    """Whether the blocks of a page run twice."""
    return name.startswith("tutorial") or "match.mcap" in text


def raise_loopback():
    """A network of its own (CMakeLists.txt) begins without 127.0.0.1."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        request = struct.pack("16sH14x", b"lo", 0)
        flags = struct.unpack_from("H", fcntl.ioctl(any_socket, 0x8913, request), 16)[0]  # SIOCGIFFLAGS
        if not flags & 1:  # IFF_UP
            fcntl.ioctl(any_socket, 0x8914, struct.pack("16sH14x", b"lo", flags | 1))  # SIOCSIFFLAGS


def main(page, programs):
    raise_loopback()
    name = pathlib.Path(page).stem
    text = pathlib.Path(page).read_text(encoding="utf-8")
    text = check_options(page, text, programs)
    printed, ran, compared, not_run = [], 0, 0, 0
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as own:
        studio = pathlib.Path(own, "pitchboard")
        studio.write_text(STUDIO.format(studio=pathlib.Path(programs, "pitchboard"), folder=own))
        studio.chmod(0o755)
        pathlib.Path(own, "python3").symlink_to(sys.executable)  # Debian's, which has numpy
        for part in REPOSITORY:
            if part in text:
                pathlib.Path(folder, part).parent.mkdir(parents=True, exist_ok=True)
                pathlib.Path(folder, part).symlink_to(ROOT / part)
        environment = dict(os.environ, PATH=os.pathsep.join([own, programs, os.environ["PATH"]]), LC_ALL="C.UTF-8",
                           QT_QPA_PLATFORM="offscreen", LIBRARY_PATH=str(pathlib.Path(programs).parent / "lib"),
                           LD_LIBRARY_PATH=str(pathlib.Path(programs).parent / "lib"),
                           CPATH=str(ROOT / "robotlink/laboratory/capi/include"), PYTHONDONTWRITEBYTECODE="1",
                           PYTHONPATH=str(ROOT / "robotlink/laboratory/capi/python"),
                           PITCHBOARD_SIM_LIBRARY=str(pathlib.Path(programs).parent / "lib/libpitchboard_sim.so.1"))
        notebook = subprocess.Popen([sys.executable, "-c", NOTEBOOK], cwd=folder, env=environment, text=True,
                                    stdin=subprocess.PIPE, stdout=subprocess.PIPE) if "<!-- notebook -->" in text else None
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
                if language == "yaml":
                    check_workflow(body, text)
            elif language == "sh":
                printed = []
                for attempt in ("", "the second time, ")[:2 if repeated(name, text) else 1]:
                    run = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", interrupted(body)], cwd=folder,
                                         env=environment, capture_output=True, text=True, timeout=240,
                                         stdin=subprocess.DEVNULL)
                    printed.append(run.stdout.splitlines())
                    if run.returncode:
                        sys.exit(f"{page}:{line}: {attempt}exit code {run.returncode}\n{body}{run.stdout}{run.stderr}")
                ran += 1
            elif language == "python" and notebook:
                notebook.stdin.write(json.dumps(body) + "\n")
                notebook.stdin.flush()
                failed, said = json.loads(notebook.stdout.readline())
                if failed:
                    sys.exit(f"{page}:{line}: {body}{said}")
                printed, ran = [said.splitlines()], ran + 1
            elif language == "text":
                compared += 1
                for lines in printed:
                    if not matches(body.splitlines(), lines):
                        sys.exit(f"{page}:{line}: expected\n{body}but it printed\n" + "\n".join(lines))
            else:
                try:
                    check(language, body)
                except (ValueError, SyntaxError, subprocess.CalledProcessError) as error:
                    sys.exit(f"{page}:{line}: {error}\n{body}")
        if notebook:
            notebook.stdin.close()
            notebook.wait(60)
    if not_run != NOT_RUN.get(name.lower(), 0):
        sys.exit(f"{page}: {not_run} blocks are not run, and {sys.argv[0]} says {NOT_RUN.get(name.lower(), 0)}")
    if name.startswith("tutorial") and not (ran and compared):
        sys.exit(f"{page}: nothing to carry out, or nothing to compare")
    print(f"{page}: {ran} blocks of commands ran, {compared} outputs compared, {not_run} not run")


if __name__ == "__main__":
    main(*sys.argv[1:])
