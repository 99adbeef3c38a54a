// SPDX-License-Identifier: GPL-3.0-or-later
// read_server.mjs URL SECONDS STEPS: connects to a server of Foxglove's protocol and prints what it sends, one JSON
// object a line. STEPS is "official" (the official client subscribes to every channel) or a list of requests of
// playback control for the newer subprotocol, such as "seek:12.5,play:2,pause": seconds after the first moment.
import protocol from "@foxglove/ws-protocol";
import { WebSocket } from "ws";

const { FoxgloveClient } = protocol;

const [url, seconds, steps] = process.argv.slice(2);
const print = (object) => console.log(JSON.stringify(object, (key, value) => (typeof value === "bigint" ? String(value) : value)));
const decode = (data) => JSON.parse(new TextDecoder().decode(data));
const end = () => process.stdout.write("", () => process.exit(0));
setTimeout(end, 1000 * Number(seconds));

function official() {
  const client = new FoxgloveClient({ ws: new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
  const topics = new Map();
  client.on("error", (error) => print({ error: error.message }));
  client.on("serverInfo", (info) => print({ serverInfo: info }));
  client.on("status", (status) => print({ status }));
  client.on("time", ({ timestamp }) => print({ now: timestamp }));
  client.on("advertise", (channels) => {
    for (const channel of channels) {
      print({ channel });
      topics.set(client.subscribe(channel.id), channel.topic);
    }
  });
  client.on("message", ({ subscriptionId, timestamp, data }) =>
    print({ topic: topics.get(subscriptionId), time: timestamp, message: decode(data) }));
}

function newer() {
  const socket = new WebSocket(url, ["other.v9", "foxglove.sdk.v1"]);
  socket.binaryType = "nodebuffer";
  const requests = steps.split(",");
  let first;
  const ask = () => {
    const request = requests.shift();
    if (request === undefined) return;
    const [what, value] = request.split(":");
    const id = Buffer.from(`request ${request}`);
    const out = Buffer.alloc(19 + id.length);
    out[0] = 3;
    out[1] = what === "play" ? 0 : 1;
    out.writeFloatLE(what === "play" ? Number(value) : 1, 2);
    out[6] = what === "seek" ? 1 : 0;
    out.writeBigUInt64LE(what === "seek" ? first + BigInt(Math.round(Number(value) * 1e9)) : 0n, 7);
    out.writeUInt32LE(id.length, 15);
    id.copy(out, 19);
    socket.send(out);
  };
  socket.on("error", (error) => print({ error: error.message }));
  socket.on("open", () => print({ subprotocol: socket.protocol }));
  socket.on("message", (data, isBinary) => {
    if (!isBinary) {
      const text = JSON.parse(data.toString());
      print(text);
      if (text.op === "serverInfo") {
        first = BigInt(text.dataStartTime.sec) * 1000000000n + BigInt(text.dataStartTime.nsec);
      }
      if (text.op === "advertise") {
        const subscriptions = text.channels.map(({ id }) => ({ id: 100 + id, channelId: id }));
        socket.send(JSON.stringify({ op: "subscribe", subscriptions }));
        ask();
      }
    } else if (data[0] === 1) {
      print({ subscription: data.readUInt32LE(1), time: data.readBigUInt64LE(5), message: decode(data.subarray(13)) });
    } else if (data[0] === 5) {
      const state = {
        status: data[1],
        time: Number(data.readBigUInt64LE(2) - first) / 1e9,
        speed: data.readFloatLE(10),
        didSeek: data[14],
        request: data.subarray(19, 19 + data.readUInt32LE(15)).toString(),
      };
      print({ playback: state });
      if (state.request !== "") ask();
    }
  });
}

if (steps === "official") official();
else newer();
