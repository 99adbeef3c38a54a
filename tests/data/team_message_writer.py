#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes team messages with made-up values, by struct and Google's protobuf, and what is to be read
in them: the form of team_messages.json. Arguments: the .proto file, a folder for what protoc makes,
the seed."""
import json
import math
import os
import random
import struct
import subprocess
import sys

proto, folder, seed = sys.argv[1], sys.argv[2], int(sys.argv[3])
subprocess.run(["protoc", "--proto_path", os.path.dirname(proto), "--python_out", folder, proto], check=True)
sys.path.insert(0, folder)
import team_messages_pb2 as pb  # noqa: E402

rng = random.Random(seed)
LENGTH, WIDTH = 9.0, 6.0
messages = []


def f32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def pose():
    return f32(rng.uniform(-4.5, 4.5)), f32(rng.uniform(-3, 3)), f32(rng.uniform(-3.1, 3.1))


def published(x, y, yaw):
    return {"LOCALIZATION_X": (x + LENGTH / 2) * 100, "LOCALIZATION_Y": (WIDTH / 2 - y) * 100,
            "LOCALIZATION_THETA": math.degrees(yaw) % 360.0}


def seen(ahead, left):
    return {"VISION_BALL_DIST": math.hypot(ahead, left) * 100, "VISION_PAN_DEG": math.degrees(math.atan2(left, ahead))}


def seen_on_field(x, y, yaw, bx, by):
    dx, dy = bx - x, by - y
    return seen(dx * math.cos(yaw) + dy * math.sin(yaw), dy * math.cos(yaw) - dx * math.sin(yaw))


def add(name, profile, robot, data, values, team=None):
    message = {"name": f"{name} {len(messages)}", "profile": profile, "robot": robot, "hex": data.hex(), "values": values}
    if team is not None:
        message["team"] = team
    messages.append(message)


for _ in range(20):
    x, y, yaw = pose()
    bx, by = f32(rng.uniform(-4.5, 4.5)), f32(rng.uniform(-3, 3))
    ahead, left = f32(rng.uniform(0.1, 4)), f32(rng.uniform(-3, 3))
    robot, team = rng.randint(1, 11), rng.randint(1, 99)
    there = published(x, y, yaw)

    for profile, message in (("robocup", pb.RobocupMessage()), ("nubots", pb.NubotsMessage()), ("bit-bots", pb.RobocupMessage())):
        message.pose.player = robot
        message.pose.team = team
        message.pose.position.x, message.pose.position.y, message.pose.position.z = x, y, yaw
        message.state = 2
        message.walk.z = 0.5
        values = {"POSE_X": x, "POSE_YAW": yaw, "STATE": 2, "WALK_X": 0, "WALK_YAW": 0.5, **there}
        if rng.random() < 0.7:
            message.ball.position.x, message.ball.position.y = bx, by
            values.update(seen_on_field(x, y, yaw, bx, by), BALL_X=bx)
        else:
            values.update(VISION_BALL_DIST=None, BALL_X=None)
        if profile == "nubots":
            message.purpose.player, message.purpose.purpose = robot, 3
            values["PURPOSE"] = 3
        if profile == "bit-bots":
            message.role, message.time_to_ball = 6, 9999.0
            values.update(ROLE=6, TIME_TO_BALL=None)
        for other in range(rng.randint(0, 5)):
            message.others.add(player=other)
        add(profile, profile, robot, message.SerializeToString(), values, team if profile == "bit-bots" else None)

    message = pb.RhobanMessage()
    message.robot.identity.team, message.robot.identity.robot = team, robot
    message.robot.perception.pose.position.x, message.robot.perception.pose.position.y = x, y
    message.robot.perception.pose.yaw = yaw
    message.robot.perception.ball.x, message.robot.perception.ball.y = ahead, left
    message.robot.perception.ball_quality = f32(rng.choice([0.0, 0.4, 1.0]))
    message.robot.microseconds = 123456789
    message.packet.number = 4000000000
    ball = seen(ahead, left) if message.robot.perception.ball_quality > 0 else {"VISION_BALL_DIST": None}
    add("rhoban", "rhoban", robot, message.SerializeToString(),
        {"PACKET": 4000000000, "ROBOT_TIME": 123456789, "BALL_X": ahead, **there, **ball}, team)

    message = pb.UtraMessage()
    message.player = robot
    message.pose.position.x, message.pose.position.y = x, y
    message.pose.orientation.z, message.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    add("utra", "utra", robot, message.SerializeToString(), {"POSE_X": x, **there})

    mx, my, degrees = rng.randint(-4500, 4500), rng.randint(-3000, 3000), rng.randint(0, 359)
    ax, ay = rng.randint(50, 4000), rng.randint(-3000, 3000)
    pairs = {0: 5, 0x10000: mx, 0x10001: my, 0x10002: degrees, 0x10004: ax, 0x10005: ay, 0x10006: 200, 0x7777: 1}
    data = b"CTXM" + struct.pack("<HHIHH", 1, len(pairs), 0, team, robot)
    data += b"".join(struct.pack("<Ii", key, value) for key, value in pairs.items())
    add("mitecom", "mitecom", robot, data,
        {"ROLE": 5, "POSE_X": mx, "POSE_YAW": degrees, **published(mx / 1000, my / 1000, math.radians(degrees)), **seen(ax / 1000, ay / 1000)}, team)

    age = f32(rng.choice([-1.0, 0.0, 2.5]))
    # A ball that was seen more than 2 s ago is not seen.
    ball = seen(f32(ahead * 1000) / 1000, f32(left * 1000) / 1000) if 0 <= age <= 2 else {"VISION_BALL_DIST": None}
    spl = struct.pack("<BBB3f", robot, team, 0, x * 1000, y * 1000, yaw)
    millimetres = published(f32(x * 1000) / 1000, f32(y * 1000) / 1000, yaw)
    for version in (7, 8, 9):
        data = b"SPL " + bytes([version]) + spl + struct.pack("<f2f", age, ahead * 1000, left * 1000) + b"\0\0"
        add(f"spl v{version}", "spl", robot, data, {"FALLEN": 0, "BALL_AGE": age, **millimetres, **ball}, team)
    add("rgrt", "rgrt", robot, b"RGrt\x04" + spl + struct.pack("<f2f", age, ahead * 1000, left * 1000),
        {"FALLEN": 0, **millimetres, **ball}, team)
    tail = struct.pack("<2f2f", 1, 2, 3, 4)
    data = b"SPL \x06" + spl + tail + struct.pack("<f4f", age, ahead * 1000, left * 1000, 5, 6) + bytes(5) + struct.pack("<bhhh", 3, 250, 1000, 0)
    add("spl v6", "spl-v6", robot, data, {"WALK_TO_X": 1, "SHOOT_TO_Y": 4, **millimetres, **ball}, team)
    data = b"SPL \x05" + struct.pack("<BBB3f", robot, 1, 0, x * 1000, y * 1000, yaw) + tail
    data += struct.pack("<i4f", int(age * 1000), ahead * 1000, left * 1000, 5, 6)
    add("spl v5", "spl-v5", robot, data, {"TEAM_COLOUR": 1, **millimetres, **ball})

    data = struct.pack("<IIffff", 0, robot - 1, math.cos(yaw), math.sin(yaw), x, y)
    if rng.random() < 0.5:
        add("hulks", "hulks", robot, data + b"\1" + struct.pack("<ffQI", bx, by, 1, 250000000),
            {"BALL_AGE": 1.25, **there, **seen_on_field(x, y, yaw, bx, by)})
    else:
        add("hulks", "hulks", robot, data + b"\0", {"BALL_X": None, "VISION_BALL_DIST": None, **there})

    found = rng.random() < 0.5
    data = struct.pack("<5i4B9d2d2i", 31202, 7, team, robot, 1, 1, 0, found, 1, 0.9, 1.5, 3.0, bx, by, 0.1, x, y, yaw, 0, 0, 12, 3)
    assert len(data) == 120
    add("booster", "booster", robot, data,
        {"ROLE": 1, "LEAD": 0, "COMMAND": 3, **there, **(seen_on_field(x, y, yaw, bx, by) if found else {"VISION_BALL_DIST": None})}, team)

    def cit(kind, cx, cy, byte):
        packed = (cx & 0x3FF) << 10 | (cy & 0x3FF)
        return bytes([0x80 | kind << 5 | packed >> 16, packed >> 8 & 255, packed & 255, byte])

    cx, cy, turn = rng.randint(-450, 450), rng.randint(-300, 300), rng.randint(0, 179)
    kx, ky = rng.randint(-450, 450), rng.randint(-300, 300)
    data = bytes([robot | 0x80, 60, 80]) + cit(0, 1, 2, 3) + cit(2, cx, cy, turn) + cit(3, kx, ky, 0) + bytes(16)
    data += bytes([4, 25, 190, 38, 0]) + b"keeper".ljust(42, b"\0") + "Torwart, müde".encode().ljust(32, b"\0")
    yaw_cit = math.radians(turn * 2 - 180)
    add("cit", "cit-brains", robot, data,
        {"POSE_X": cx * 10, "FPS": 25, "BATTERY": 15.2, "VOLTAGE": 152, **published(cx / 100, cy / 100, yaw_cit),
         **seen_on_field(cx / 100, cy / 100, yaw_cit, kx / 100, ky / 100)})

print(json.dumps({"messages": messages}))
