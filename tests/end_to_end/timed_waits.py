# SPDX-License-Identifier: GPL-3.0-or-later
"""Waits with a time limit of a second each, and says when one of them has returned."""
import queue
import threading

event, lock, items = threading.Event(), threading.Lock(), queue.Queue()
lock.acquire()
print("began", flush=True)
event.wait(1.0)
print("Event.wait", flush=True)
try:
    items.get(timeout=1.0)
except queue.Empty:
    print("queue.get", flush=True)
lock.acquire(timeout=1.0)
print("lock.acquire", flush=True)
while True:
    event.wait(60.0)
