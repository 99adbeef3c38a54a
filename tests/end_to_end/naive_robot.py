# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays the naive behaviour through a robot's blackboard: python3 naive_robot.py KEY [PERIOD]"""
import ctypes
import sys
import time

BYTES, FLOATS = 2048, 125  # size of the blackboard; word of the first float variable
ACTION_A, ACTION_B, REFEREE, LOST, SEARCH_ON, WORKING = 17, 18, 51, 57, 58, 104  # int variables
BALL_DIST, PAN_DEG = 17, 66                                                    # float variables

libc = ctypes.CDLL(None, use_errno=True)
libc.shmat.restype = ctypes.c_void_p
libc.shmat.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_int]
segment = libc.shmget(int(sys.argv[1]), BYTES, 0o600)
if segment < 0:
    sys.exit("no blackboard with key %s: start the simulator first" % sys.argv[1])
address = libc.shmat(segment, None, 0)
ints = (ctypes.c_int * 512).from_address(address)
floats = (ctypes.c_float * (512 - FLOATS)).from_address(address + 4 * FLOATS)


def decide(bearing, distance, distance_to_kick=25):
    """DECISION_ACTION_A for a ball at so many degrees to the left and so many cm away."""
    if 40 < abs(bearing) < 160:
        return 2 if bearing > 0 else 3     # turn left, right
    if distance < distance_to_kick:
        return 5 if bearing > 0 else 4     # kick left, right
    ints[ACTION_B] = int(distance / 5)     # how fast, before the action that reads it
    return 8                               # walk forward


while True:
    if ints[REFEREE] == 2 and ints[LOST] == 1:
        ints[SEARCH_ON], ints[ACTION_A] = 1, 3  # turn to find the ball
    elif ints[REFEREE] == 2:
        ints[ACTION_A] = decide(int(floats[PAN_DEG]), floats[BALL_DIST])
    else:
        ints[ACTION_A] = 0                 # stand still
    ints[WORKING] = 1                      # still alive; communication clears it
    time.sleep(float(sys.argv[2]) if len(sys.argv) > 2 else 0.25)
