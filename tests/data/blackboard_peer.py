# SPDX-License-Identifier: GPL-3.0-or-later
# An independent process on a blackboard: System V shared memory through ctypes, the layout from its
# description (int i at word i, float j at word 125 + j, 2048 bytes), nothing of the program's code.
# usage: blackboard_peer.py KEY read i:17 f:12 ... | write i:17=8 f:12=0.5 ... | create | hold | count i:17 RATE
import ctypes
import sys
import time

libc = ctypes.CDLL(None, use_errno=True)
libc.shmat.restype = ctypes.c_void_p
libc.shmat.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_int]


def attach(key):
    shmid = libc.shmget(key, 2048, 0)
    if shmid < 0:
        shmid = libc.shmget(key, 2048, 0o1000 | 0o2000 | 0o600)  # IPC_CREAT | IPC_EXCL
    if shmid < 0:
        sys.exit("shmget: %d" % ctypes.get_errno())
    return libc.shmat(shmid, None, 0)


def place(address, name):
    kind, index = name.split(":")
    if kind == "i":
        return ctypes.c_int32.from_address(address + 4 * int(index))
    return ctypes.c_float.from_address(address + 4 * (125 + int(index)))


base = attach(int(sys.argv[1]))
if sys.argv[2] == "read":
    print(" ".join(repr(place(base, name).value) for name in sys.argv[3:]))
elif sys.argv[2] == "write":
    for item in sys.argv[3:]:
        name, value = item.split("=")
        place(base, name).value = int(value) if name[0] == "i" else float(value)
elif sys.argv[2] == "hold":
    print("attached", flush=True)
    time.sleep(600)
elif sys.argv[2] == "count":
    word, rate = place(base, sys.argv[3]), float(sys.argv[4])
    print("attached", flush=True)
    start = time.monotonic()
    while time.monotonic() < start + 600:
        word.value = int((time.monotonic() - start) * rate)
        time.sleep(0.2 / rate)
