# SPDX-License-Identifier: GPL-3.0-or-later
"""Sends what robots send, written from the published description and not from our code.

usage: robot_sender.py PORT_BASE ROBOTS MESSAGES
"""
import socket
import sys

base, robots, messages = (int(word) for word in sys.argv[1:4])
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
for count in range(messages):
    for robot in range(1, robots + 1):
        fields = [robot, 100 + count, 200, -45, 12.5, 80.25, -10.0, 1, 1, 0, 1, 1, 3, 0.5, 124]
        text = " ".join(str(field) for field in fields) + " OUT"
        out.sendto(text.encode("ascii"), ("127.0.0.1", base + robot))
