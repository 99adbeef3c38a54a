#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tst_run_asks.py SOURCE: ./run on a terminal says what it would install, and asks before it uses sudo.

A user without root rights, a database of dpkg in which all packages are missing, and sudo and apt-get that only note
how they were called. The terminal is a pseudo terminal.
"""
import os
import pathlib
import pty
import select
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(sys.argv[1])
QUESTION = "Install them with sudo apt-get? [Y/n]"


class Place:
    """A folder with a copy of ./run and of its scripts, and programs that note their arguments."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.notes = self.folder / "notes"
        scripts = self.folder / "checkout/scripts"
        scripts.mkdir(parents=True)
        for name in ("run", "scripts/common.sh"):
            target = self.folder / "checkout" / name
            target.write_bytes((SOURCE / name).read_bytes())
            target.chmod(0o755)
        (scripts / "packages-run.txt").write_text("cmake\nninja-build\n")
        (self.folder / "database").mkdir()
        (self.folder / "database/status").write_text("")
        programs = self.folder / "bin"
        programs.mkdir()
        for name, body in {
            "sudo": f'echo "sudo $*" >>{self.notes}\n[ "$2" = update ] || [ -z "${{DENY:-}}" ]',
            "id": "echo 1000",  # not root
            "cmake": f"echo cmake >>{self.notes}; exit 1",  # what comes after the packages
        }.items():
            (programs / name).write_text(f"#!/bin/sh\n{body}\n")
            (programs / name).chmod(0o755)
        self.environment = {"PATH": f"{programs}:/usr/bin:/bin", "LC_ALL": "C.UTF-8", "HOME": folder,
                            "DPKG_ADMINDIR": str(self.folder / "database")}

    def noted(self):
        text = self.notes.read_text() if self.notes.exists() else ""
        self.notes.unlink(missing_ok=True)
        return text

    def on_terminal(self, arguments, answer):
        """Returns what was printed before the answer, and all of it."""
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.folder / "checkout")
            os.execve("./run", ["./run", *arguments], self.environment)
        printed, before, deadline = "", None, time.monotonic() + 60
        while time.monotonic() < deadline:
            if not select.select([terminal], [], [], 1)[0]:
                continue
            try:
                data = os.read(terminal, 4096)
            except OSError:  # the program has ended
                break
            if not data:
                break
            printed += data.decode()
            if QUESTION in printed and before is None:
                before = (printed, self.noted())
                os.write(terminal, answer.encode() + b"\n")
        os.close(terminal)
        os.waitpid(child, 0)
        return before, printed


def main():
    with tempfile.TemporaryDirectory() as folder:
        place = Place(folder)

        for answer in ("", "y", "Yes"):
            before, printed = place.on_terminal(["--build-only"], answer)
            assert before, "it did not ask: " + printed
            assert "cmake ninja-build" in before[0], before[0]
            assert before[1] == "", "it did something before it was answered: " + before[1]
            noted = place.noted()
            assert "sudo env DEBIAN_FRONTEND=noninteractive apt-get install" in noted, noted
            assert noted.rstrip().split("\n")[1].endswith(" cmake ninja-build"), noted
            assert noted.endswith("cmake\n"), "it did not go on: " + noted

        for answer in ("n", "no", "what?"):
            before, printed = place.on_terminal(["--build-only"], answer)
            assert before and place.noted() == "", printed
            assert "error: nothing was installed" in printed, printed
            assert "sudo apt-get install cmake ninja-build" in printed, printed

        for arguments in (["--yes", "--build-only"], ["--build-only", "--yes"]):
            before, printed = place.on_terminal(arguments, "")
            assert before is None, "it asked in spite of --yes: " + printed
            noted = place.noted()
            assert "apt-get install" in noted and noted.endswith("cmake\n"), noted

        # Where nobody can answer.
        run = subprocess.run(["./run", "--build-only"], cwd=place.folder / "checkout", env=place.environment,
                             stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
        assert run.returncode == 2 and place.noted() == "", run
        assert "say --yes" in run.stderr and "cmake ninja-build" in run.stderr, run.stderr

        # The shell has all programs and the library, as the pages use them.
        cmake = place.folder / "bin/cmake"
        cmake.write_text(f'#!/bin/sh\necho "$*" >>{place.notes}\n')
        run = subprocess.run(["./run", "--yes", "--shell"], cwd=place.folder / "checkout", capture_output=True, text=True,
                             env=place.environment | {"SHELL": "/bin/true"}, stdin=subprocess.DEVNULL, timeout=60)
        noted = place.noted()
        assert run.returncode == 0 and "--target programs\n" in noted, (run, noted)
        assert "pitchboard-agent are in PATH" in run.stderr, run.stderr
    print("./run asks before it uses sudo")


if __name__ == "__main__":
    main()
