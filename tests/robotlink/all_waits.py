# SPDX-License-Identifier: GPL-3.0-or-later
"""Waits for as many seconds as the argument says in every way that Python knows, one after the other.

A line each: what it was, and how long it took by two of this program's clocks.
"""
import asyncio
import queue
import select
import signal
import socket
import struct
import subprocess
import sys
import threading
import time

SECONDS = float(sys.argv[1])


def get_from_queue():
    try:
        queue.Queue().get(timeout=SECONDS)
    except queue.Empty:
        pass


def wait_for_condition():
    condition = threading.Condition()
    with condition:
        condition.wait(SECONDS)


def acquire_lock():
    lock = threading.Lock()
    lock.acquire()
    lock.acquire(timeout=SECONDS)


def poll_socket():
    ours, _theirs = socket.socketpair()
    poll = select.poll()
    poll.register(ours, select.POLLIN)
    poll.poll(SECONDS * 1000)


def epoll_socket():
    ours, _theirs = socket.socketpair()
    poll = select.epoll()
    poll.register(ours, select.EPOLLIN)
    poll.poll(SECONDS)


def receive(option):
    ours, _theirs = socket.socketpair()
    if option:
        ours.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("ll", int(SECONDS), 0))
    else:
        ours.settimeout(SECONDS)
    try:
        ours.recv(1)
    except (BlockingIOError, TimeoutError):
        pass


def wait_for_child():
    try:
        subprocess.run(["sleep", "1000"], timeout=SECONDS)
    except subprocess.TimeoutExpired:
        pass


def wait_for_alarm():
    signal.signal(signal.SIGALRM, lambda *_: None)
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    signal.pause()


WAYS = {
    "time.sleep": lambda: time.sleep(SECONDS),
    "Event.wait": lambda: threading.Event().wait(SECONDS),
    "Queue.get": get_from_queue,
    "Condition.wait": wait_for_condition,
    "Lock.acquire": acquire_lock,
    "Thread.join": lambda: threading.Thread(target=time.sleep, args=(SECONDS,)).run(),
    "select": lambda: select.select([], [], [], SECONDS),
    "poll": poll_socket,
    "epoll": epoll_socket,
    "socket.settimeout": lambda: receive(option=False),
    "SO_RCVTIMEO": lambda: receive(option=True),
    "asyncio.sleep": lambda: asyncio.run(asyncio.sleep(SECONDS)),
    "subprocess_timeout": wait_for_child,
    "subprocess_that_sleeps": lambda: subprocess.run(["sleep", str(SECONDS)]),
    "setitimer": wait_for_alarm,
    "sigtimedwait": lambda: signal.sigtimedwait([signal.SIGUSR1], SECONDS),
}

signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGUSR1])
for name, wait in WAYS.items():
    began, wall = time.monotonic(), time.time()
    wait()
    print(name, f"{time.monotonic() - began:.3f} {time.time() - wall:.3f}", flush=True)
