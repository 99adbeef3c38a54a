#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tst_agent_arm.py SOURCE: builds pitchboard-agent for ARM processors and runs it under qemu-user.

Every value of the blackboard must arrive to the last bit, and a recording must be a whole file. Ends with 77, and a reason, where the cross compilers or
qemu-user are not installed (scripts/packages-agent.txt).
"""
import json
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "scripts"))
from agent_cost import FLOAT_OFFSET, WORDS, Segment, listener, own_key  # noqa: E402

PROCESSORS = {"arm64": ("aarch64-linux-gnu-g++", "qemu-aarch64"), "armhf": ("arm-linux-gnueabihf-g++", "qemu-arm")}
MOST_BYTES = 3_000_000


def words_of(message, types):
    """The words of a datagram's values: {name: word}."""
    fields = message.split()
    assert fields[0] == "PB2" and fields[1] == "3" and fields[-1] == "OUT", message
    values = dict(field.split("=") for field in fields[4:-1] if not field.startswith("@"))
    return {name: int(text) & 0xffffffff if types[name] == "int" else
            struct.unpack("I", struct.pack("f", float(text)))[0] for name, text in values.items()}


def check(name, qemu):
    program = SOURCE / "build/agent" / name / "bin/pitchboard-agent"
    size = program.stat().st_size
    assert size < MOST_BYTES, "%s has %d bytes" % (program, size)
    catalog = json.loads((SOURCE / "resources/blackboard.json").read_text())
    types = {name: kind for kind in ("int", "float") for name in catalog[kind]}
    places = {**catalog["int"], **{name: FLOAT_OFFSET + at for name, at in catalog["float"].items()}}
    segment, ears = Segment(own_key()), listener()
    numbers = random.Random(28)
    for word in range(WORDS):
        number = numbers.getrandbits(32)
        segment.words[word] = number if number & 0x7f800000 != 0x7f800000 else 0x3dcccccd  # no nan
    folder = tempfile.TemporaryDirectory()
    flight = Path(folder.name) / "flight.mcap"
    agent = subprocess.Popen([qemu, str(program), "--robot", "3", "--key", str(segment.key), "--rate", "50",
                              "--record", str(flight), "--to", "127.0.0.1:%d" % ears.getsockname()[1]])
    try:
        ears.settimeout(60)
        seen = {}
        while len(seen) < len(places):
            seen.update(words_of(ears.recv(2000).decode(), types))
        wrong = {n: (hex(word), hex(segment.words[places[n]])) for n, word in seen.items()
                 if word != segment.words[places[n]]}
        assert not wrong, wrong
        # A change, after the segment was made again.
        segment.remove()
        segment = Segment(segment.key)
        segment.words[places["DECISION_ACTION_A"]] = 12
        deadline = time.monotonic() + 60
        while seen["DECISION_ACTION_A"] != 12:
            assert time.monotonic() < deadline, "the new blackboard was not read"
            seen.update(words_of(ears.recv(2000).decode(), types))
        assert agent.poll() is None
        agent.terminate()
        assert agent.wait(60) == 0
        recorded = flight.read_bytes()
        magic = b"\x89MCAP0\r\n"
        assert recorded.startswith(magic) and recorded.endswith(magic) and b"zstd" in recorded, len(recorded)
    finally:
        agent.kill()
        agent.wait()
        segment.remove()
        folder.cleanup()
    print("%s: %d values under %s, %d bytes" % (name, len(seen), qemu, size))


def main():
    missing = [command for pair in PROCESSORS.values() for command in pair if not shutil.which(command)]
    if missing:
        print("skipped: %s is not installed; scripts/agent.sh installs what is missing" % ", ".join(missing))
        sys.exit(77)
    subprocess.run([str(SOURCE / "scripts/agent.sh"), "--package", *PROCESSORS], check=True)
    for name, (_, qemu) in PROCESSORS.items():
        check(name, qemu)
        package = next((SOURCE / "build/packages" / name).glob("pitchboard-agent_*_%s.deb" % name))
        listed = subprocess.run(["dpkg-deb", "-c", str(package)], check=True, capture_output=True, text=True).stdout
        for path in ("/usr/bin/pitchboard-agent", "/lib/systemd/system/pitchboard-agent@.service", "agent.md", "man1/pitchboard-agent.1.gz"):
            assert path in listed, "%s is not in %s" % (path, package.name)


if __name__ == "__main__":
    main()
