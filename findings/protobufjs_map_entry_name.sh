#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# protobufjs 7.5.4 (npm) with its ext/descriptor, and protoc of libprotobuf 3.21.12 (Debian 12), found with Node 20.
#
# Root.toDescriptor() names the entry type of a map field by the field ("Scores" for "scores"). The rule of Protocol
# Buffers is "ScoresEntry", and the C++ library refuses the file: so a recording whose schema was made this way cannot
# be opened by programs that use libprotobuf's descriptor pool.
# Output seen:
#   the entries of scores are of the type Scores
#   demo.proto: map_entry should not be set explicitly. Use map<KeyType, ValueType> instead.
# Needs npm, node and Debian 12's protobuf-compiler. Fails if the behaviour is another one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
[ "$(protoc --version)" = "libprotoc 3.21.12" ] || { echo "This needs protoc 3.21.12 (protobuf-compiler)." >&2; exit 2; }
npm install --silent --no-audit --no-fund protobufjs@7.5.4 >/dev/null

cat >schema.mjs <<'JS'
import { writeFileSync } from "node:fs";
import protobuf from "protobufjs";
import "protobufjs/ext/descriptor/index.js";
const { root } = protobuf.parse('syntax = "proto3"; package demo; message Match { map<string, int32> scores = 1; }');
const files = root.resolveAll().toDescriptor("proto3");
console.log(`the entries of scores are of the type ${files.file[0].messageType[0].nestedType[0].name}`);
writeFileSync("schema.bin", files.constructor.encode(files).finish());
JS
seen=$(node schema.mjs; ! protoc --descriptor_set_in=schema.bin --decode=demo.Match demo.proto </dev/null 2>&1 || echo "protoc takes it")
echo "$seen"
[ "$seen" = "the entries of scores are of the type Scores
demo.proto: map_entry should not be set explicitly. Use map<KeyType, ValueType> instead." ] || { echo "The behaviour has changed." >&2; exit 1; }
