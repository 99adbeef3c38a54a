# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws for a robot: python3 draw_robot.py ROBOT [HOST:PORT]"""
import math
import os
import socket
import sys
import time

to = sys.argv[2] if len(sys.argv) > 2 else os.environ.get("PITCHBOARD_DRAW", "127.0.0.1:1240")
host, port = to.split(":")
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)


def draw(*lines):
    text = "\n".join(["PBD1 " + sys.argv[1], *lines])
    out.sendto(text.encode(), (host, int(port)))


turn = 0.0
while True:
    turn += 0.1
    x, y = 2 * math.cos(turn), 2 * math.sin(turn)
    draw("layer decision/target",             # on the field, for one second
         "arrow 0 0 %.2f %.2f" % (x, y),
         "text %.2f %.2f I go there" % (x, y + 0.2),
         "layer vision/obstacles robot 0.5",  # from the robot: x ahead, y to its left
         "colour red",
         "disc 1 0.5 0.2",
         "polygon 0.5 -0.3 0.9 -0.3 0.9 -0.7")
    time.sleep(0.1)
