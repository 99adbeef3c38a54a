// SPDX-License-Identifier: GPL-3.0-or-later
// Writes all messages of a session into a new file with the official writer:
//   node rewrite_session.mjs FROM TO ORDER [LEFT_OUT...]
// ORDER: topics (one topic after the other), backwards, or foreign (messages of another program
// instead). LEFT_OUT: what the new file does without, such as repeatChannels or useStatistics, or
// useChunks; these are options of McapWriter.
import { McapIndexedReader, McapWriter } from "@mcap/core";
import { decompress } from "fzstd";
import { open } from "node:fs/promises";

const [from, to, order, ...leftOut] = process.argv.slice(2);
const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };

class FileReadable {
  constructor(handle) { this.handle = handle; }
  async size() { return BigInt((await this.handle.stat()).size); }
  async read(offset, length) {
    const bytes = new Uint8Array(Number(length));
    await this.handle.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  }
}

class FileWritable {
  at = 0;
  constructor(handle) { this.handle = handle; }
  position() { return BigInt(this.at); }
  async write(bytes) {
    await this.handle.write(bytes, 0, bytes.length, this.at);
    this.at += bytes.length;
  }
}

const output = await open(to, "w");
const writer = new McapWriter({
  writable: new FileWritable(output),
  chunkSize: 20_000,
  ...Object.fromEntries(leftOut.map((option) => [option, false])),
});
if (order === "foreign") {
  await writer.start({ profile: "ros2", library: "libmcap 1.1.0" });
  const text = new TextEncoder();
  const schema = await writer.registerSchema({
    name: "std_msgs/msg/Float64", encoding: "ros2msg", data: text.encode("float64 data") });
  const topics = [["/battery", "cdr", schema], ["/notes", "json", 0]];
  for (const [topic, messageEncoding, schemaId] of topics) {
    const channelId = await writer.registerChannel({ topic, messageEncoding, schemaId, metadata: new Map() });
    for (let i = 0; i < 1000; ++i) {
      const logTime = 1_700_000_000_000_000_000n + BigInt(i) * 10_000_000n;
      await writer.addMessage({
        channelId, sequence: i, logTime, publishTime: logTime, data: text.encode(`{"number":${i}}`) });
    }
  }
} else {
  const input = await open(from, "r");
  const reader = await McapIndexedReader.Initialize({ readable: new FileReadable(input), decompressHandlers });
  await writer.start({ profile: reader.header.profile, library: reader.header.library });
  for await (const metadata of reader.readMetadata()) await writer.addMetadata(metadata);
  const messages = [];
  for await (const message of reader.readMessages()) {
    messages.push({ ...message, data: Uint8Array.from(message.data) });
  }
  if (order === "backwards") messages.reverse();
  else messages.sort((a, b) => a.channelId - b.channelId);  // stable
  const schemas = new Map([[0, 0]]), channels = new Map();
  for (const [id, channel] of [...reader.channelsById].sort((a, b) => a[0] - b[0])) {
    if (!schemas.has(channel.schemaId)) {
      schemas.set(channel.schemaId, await writer.registerSchema(reader.schemasById.get(channel.schemaId)));
    }
    channels.set(id, await writer.registerChannel({ ...channel, schemaId: schemas.get(channel.schemaId) }));
  }
  for (const message of messages) {
    await writer.addMessage({ ...message, channelId: channels.get(message.channelId) });
  }
  await input.close();
}
await writer.end();
await output.close();
