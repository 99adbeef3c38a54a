# SPDX-License-Identifier: GPL-3.0-or-later
"""Waits for as many whole seconds as the first argument says in every way that Python knows, side by side.

A line each, as every_wait.h describes it.
"""
import asyncio
import os
import queue
import select
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import warnings

# The studio's clock has a thread in this program, of which Python 3.12 and later warn at each fork.
warnings.filterwarnings("ignore", category=DeprecationWarning)

SECONDS = int(sys.argv[1])


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


async def wait_in_asyncio():
    try:
        await asyncio.wait_for(asyncio.Event().wait(), SECONDS)
    except asyncio.TimeoutError:
        pass


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
        ours.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("ll", SECONDS, 0))
    else:
        ours.settimeout(SECONDS)
    try:
        ours.recv(1)
    except (BlockingIOError, TimeoutError):
        pass


# What sleeps in a child, which is started before: that takes its time, too.
CHILDREN = {"subprocess_timeout": 1000, "subprocess_that_sleeps": SECONDS}
children = []


def wait_for_child():
    try:
        children[0].wait(SECONDS)
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
    "asyncio.wait_for": lambda: asyncio.run(wait_in_asyncio()),
    "subprocess_timeout": wait_for_child,
    "subprocess_that_sleeps": lambda: children[0].wait(),
    "setitimer": wait_for_alarm,
    "sigtimedwait": lambda: signal.sigtimedwait([signal.SIGUSR1], SECONDS),
}



def uptime():
    with open("/proc/uptime") as file:
        return float(file.read().split()[0])


def run(name, wait):
    if name in CHILDREN:
        children.append(subprocess.Popen(["sleep", str(CHILDREN[name])]))
    began = uptime()
    clocks = time.CLOCK_MONOTONIC, time.CLOCK_REALTIME, time.CLOCK_BOOTTIME
    before = [time.clock_gettime(clock) for clock in clocks] + [time.time()]
    wait()
    after = [time.clock_gettime(clock) for clock in clocks] + [time.time()]
    passed = [f"{b - a:.4f}" for a, b in zip(before, after)]
    whole = int(after[3]) - int(before[3])
    line = f"{name} {' '.join(passed)} {whole} {began:.2f} {uptime():.2f} {after[0]:.2f}\n"
    os.write(1, line.encode())
    for child in children:
        child.kill()


signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGUSR1])
print("ready", flush=True)
while not os.path.exists(sys.argv[2]):
    time.sleep(0.001)
for way, wait_for_it in WAYS.items():
    if os.fork() == 0:
        run(way, wait_for_it)
        os._exit(0)
for _ in WAYS:
    os.wait()
