#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# @foxglove/rosmsg2-serialization 2.0.4 with @foxglove/rosmsg 5.0.5 (npm), found with Node 20.
#
# ROS 2 gives a message without fields one byte (structure_needs_at_least_one_member), whether it has constants or not.
# The library does so for a nested message that is empty, and forgets it for one that has only constants: its writer
# writes no byte, and its reader takes the byte that ROS 2 wrote for the next field, so that all that follows is wrong.
# Output seen:
#   no fields, no constants: written 0001000001 00 02, read from ROS 2's bytes: 2
#   no fields, a constant: written 0001000001 02, read from ROS 2's bytes: 0
# Needs npm and node. Fails if the behaviour is another one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund @foxglove/rosmsg2-serialization@2.0.4 @foxglove/rosmsg@5.0.5 >/dev/null

cat >nested.mjs <<'JS'
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
const ros = Uint8Array.of(0, 1, 0, 0, 1, 0, 2);  // before = 1, the byte of the nested message, after = 2
for (const [name, lines] of [["no constants", ""], ["a constant", "uint8 GOAL=1\n"]]) {
  const text = `uint8 before\nKind kind\nuint8 after\n${"=".repeat(80)}\nMSG: demo/Kind\n${lines}`;
  const definition = parse(text, { ros2: true });
  const bytes = Buffer.from(new MessageWriter(definition).writeMessage({ before: 1, kind: {}, after: 2 }));
  const written = bytes.toString("hex").replace(/^(.{10})(..)?(..)$/, (all, head, byte, last) =>
    [head, byte, last].filter((part) => part !== undefined).join(" "));
  console.log(`no fields, ${name}: written ${written}, read from ROS 2's bytes: ${new MessageReader(definition).readMessage(ros).after}`);
}
JS
seen=$(node nested.mjs)
echo "$seen"
[ "$seen" = "no fields, no constants: written 0001000001 00 02, read from ROS 2's bytes: 2
no fields, a constant: written 0001000001 02, read from ROS 2's bytes: 0" ] || { echo "The behaviour has changed." >&2; exit 1; }
