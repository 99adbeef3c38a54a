// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a session with the official readers and prints everything that stands in it, one line each:
//   row TOPIC SEQUENCE LOGTIME PUBLISHTIME VALUE...   values as the hex of a big-endian double, or nan
//   json TOPIC SEQUENCE LOGTIME PUBLISHTIME HEX       the bytes of the message
//   attachment NAME MEDIATYPE HEX
//   metadata NAME KEY=VALUE HEX
//   schema TOPIC NAME ENCODING FIELD...
// Ends with code 1 when checksums, indexes or counts are wrong, or the two readers disagree.
import { crc32 } from "@foxglove/crc";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import { open, readFile } from "node:fs/promises";

const path = process.argv[2];
const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };
const check = (truth, sentence) => {
  if (!truth) throw new Error(sentence);
};

class FileReadable {
  constructor(handle) { this.handle = handle; }
  async size() { return BigInt((await this.handle.stat()).size); }
  async read(offset, length) {
    const bytes = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(bytes, 0, bytes.length, Number(offset));
    check(bytesRead === bytes.length, "the file is shorter than its index says");
    return bytes;
  }
}

const hex = (bytes) => Buffer.from(bytes).toString("hex");
const hexOfDouble = (value) => {
  if (Number.isNaN(value)) return "nan";
  const buffer = Buffer.alloc(8);
  buffer.writeDoubleBE(value);
  return buffer.toString("hex");
};

const decoders = new Map();
const line = (message, channel, schema) => {
  const head = `${channel.topic} ${message.sequence} ${message.logTime} ${message.publishTime}`;
  if (channel.messageEncoding === "json") {
    JSON.parse(new TextDecoder("utf8", { fatal: true }).decode(message.data));
    if (schema) JSON.parse(new TextDecoder().decode(schema.data));
    return `json ${head} ${hex(message.data)}`;
  }
  check(channel.messageEncoding === "cdr" && schema.encoding === "ros2msg", "a channel of another kind");
  let decoder = decoders.get(channel.id);
  if (!decoder) {
    const definitions = parse(new TextDecoder().decode(schema.data), { ros2: true });
    decoder = { reader: new MessageReader(definitions),
                fields: definitions[0].definitions.filter((field) => !field.isConstant) };
    decoders.set(channel.id, decoder);
    console.log(`schema ${channel.topic} ${schema.name} ${schema.encoding} ` +
                decoder.fields.map((field) => `${field.type}:${field.name}`).join(" "));
  }
  const values = decoder.reader.readMessage(message.data);
  return `row ${head} ` + decoder.fields.map((field) => hexOfDouble(values[field.name])).join(" ");
};

const handle = await open(path);
const indexed = await McapIndexedReader.Initialize({ readable: new FileReadable(handle), decompressHandlers });
const lines = [];
for await (const message of indexed.readMessages({ validateCrcs: true })) {
  const channel = indexed.channelsById.get(message.channelId);
  lines.push(line(message, channel, indexed.schemasById.get(channel.schemaId)));
}
for (const text of lines) console.log(text);
for await (const attachment of indexed.readAttachments({ validateCrcs: true })) {
  console.log(`attachment ${attachment.name} ${attachment.mediaType} ${hex(attachment.data)}`);
}
for await (const metadata of indexed.readMetadata()) {
  for (const [key, value] of metadata.metadata) {
    console.log(`metadata ${metadata.name} ${key} ${hex(new TextEncoder().encode(value))}`);
  }
}

// The same from front to back, without the index.
const bytes = await readFile(path);
const stream = new McapStreamReader({ includeChunks: true, decompressHandlers, validateCrcs: true });
stream.append(bytes);
const channels = new Map();
const schemas = new Map();
const streamed = [];
const counts = {};
const perChannel = new Map();
let beforeEnd = true;
for (let record; (record = stream.nextRecord()); ) {
  if (beforeEnd) counts[record.type] = (counts[record.type] ?? 0) + 1;
  if (record.type === "Schema") schemas.set(record.id, record);
  if (record.type === "Channel") channels.set(record.id, record);
  if (record.type === "Message") {
    const channel = channels.get(record.channelId);
    check(channel, "a message before its channel");
    perChannel.set(record.channelId, (perChannel.get(record.channelId) ?? 0) + 1);
    streamed.push(line(record, channel, schemas.get(channel.schemaId)));
  }
  if (record.type === "DataEnd") beforeEnd = false;
}
check(stream.done(), "the file does not end");
const inOrder = (list) => [...list].sort().join("\n");
check(inOrder(lines) === inOrder(streamed), "the index does not find the same messages");

const dataEnd = Number(indexed.dataEndOffset);
check(indexed.dataSectionCrc !== undefined && indexed.dataSectionCrc !== 0, "no checksum of the data section");
check(crc32(bytes.subarray(0, dataEnd)) === indexed.dataSectionCrc, "the checksum of the data section is wrong");
check(indexed.footer.summaryCrc !== 0, "no checksum of the summary");  // Initialize() has compared it

const { statistics } = indexed;
check(statistics.messageCount === BigInt(lines.length), "another count of messages");
check(statistics.chunkCount === counts.Chunk && indexed.chunkIndexes.length === counts.Chunk, "another count of chunks");
check(statistics.attachmentCount === (counts.Attachment ?? 0), "another count of attachments");
check(statistics.metadataCount === (counts.Metadata ?? 0), "another count of metadata");
check(statistics.channelCount === channels.size && statistics.schemaCount === schemas.size, "another count of channels");
for (const [id, count] of perChannel) {
  check(statistics.channelMessageCounts.get(id) === BigInt(count), "another count of a channel");
}
check(indexed.summaryOffsetsByOpcode.size >= 5, "summary offsets are missing");
check(counts.MessageIndex > 0, "message indexes are missing");
console.log(`counts ${lines.length} ${counts.Chunk}`);
