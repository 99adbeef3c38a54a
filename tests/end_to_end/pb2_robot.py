# SPDX-License-Identifier: GPL-3.0-or-later
"""Sends variables of a robot: python3 pb2_robot.py ROBOT ADDRESS [PORT]"""
import socket
import sys
import time

robot, address = int(sys.argv[1]), sys.argv[2]
port = int(sys.argv[3]) if len(sys.argv) > 3 else 1340 + robot
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
out.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
sequence = 0
while True:
    values = {"VOLTAGE": 148, "IMU_EULER_Z": 0.5}  # a whole number, and one with a point
    fields = " ".join("%s=%r" % field for field in values.items())
    text = "PB2 %d %d %d %s OUT" % (robot, sequence, time.monotonic() * 1000, fields)
    out.sendto(text.encode(), (address, port))
    sequence = (sequence + 1) % 2**32
    time.sleep(0.05)
