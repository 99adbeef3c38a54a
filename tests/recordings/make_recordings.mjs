// SPDX-License-Identifier: GPL-3.0-or-later
// make_recordings.mjs FOLDER: writes the recordings in tests/data/recordings with the official
// writers of their formats, and beside each what is in it: NAME.json has for each message its
// topic, its log time in ns, its stamp if it has one, and its values by their paths.
import { CdrWriter, EncapsulationKind } from "@foxglove/cdr";
import { parse } from "@foxglove/rosmsg";
import { MessageWriter as Ros1Writer } from "@foxglove/rosmsg-serialization";
import { MessageWriter as Ros2Writer } from "@foxglove/rosmsg2-serialization";
import { McapWriter } from "@mcap/core";
import protobuf from "protobufjs";
import descriptor from "protobufjs/ext/descriptor/index.js";
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const folder = process.argv[2];
mkdirSync(folder, { recursive: true });
const start = 1_751_364_000_000_000_000n;  // 2025-07-01 10:00 UTC
const second = 1_000_000_000n;
const text = (string) => new TextEncoder().encode(string);
const separator = "=".repeat(80);

class Memory {
  #parts = [];
  #size = 0n;
  async write(bytes) {
    this.#parts.push(Uint8Array.from(bytes));
    this.#size += BigInt(bytes.byteLength);
  }
  position() { return this.#size; }
  bytes() { return Buffer.concat(this.#parts); }
}

const pack = (program) => (bytes) => ({
  compression: program,
  compressedData: execFileSync(program, ["-q", "-c", "-1"], { input: bytes }),
});

/// The values of an object by their paths; `names` says which text names an element.
const flatten = (value, path, out, names) => {
  if (value === null || value === undefined) return;
  if (typeof value === "bigint") out[path] = Number(value);
  else if (typeof value === "number" || typeof value === "string") {
    out[path] = typeof value === "number" && !Number.isFinite(value) ? String(value) : value;
  } else if (typeof value === "boolean") out[path] = value ? 1 : 0;
  else if (value.sec !== undefined && Object.keys(value).length === 2) {
    out[path] = value.sec + (value.nsec ?? value.nanosec) * 1e-9;
  } else if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    value.forEach((item, i) => flatten(item, `${path}[${item?.[names] ?? i}]`, out, names));
  } else {
    for (const [key, item] of Object.entries(value)) {
      flatten(item, path === "" ? key : `${path}.${key}`, out, names);
    }
  }
};

/// Writes a file of messages { topic, schema, encoding, time, bytes, values, stamp }.
const write = async (name, messages, { profile = "", cut = 0, note = true, ...options } = {}) => {
  const memory = new Memory();
  const writer = new McapWriter({ writable: memory, ...options });
  await writer.start({ profile, library: "tests" });
  const schemas = new Map();
  const channels = new Map();
  let sequence = 0;
  for (const message of messages) {
    if (message.schema && !schemas.has(message.schema)) {
      const { name, encoding, data } = message.schema;
      schemas.set(message.schema, await writer.registerSchema({ name, encoding, data }));
    }
    const key = message.topic + (message.publisher ?? "");
    if (!channels.has(key)) {
      channels.set(key, await writer.registerChannel({
        topic: message.topic, schemaId: message.schema ? schemas.get(message.schema) : 0,
        messageEncoding: message.encoding, metadata: new Map() }));
    }
    await writer.addMessage({ channelId: channels.get(key), sequence: sequence++,
                              logTime: message.time, publishTime: message.time, data: message.bytes });
  }
  await writer.end();
  let bytes = memory.bytes();
  if (cut > 0) bytes = bytes.subarray(0, Math.floor(bytes.length * cut));
  writeFileSync(join(folder, name + ".mcap"), bytes);
  if (!note) return;
  const lines = messages.filter((message) => message.values).map((message) => JSON.stringify({
    topic: message.topic, time: String(message.time),
    ...(message.stamp === undefined ? {} : { stamp: String(message.stamp) }), values: message.values }));
  writeFileSync(join(folder, name + ".json"), `[${lines.join(",\n ")}]\n`);
};

// The official parser refuses infinite constants, takes "#" in quotes for no comment, and finds no type
// whose section has "msg" in its name; ROS itself does.
const official = (data) => data.replace(/^.*= inf\n/m, "").replace(' "default # text"', "").replaceAll("/msg/", "/");
const ros2Schema = (name, data) => ({ name, encoding: "ros2msg", data: text(data), text: official(data) });
const ros2 = (topic, schema, time, object, { names, skip = [] } = {}) => {
  const writer = new Ros2Writer(parse(schema.text, { ros2: true }));
  const values = {};
  flatten(object, "", values, names);
  for (const path of Object.keys(values)) if (skip.some((part) => path.startsWith(part))) delete values[path];
  const stamp = object.header?.stamp ?? object.stamp;
  return { topic, schema, encoding: "cdr", time, bytes: writer.writeMessage(object), values,
           ...(stamp ? { stamp: BigInt(stamp.sec) * second + BigInt(stamp.nsec) } : {}) };
};
const stampAt = (time) => ({ sec: Number(time / second), nsec: Number(time % second) });

// --- Every type of ROS 2 -------------------------------------------------------------------------
const everything = ros2Schema("test_types/msg/Everything", `# "#" in a comment, and constants
int32 LIMIT=5
float64 ENDLESS = inf
string GREETING="a # b"
bool flag
byte one_byte
char one_char
int8 i8
uint8 u8
int16 i16
uint16 u16
int32 i32 -7
uint32 u32
int64 i64
uint64 u64
float32 f32 1.5
float64 f64
string words "default # text"
string<=10 bounded
builtin_interfaces/Time at
builtin_interfaces/Duration lasting
float64[3] fixed
float64[] open [1.0, 2.0]
int32[<=5] limited
string[] texts
string<=3[<=5] short_texts
Inner inner
Inner[2] pair
test_types/Inner[] many
Nothing nothing
uint8[] bytes
int64[] none
bool behind
${separator}
MSG: test_types/msg/Inner
int8 a
float64 b
Deep deep
${separator}
MSG: test_types/Deep
uint16[2] c
string d
${separator}
MSG: test_types/Nothing
# without fields; the official writer takes a type of constants for one without bytes, ROS does not
`);
const inner = (n) => ({ a: n, b: n / 8, deep: { c: [n + 1, n + 2], d: `deep ${n}` } });
// ASCII only: the official writer (@foxglove/cdr 3.3.0) counts UTF-16 units and cuts other texts.
const everythingOf = (n) => ({
  flag: n % 2 === 0, one_byte: 200 + n, one_char: 250, i8: -128 + n, u8: 255 - n, i16: -32768, u16: 65535,
  i32: -2147483648, u32: 4294967295, i64: -9007199254740991n, u64: 9007199254740991n, f32: 0.5 * n,
  f64: n / 3, words: `word ${n}`, bounded: "", at: { sec: 12 + n, nsec: 500000000 },
  lasting: { sec: -1, nsec: 250000000 }, fixed: [1.25, -2.5, n], open: Array.from({ length: n }, (_, i) => i / 4),
  limited: [1, 2, 3], texts: ["a", "", "ccc"], short_texts: ["x"], inner: inner(n), pair: [inner(10), inner(20)],
  many: Array.from({ length: n % 3 }, (_, i) => inner(30 + i)), nothing: {}, bytes: [7, 8], none: [], behind: true,
});
// An array of bytes is one of numbers; an empty message has no value.
await write("ros2_types", Array.from({ length: 6 }, (_, n) =>
  ros2("/everything", everything, start + BigInt(n) * second / 10n, everythingOf(n))), { profile: "ros2" });

// --- The other byte order, and XCDR2 -----------------------------------------------------------
const mixed = ros2Schema("test_types/msg/Mixed", `uint8 a
float64 b
int16 c
string d
int64[2] e
Part[] parts
float32 last
${separator}
MSG: test_types/Part
uint8 x
float64 y
`);
const mixedOf = (n) => ({ a: n, b: n + 0.125, c: -n, d: "text " + n, e: [n, -n],
                          parts: [{ x: 1, y: 1.5 }, { x: 2, y: n }], last: 0.25 });
const putMixed = (writer, m, listLengths) => {
  writer.uint8(m.a);
  writer.float64(m.b);
  writer.int16(m.c);
  writer.string(m.d);
  for (const value of m.e) writer.int64(BigInt(value));
  // XCDR2 has the length of a list of structs in bytes in front: each part is 12 bytes but the first
  // byte and its padding; computed here by hand.
  if (listLengths) writer.uint32(4 + 12 + 12);
  writer.uint32(m.parts.length);
  for (const part of m.parts) {
    writer.uint8(part.x);
    writer.float64(part.y);
  }
  writer.float32(m.last);
};
const kinds = { xcdr1_be: [EncapsulationKind.CDR_BE, false], xcdr1_le: [EncapsulationKind.CDR_LE, false],
                xcdr2_le: [EncapsulationKind.RTPS_CDR2_LE, true], xcdr2_be: [EncapsulationKind.RTPS_CDR2_BE, true],
                xcdr2_old_codes: [EncapsulationKind.CDR2_LE, true],
                xcdr2_without_lengths: [EncapsulationKind.RTPS_CDR2_LE, false] };
await write("ros2_representations", Object.entries(kinds).flatMap(([name, [kind, lengths]]) => [1, 2].map((n) => {
  const writer = new CdrWriter({ kind });
  putMixed(writer, mixedOf(n), lengths);
  const values = {};
  flatten(mixedOf(n), "", values);
  return { topic: "/" + name, schema: mixed, encoding: "cdr", time: start + BigInt(n), bytes: writer.data, values };
})), { profile: "ros2" });

// --- IDL --------------------------------------------------------------------------------------
const idl = (data, name) => ({ name, encoding: "ros2idl", data: text(data) });
const plainIdl = idl(`${separator}
IDL: test_types/msg/Plain
// a comment
#include "other.idl"
module test_types {
  module msg {
    module Plain_Constants { const int32 COUNT = 3; const string WORD = "a; b"; };
    typedef double double__3[3];
    enum Mode { IDLE, @value(5) WALK, KICK };
    @verbatim (language="comment", text="it says; \\"much\\"" "and more")
    struct Plain {
      @unit(value="V") float volts;
      double__3 place;
      sequence<long, 4> numbers;
      sequence<test_types::msg::Item> items;
      string<20> name;
      Mode mode;
      octet raw[2][2];
      boolean on;
      unsigned long long big;
      wstring wide;
    };
  };
};
${separator}
IDL: test_types/msg/Item
module test_types { module msg { struct Item { short id; double value; }; }; };
`, "test_types/msg/Plain");
const plainOf = (n) => ({ volts: 12.5, place: [1, 2, n], numbers: [5, 6], items: [{ id: 1, value: 0.5 }],
                          name: "idl " + n, mode: 6, raw: [1, 2, 3, 4], on: true, big: 12345678901n, wide: "wïde" });
const plainBytes = (p) => {
  const writer = new CdrWriter({ kind: EncapsulationKind.CDR_LE });
  writer.float32(p.volts);
  for (const value of p.place) writer.float64(value);
  writer.uint32(p.numbers.length);
  for (const value of p.numbers) writer.int32(value);
  writer.uint32(p.items.length);
  for (const item of p.items) { writer.int16(item.id); writer.float64(item.value); }
  writer.string(p.name);
  writer.uint32(p.mode);
  for (const value of p.raw) writer.uint8(value);
  writer.int8(1);
  writer.uint64(p.big);
  writer.uint32(p.wide.length);  // as Fast CDR writes it: 4 bytes a character
  for (const letter of p.wide) writer.uint32(letter.codePointAt(0));
  return writer.data;
};
const appendableIdl = idl(`module test_types { module msg {
  @appendable struct Inside { long a; string b; };
  @mutable struct Loose { @id(7) double first; @optional @id(9) long second; Inside third; };
  @appendable struct Grown { @optional float maybe; Inside inside; Loose loose; unsigned short behind; };
}; };`, "test_types/msg/Grown");
/// CDR by hand, because the official reader and writer leave out lengths of lists.
class Bytes {
  #bytes = [];
  get size() { return this.#bytes.length; }
  align(n) { while (this.#bytes.length % n !== 0) this.#bytes.push(0); }
  put(size, fill) {
    this.align(Math.min(size, 4));
    const view = new DataView(new ArrayBuffer(size));
    fill(view);
    this.#bytes.push(...new Uint8Array(view.buffer));
  }
  u8(v) { this.put(1, (d) => d.setUint8(0, v)); }
  u16(v) { this.put(2, (d) => d.setUint16(0, v, true)); }
  u32(v) { this.put(4, (d) => d.setUint32(0, v >>> 0, true)); }
  i32(v) { this.put(4, (d) => d.setInt32(0, v, true)); }
  f32(v) { this.put(4, (d) => d.setFloat32(0, v, true)); }
  f64(v) { this.put(8, (d) => d.setFloat64(0, v, true)); }
  string(v) { this.u32(v.length + 1); for (const b of text(v)) this.u8(b); this.u8(0); }
  part(write) {
    this.u32(0);
    const at = this.#bytes.length;
    write();
    new Uint8Array(new Uint32Array([this.#bytes.length - at]).buffer).forEach((b, i) => { this.#bytes[at - 4 + i] = b; });
  }
  done(code) { return Uint8Array.from([0, code, 0, 0, ...this.#bytes]); }
}
const grownBytes = (n, hasMaybe, hasSecond) => {
  const out = new Bytes();
  const inside = (a, b) => out.part(() => { out.i32(a); out.string(b); });
  out.part(() => {
    out.u8(hasMaybe ? 1 : 0);
    if (hasMaybe) out.f32(0.5);
    inside(n, "in");
    out.part(() => {
      out.u32(3 << 28 | 7);
      out.f64(n / 2);
      if (hasSecond) { out.u32(2 << 28 | 9); out.i32(-n); }
      // A member of its own length: code 5, its length is that of the part.
      out.align(4);
      out.u32(5 << 28 | 10);
      inside(n + 1, "third");
    });
    out.u16(n);
  });
  return out.done(9);
};
const grownOf = (n, hasMaybe, hasSecond) => ({
  ...(hasMaybe ? { maybe: 0.5 } : {}), inside: { a: n, b: "in" },
  loose: { first: n / 2, ...(hasSecond ? { second: -n } : {}), third: { a: n + 1, b: "third" } }, behind: n });
const idlMessage = (topic, schema, n, object, bytes) => {
  const values = {};
  flatten(object, "", values);
  return { topic, schema, encoding: "cdr", time: start + BigInt(n), bytes, values };
};
await write("ros2_idl", [
  ...[1, 2].map((n) => idlMessage("/plain", plainIdl, n, plainOf(n), plainBytes(plainOf(n)))),
  ...[[3, true, true], [4, false, true], [5, true, false]].map(([n, maybe, more]) =>
    idlMessage("/grown", appendableIdl, n, grownOf(n, maybe, more), grownBytes(n, maybe, more))),
], { profile: "ros2" });

// --- ROS 1 -------------------------------------------------------------------------------------
const ros1Text = `Header header
byte small
char letter
bool on
time at
duration lasting
float64[] numbers
geometry_msgs/Point[2] points
string words
${separator}
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
${separator}
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
`;
const ros1Schema = { name: "test_types/One", encoding: "ros1msg", data: text(ros1Text) };
await write("ros1", [0, 1, 2].map((n) => {
  const object = { header: { seq: n, stamp: { sec: 100 + n, nsec: 5 }, frame_id: "map" }, small: -3, letter: 65,
                   on: true, at: { sec: 3000000000, nsec: 1 }, lasting: { sec: -2, nsec: 0 }, numbers: [n, 2.5],
                   points: [{ x: 1, y: 2, z: 3 }, { x: n, y: 0, z: -1 }], words: "one " + n };
  const values = {};
  flatten(object, "", values);
  return { topic: "/one", schema: ros1Schema, encoding: "ros1", time: start + BigInt(n) * second,
           bytes: new Ros1Writer(parse(ros1Text)).writeMessage(object), values,
           stamp: BigInt(100 + n) * second + 5n };
}), { profile: "ros1" });

// --- JSON --------------------------------------------------------------------------------------
const jsonSchema = { name: "robot", encoding: "jsonschema", data: text(JSON.stringify({ type: "object" })) };
await write("json", [0, 1, 2, 3].flatMap((n) => {
  const time = start + BigInt(n) * second;
  const object = { timestamp: { sec: Number(time / second), nsec: n }, x: n / 2, on: n > 1, name: "B1 äöü",
                   nested: { list: [1, n], deep: { y: -n } }, balls: [{ name: "first", x: 1 }, { name: "second", x: n }],
                   ...(n === 3 ? { extra: 5 } : {}), nothing: null };
  const values = {};
  flatten(object, "", values, "name");
  const bytes = text(JSON.stringify(object));
  const stamp = time + BigInt(n);
  return [{ topic: "/with_schema", schema: jsonSchema, encoding: "json", time, bytes, values, stamp },
          { topic: "/without", encoding: "json", time, bytes, values, stamp }];
}));

// --- protobuf ----------------------------------------------------------------------------------
const { root } = protobuf.parse(`syntax = "proto3";
package soccer;
message Stamp { int64 seconds = 1; }
message Robot {
  enum Role { NONE = 0; KEEPER = 1; STRIKER = 2; }
  uint32 id = 1; double x = 2; float y = 3; bool fallen = 4; string name = 5; Role role = 6;
  repeated double joints = 7; repeated Ball balls = 8; map<string, int32> scores = 9;
  optional sint64 offset = 10; oneof what { int32 kick = 11; string say = 12; }
  bytes picture = 13; fixed32 f = 14; sfixed64 g = 15;
}
message Ball { double distance = 1; double angle = 2; }
`, { keepCase: true });
root.resolveAll();
const Robot = root.lookupType("soccer.Robot");
const protobufSchema = { name: "soccer.Robot", encoding: "protobuf",
                         data: descriptor.FileDescriptorSet.encode(root.toDescriptor("proto3")).finish() };
await write("protobuf", [0, 1, 2].map((n) => {
  const object = { id: n, x: n / 4, y: 0.5, fallen: n === 1, name: "robot " + n, role: n, joints: [0.5, n],
                   balls: [{ distance: 1.5, angle: -n }], scores: { home: n, away: 2 }, f: 7, g: -9,
                   ...(n > 0 ? { offset: -n } : {}), ...(n === 2 ? { say: "hello" } : { kick: 3 }) };
  const values = {};
  flatten(object, "", values);
  for (const side of ["home", "away"]) {
    values[`scores[${side}]`] = values[`scores.${side}`];
    delete values[`scores.${side}`];
  }
  return { topic: "/robot", schema: protobufSchema, encoding: "protobuf", time: start + BigInt(n) * second,
           bytes: Robot.encode(Robot.fromObject({ ...object, picture: [1, 2, 3] })).finish(), values };
}));

// --- The forms that a file can have --------------------------------------------------------------
const counter = ros2Schema("test_types/msg/Counter", "uint32 count\nstring name\n");
const counts = (from, until) => Array.from({ length: until - from }, (_, i) => ros2(
  i % 3 === 0 ? "/b" : "/a", counter, start + BigInt(from + i) * second / 100n, { count: from + i, name: "n" }));
const shuffled = counts(0, 60).map((message, i, all) => all[i ^ 5] ?? message);
await write("form_lz4", counts(0, 60), { chunkSize: 500, compressChunk: pack("lz4") });
await write("form_zstd", counts(0, 60), { chunkSize: 500, compressChunk: pack("zstd") });
await write("form_no_chunks", counts(0, 60), { useChunks: false });
await write("form_no_summary", counts(0, 60), { chunkSize: 500, useStatistics: false, useSummaryOffsets: false,
  repeatSchemas: false, repeatChannels: false, useChunkIndex: false, useMessageIndex: false });
await write("form_unordered", shuffled, { chunkSize: 300 });
await write("form_cut", counts(0, 60), { chunkSize: 500, cut: 0.5 });
await write("form_split_0", counts(0, 30), { chunkSize: 500 });
await write("form_split_1", counts(30, 60), { chunkSize: 500 });

// --- A robot that walks around --------------------------------------------------------------------
const header = `std_msgs/Header header\n`;
const headerTypes = `${separator}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n`;
const poseTypes = `${separator}\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n${separator}
MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n${separator}
MSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n`;
const poseSchema = ros2Schema("geometry_msgs/msg/PoseWithCovarianceStamped",
  `${header}PoseWithCovariance pose\n${headerTypes}${separator}
MSG: geometry_msgs/PoseWithCovariance\nPose pose\nfloat64[36] covariance\n${poseTypes}`);
const jointSchema = ros2Schema("sensor_msgs/msg/JointState",
  `${header}string[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n${headerTypes}`);
const batterySchema = ros2Schema("sensor_msgs/msg/BatteryState",
  `${header}float32 voltage\nfloat32 temperature\nfloat32 current\nfloat32 percentage\n${headerTypes}`);
const imuSchema = ros2Schema("sensor_msgs/msg/Imu", `${header}geometry_msgs/Quaternion orientation
float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n${headerTypes}${separator}
MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n${separator}
MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n`);
const tfSchema = ros2Schema("tf2_msgs/msg/TFMessage", `geometry_msgs/TransformStamped[] transforms\n${separator}
MSG: geometry_msgs/TransformStamped\n${header}string child_frame_id\nTransform transform\n${separator}
MSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation\n${headerTypes}${separator}
MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n${separator}
MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n`);
const logSchema = ros2Schema("rcl_interfaces/msg/Log", `builtin_interfaces/Time stamp\nuint8 level\nstring name
string msg\nstring file\nstring function\nuint32 line\n`);
const imageSchema = ros2Schema("sensor_msgs/msg/Image", `${header}uint32 height\nuint32 width\nuint8[] data\n${headerTypes}`);
// Images that are never read, in chunks that are not compressed.
await write("images_between", counts(0, 40).flatMap((message, i) => [message, ...(i % 15 === 7 ? [{
  topic: "/camera/image", schema: imageSchema, encoding: "cdr", time: message.time,
  bytes: new Uint8Array(17_000).fill(0x55) }] : [])]), { chunkSize: 40_000 });
const ballSchema = ros2Schema("team_msgs/msg/Ball", `${header}float32 x_mm\nfloat32 y_mm\nbool seen\n${headerTypes}`);
const refereeSchema = ros2Schema("team_msgs/msg/GameState", "uint8 state\nint16 seconds\nuint8 own_score\nuint8 rival_score\n");
const yawOf = (yaw) => ({ x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) });
const walk = [];
for (let n = 0; n < 200; ++n) {
  const time = start + BigInt(n) * second / 10n, sent = time + 3_000_000n;
  const h = { stamp: stampAt(time), frame_id: "map" };
  const yaw = n * 0.01, x = -3 + n * 0.02, y = Math.sin(n * 0.05);
  const put = (...of) => walk.push(ros2(...of));
  put("/robot3/amcl_pose", poseSchema, sent, { header: h, pose: { pose: { position: { x, y, z: 0 },
    orientation: yawOf(yaw) }, covariance: Array.from({ length: 36 }, (_, i) => (i === 0 || i === 7 ? 0.04 : 0)) } });
  put("/robot3/joint_states", jointSchema, sent, { header: h, name: ["head_yaw", "left_knee", "right_knee"],
    position: [n * 0.001, 0.5, -0.5], velocity: [0, 1, 2], effort: [] });
  put("/robot3/imu/data", imuSchema, sent, { header: h, orientation: n >= 100 && n < 130
    ? { x: Math.SQRT1_2, y: 0, z: 0, w: Math.SQRT1_2 } : yawOf(yaw), orientation_covariance: Array(9).fill(0),
    angular_velocity: { x: 0, y: 0, z: 0.1 } });
  put("/robot3/ball", ballSchema, sent, { header: h, x_mm: 1000, y_mm: n * 5, seen: n < 150 });
  put("/tf", tfSchema, sent, { transforms: [
    { header: { stamp: h.stamp, frame_id: "map" }, child_frame_id: "robot7/odom", transform: { translation: { x: 1, y: 0, z: 0 }, rotation: yawOf(Math.PI / 2) } },
    { header: { stamp: h.stamp, frame_id: "robot7/odom" }, child_frame_id: "robot7/base_link", transform: { translation: { x: n * 0.01, y: 0, z: 0.3 }, rotation: yawOf(0) } } ] });
  if (n % 10 === 0) {
    put("/robot3/battery_state", batterySchema, sent, { header: h, voltage: 12.0 - n * 0.008, temperature: 30, current: -2, percentage: 0.75 });
    put("/rosout", logSchema, sent, { stamp: h.stamp, level: n === 50 ? 40 : 20, name: "walker", msg: `step ${n}`, file: "w.cpp", function: "f", line: n });
    walk.push({ topic: "/camera/image", schema: imageSchema, encoding: "cdr", time: sent, bytes: new Uint8Array(2000) });
    put("/gamestate", refereeSchema, sent, { state: n < 50 ? 2 : 3, seconds: 600 - Math.floor(n / 10), own_score: n >= 120 ? 1 : 0, rival_score: 0 });
  }
}
await write("robot_walks", walk, { profile: "ros2", chunkSize: 20_000, compressChunk: pack("zstd"), note: false });
