// SPDX-License-Identifier: GPL-3.0-or-later
// decode_recording.mjs FILE: decodes every message of a ROS 2 recording but its images with the
// official packages, and prints how long that takes. The yardstick of bench_import.
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapStreamReader } from "@mcap/core";
import { createReadStream } from "node:fs";

const begin = performance.now();
const schemas = new Map(), channels = new Map();
let messages = 0, numbers = 0;
const take = (record) => {
  if (record.type === "Schema") schemas.set(record.id, record);
  if (record.type === "Channel" && !channels.has(record.id)) {
    const schema = schemas.get(record.schemaId);
    const isImage = schema.name.endsWith("Image");
    channels.set(record.id, isImage ? null : new MessageReader(
      parse(new TextDecoder().decode(schema.data), { ros2: true })));
  }
  if (record.type !== "Message") return;
  const reader = channels.get(record.channelId);
  if (!reader) return;
  const message = reader.readMessage(record.data);
  messages += 1;
  numbers += message.position?.[0] ?? message.pose?.covariance[0] ?? message.transforms[0].transform.translation.x;
};
const stream = new McapStreamReader({ validateCrcs: false });
for await (const part of createReadStream(process.argv[2], { highWaterMark: 1 << 20 })) {
  stream.append(part);
  for (let record; (record = stream.nextRecord()); ) take(record);
}
const seconds = (performance.now() - begin) / 1000;
console.log(`${messages} messages in ${seconds.toFixed(3)} s, ${Math.round(messages / seconds)} messages/s (${numbers})`);
