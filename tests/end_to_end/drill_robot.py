# SPDX-License-Identifier: GPL-3.0-or-later
"""Walks a scripted drill: python3 drill_robot.py KEY

A thread waits for the end of each step, another one listens on a socket, the main one takes orders
from a queue. Nothing of this knows about a match.
"""
import ctypes
import queue
import select
import socket
import sys
import threading

STEPS = [(8, 3.0), (2, 1.5), (8, 3.0), (3, 1.5), (8, 3.0), (0, 0.5)]  # DECISION_ACTION_A, seconds
ACTION_A, ACTION_B, WORKING = 17, 18, 104

libc = ctypes.CDLL(None)
libc.shmat.restype = ctypes.c_void_p
address = libc.shmat(libc.shmget(int(sys.argv[1]), 2048, 0o600), None, 0)
ints = (ctypes.c_int * 512).from_address(address)
orders = queue.Queue()


def script():
    for action, seconds in STEPS:
        orders.put(action)
        threading.Event().wait(seconds)
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
while action is not None:
    ints[ACTION_B] = 10
    ints[ACTION_A] = action
    try:
        action = orders.get(timeout=0.05)
    except queue.Empty:
        pass
print("done", flush=True)
threading.Event().wait()
