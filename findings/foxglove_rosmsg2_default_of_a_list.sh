#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# @foxglove/rosmsg2-serialization 2.0.4 with @foxglove/rosmsg 5.0.5 (npm), found with Node 20.
#
# A field that a message does not have is written with the default of its definition. For a list of any length
# ("uint8[] gains [1, 2]") the writer writes the count 0 and then all numbers of the default: readers, its own too, take
# the numbers for the fields that follow. Given explicitly, the same list is written with its count.
# Output seen:
#   by default: 0001000000000000010207, read {"gains":[],"next":1}
#   given: 0001000002000000010207, read {"gains":[1,2],"next":7}
# Needs npm and node. Fails if the behaviour is another one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund @foxglove/rosmsg2-serialization@2.0.4 @foxglove/rosmsg@5.0.5 >/dev/null

cat >default.mjs <<'JS'
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
const definition = parse("uint8[] gains [1, 2]\nuint8 next", { ros2: true });
for (const [name, message] of [["by default", { next: 7 }], ["given", { gains: [1, 2], next: 7 }]]) {
  const bytes = new MessageWriter(definition).writeMessage(message);
  const read = new MessageReader(definition).readMessage(bytes);
  console.log(`${name}: ${Buffer.from(bytes).toString("hex")}, read ${JSON.stringify({ gains: [...read.gains], next: read.next })}`);
}
JS
seen=$(node default.mjs)
echo "$seen"
[ "$seen" = 'by default: 0001000000000000010207, read {"gains":[],"next":1}
given: 0001000002000000010207, read {"gains":[1,2],"next":7}' ] || { echo "The behaviour has changed." >&2; exit 1; }
