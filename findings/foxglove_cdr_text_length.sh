#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# @foxglove/cdr 3.3.0 (npm), found with Node 20.
#
# CdrWriter.string() writes the number of UTF-16 units as the length of a text, and then its UTF-8 bytes, cut to that
# length. So a text with any character beyond ASCII loses as many bytes at its end as UTF-8 needs more: "für" is read
# back as "fü". Messages written by @foxglove/rosmsg2-serialization and @foxglove/omgidl-serialization have the fault,
# too. @foxglove/rosmsg-serialization 2.0.3 (ROS 1) has its own writer and is right.
# Output seen:
#   für -> fü, length 4 with the final 0, 5 are needed
# Needs npm and node. Fails if the behaviour is another one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund @foxglove/cdr@3.3.0 >/dev/null

cat >text.mjs <<'JS'
import { CdrReader, CdrWriter } from "@foxglove/cdr";
const text = "f\u00fcr";
const writer = new CdrWriter();
writer.string(text);
const length = new DataView(writer.data.buffer, writer.data.byteOffset).getUint32(4, true);
const needed = new TextEncoder().encode(text).length + 1;
console.log(`${text} -> ${new CdrReader(writer.data).string()}, length ${length} with the final 0, ${needed} are needed`);
JS
seen=$(node text.mjs)
echo "$seen"
[ "$seen" = $'f\u00fcr -> f\u00fc, length 4 with the final 0, 5 are needed' ] || { echo "The behaviour has changed." >&2; exit 1; }
