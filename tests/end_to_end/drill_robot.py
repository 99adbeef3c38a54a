# SPDX-License-Identifier: GPL-3.0-or-later
"""Walks a scripted drill: python3 drill_robot.py KEY [ROUNDS]

A thread waits for the end of each step, another one listens on a socket, the main one takes orders
from a queue. Nothing of this knows about a match.
"""
import ctypes
import queue
import select
import socket
import sys
import threading
import time

STEPS = [(8, 3.0), (2, 1.5), (8, 3.0), (2, 1.5), (8, 2.0), (0, 1.0)]  # DECISION_ACTION_A, seconds
CYCLE = 0.05  # s
ACTION_A, ACTION_B, WORKING = 17, 18, 104
CYCLES = 0  # PLANNING_COMMAND, which nobody here uses

libc = ctypes.CDLL(None)
libc.shmat.restype = ctypes.c_void_p
address = libc.shmat(libc.shmget(int(sys.argv[1]), 2048, 0o600), None, 0)
ints = (ctypes.c_int * 512).from_address(address)
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 1
orders = queue.Queue()


def script():
    due = time.monotonic()
    for action, seconds in STEPS * rounds:
        orders.put(action)
        due += seconds
        threading.Event().wait(max(0.0, due - time.monotonic()))
    orders.put(None)


def listen(receiver):
    while True:
        select.select([receiver], [], [], 0.1)
        ints[WORKING] = 1


receiver, _sender = socket.socketpair()
threading.Thread(target=listen, args=[receiver], daemon=True).start()
threading.Thread(target=script, daemon=True).start()
print("began", flush=True)
action = 0
due = time.monotonic()
while action is not None:
    ints[ACTION_B] = 10
    ints[ACTION_A] = action
    try:
        action = orders.get(timeout=max(0.0, due - time.monotonic()))
    except queue.Empty:
        ints[CYCLES] += 1
        due += CYCLE
print("done", flush=True)
threading.Event().wait()
