# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays the naive behaviour through a robot's blackboard; needs Python 3 and nothing else.

python3 naive_robot.py KEY    KEY is 100 x the robot's number. Ends with Ctrl+C.
"""
import ctypes
import sys
import time

BYTES, FLOATS = 2048, 125  # size of the blackboard; word of the first float variable
# int variables
ACTION_A, ACTION_B, REFEREE, LOST, SEARCH_ON, WORKING = 17, 18, 51, 57, 58, 104
# float variables
BALL_DIST, PAN_DEG = 17, 66

libc = ctypes.CDLL(None, use_errno=True)
libc.shmat.restype = ctypes.c_void_p
libc.shmat.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_int]


def attach(key):
    """The blackboard as (ints, floats), two views of the same memory."""
    segment = libc.shmget(key, BYTES, 0o600)
    if segment < 0:
        sys.exit("no blackboard with key %d: start the simulator first" % key)
    address = libc.shmat(segment, None, 0)
    return ((ctypes.c_int * 512).from_address(address),
            (ctypes.c_float * (512 - FLOATS)).from_address(address + 4 * FLOATS))


def decide(ints, floats, distance_to_kick=25):
    bearing, distance = int(floats[PAN_DEG]), floats[BALL_DIST]
    if ints[LOST] == 1:
        ints[SEARCH_ON], action = 1, 3
    elif 40 < bearing < 160:
        action = 2
    elif -160 < bearing < -40:
        action = 3
    elif distance < distance_to_kick:
        action = 4 if bearing <= 0 else 5
    elif distance > 50 or 20 < distance < 50:
        ints[ACTION_B], action = int(distance / 5), 8
    else:
        action = 11
    ints[ACTION_A] = action


blackboard = attach(int(sys.argv[1]))
period = float(sys.argv[2]) if len(sys.argv) > 2 else 0.25
while True:
    if blackboard[0][REFEREE] == 2:
        decide(*blackboard)
    elif blackboard[0][REFEREE] in (1, 11, 12):
        blackboard[0][ACTION_A] = 0
    blackboard[0][WORKING] = 1
    time.sleep(period)
