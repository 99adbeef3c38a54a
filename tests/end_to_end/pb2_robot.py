# SPDX-License-Identifier: GPL-3.0-or-later
from itertools import count
from socket import AF_INET, SOCK_DGRAM, socket
from sys import argv
from time import monotonic, sleep

robot, address, port = int(argv[1]), argv[2], int(argv[3])
out = socket(AF_INET, SOCK_DGRAM)
for sequence in count():
    values = {"VOLTAGE": 148, "IMU_EULER_Z": 0.5}  # an int, and a float: it has a point
    fields = " ".join("%s=%r" % field for field in values.items())
    text = "PB2 %d %d %d %s OUT" % (robot, sequence % 2**32, monotonic() * 1000, fields)
    out.sendto(text.encode(), (address, port))
    sleep(0.05)
