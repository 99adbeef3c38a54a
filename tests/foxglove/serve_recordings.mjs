// SPDX-License-Identifier: GPL-3.0-or-later
// serve_recordings.mjs FILE...: an official server of Foxglove's protocol on a free port of this
// computer, which it prints. Its channels are those of the MCAP files; who subscribes to one gets
// all its messages. A line "restart" on stdin ends it and begins a new session on the same port with
// other ids, "remove TOPIC" takes a channel away.
import { McapIndexedReader } from "@mcap/core";
import ws from "@foxglove/ws-protocol";
import { createRequire } from "node:module";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
const { FoxgloveServer } = ws;
const { WebSocketServer } = createRequire(import.meta.url)("ws");

const unpack = (program) => (bytes) =>
  new Uint8Array(execFileSync(program, ["-q", "-d", "-c"], { input: bytes, maxBuffer: 1 << 28 }));

const channels = [];  // { topic, encoding, schemaName, schema, schemaEncoding, messages }
for (const file of process.argv.slice(2)) {
  const bytes = readFileSync(file);
  const reader = await McapIndexedReader.Initialize({
    readable: {
      size: async () => BigInt(bytes.length),
      read: async (offset, size) =>
        new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
    },
    decompressHandlers: { zstd: unpack("zstd"), lz4: unpack("lz4") },
  });
  const known = new Map();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    const data = Buffer.from(schema?.data ?? []);
    const one = {
      topic: channel.topic,
      encoding: channel.messageEncoding,
      schemaName: schema?.name ?? "",
      schema: data.toString(schema?.encoding === "protobuf" ? "base64" : "utf8"),
      schemaEncoding: schema?.encoding,
      messages: [],
    };
    known.set(channel.id, one);
    channels.push(one);
  }
  for await (const message of reader.readMessages()) {
    known.get(message.channelId).messages.push({ time: message.logTime, data: message.data });
  }
}

let run, port = 0, session = 0;
const start = () => {
  const server = new FoxgloveServer({ name: "recordings", sessionId: `run ${++session}` });
  const sockets = new WebSocketServer({
    host: "127.0.0.1", port, handleProtocols: (offered) => server.handleProtocols(offered) });
  const ids = new Map();
  // Other ids in each session.
  for (let i = 1; i < session; ++i) server.removeChannel(server.addChannel(channels[0]));
  for (const { messages, ...channel } of channels) {
    ids.set(server.addChannel(channel), { topic: channel.topic, messages });
  }
  server.on("subscribe", (id) => {
    console.log(`subscribed ${ids.get(id).topic}`);
    for (const { time, data } of ids.get(id).messages) server.sendMessage(id, time, data);
  });
  server.on("error", (error) => console.log(`error ${error}`));
  sockets.on("connection", (connection, request) =>
    server.handleConnection(connection, request.socket.remoteAddress));
  sockets.on("listening", () => {
    port = sockets.address().port;
    console.log(`port ${port}`);
  });
  run = { server, sockets, ids };
};
start();

for await (const line of createInterface({ input: process.stdin })) {
  if (line === "restart") {
    for (const client of run.sockets.clients) client.terminate();
    await new Promise((done) => run.sockets.close(done));
    start();
  } else if (line.startsWith("remove ")) {
    for (const [id, { topic }] of run.ids) {
      if (topic === line.slice(7)) run.server.removeChannel(id);
    }
  }
}
process.exit(0);
