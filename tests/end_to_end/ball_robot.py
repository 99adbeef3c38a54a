# SPDX-License-Identifier: GPL-3.0-or-later
"""Decides in lock-step with the match: python3 ball_robot.py KEY"""
import ctypes
import sys
import time

KICK_DISTANCE = 25  # cm
FLOATS = 125        # word of the first float variable
ACTION_A, ACTION_B, REFEREE, LOST, SEARCH_ON, CYCLE = 17, 18, 51, 57, 58, 447  # int variables
BALL_DIST, PAN_DEG = 17, 66                                                    # float variables

libc = ctypes.CDLL(None)
libc.shmat.restype = ctypes.c_void_p
address = libc.shmat(libc.shmget(int(sys.argv[1]), 2048, 0), None, 0)
ints = (ctypes.c_int * 512).from_address(address)
floats = (ctypes.c_float * (512 - FLOATS)).from_address(address + 4 * FLOATS)


def decide():
    if ints[REFEREE] != 2:
        return 0                           # stand still
    if ints[LOST] == 1:
        ints[SEARCH_ON] = 1
        return 3                           # turn right to find the ball
    bearing, distance = int(floats[PAN_DEG]), floats[BALL_DIST]
    if abs(bearing) > 40:
        return 2 if bearing > 0 else 3     # turn left, right
    if distance < KICK_DISTANCE:
        return 5 if bearing > 0 else 4     # kick left, right
    ints[ACTION_B] = int(distance / 5)     # how fast, before the action that reads it
    return 8                               # walk forward


ints[CYCLE] = -1                           # I am here
while True:
    while ints[CYCLE] <= 0:
        time.sleep(0.0002)
    tick = ints[CYCLE]                     # what the robot senses after this tick is there
    if tick % 6 == 0:
        ints[ACTION_A] = decide()
    ints[CYCLE] = -tick                    # finished: the match goes on
