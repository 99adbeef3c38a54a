#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Follows a page of the documents to the letter: tst_tutorials.py PAGE FOLDER_OF_PROGRAMS

Blocks of the page are carried out in their order, in an empty folder:
  ```sh           commands; the first that fails ends the test
  ```python NAME  (any language) a file of this name
  ```text         what the commands before it print: `...` stands for anything, alone in a line for any lines
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile


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


def main(page, programs):
    text = pathlib.Path(page).read_text(encoding="utf-8")
    environment = dict(os.environ, PATH=programs + os.pathsep + os.environ["PATH"], LC_ALL="C.UTF-8")
    printed, ran, compared = [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for block in re.finditer(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", text, re.M | re.S):
            language, name, body = block.groups()
            line = text.count("\n", 0, block.start()) + 1
            if name:
                file = pathlib.Path(folder, name)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(body, encoding="utf-8")
            elif language == "sh":
                run = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", body], cwd=folder, env=environment,
                                     capture_output=True, text=True, timeout=240)
                printed = run.stdout.splitlines()
                ran += 1
                if run.returncode:
                    sys.exit(f"{page}:{line}: exit code {run.returncode}\n{body}{run.stdout}{run.stderr}")
            elif language == "text":
                compared += 1
                if not matches(body.splitlines(), printed):
                    sys.exit(f"{page}:{line}: expected\n{body}but it printed\n" + "\n".join(printed))
    if not ran or not compared:
        sys.exit(f"{page}: nothing to carry out, or nothing to compare")


if __name__ == "__main__":
    main(*sys.argv[1:])
