// Watches a run under way with the package @foxglove/ws-protocol, Foxglove's client of its websocket protocol, until the
// server closes: every channel must have had messages, in JSON.
import protocol from '@foxglove/ws-protocol';
import { WebSocket } from 'ws';

const [address] = process.argv.slice(2);
const { FoxgloveClient } = protocol;
const socket = new WebSocket(address.replace('http', 'ws'), [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
const client = new FoxgloveClient({ ws: socket });
const counts = new Map(); // by topic
const topics = new Map(); // by subscription

client.on('advertise', (channels) => {
  for (const { id, topic } of channels) {
    topics.set(client.subscribe(id), topic);
    counts.set(topic, 0);
  }
});
client.on('message', ({ subscriptionId, data }) => {
  JSON.parse(new TextDecoder().decode(data));
  const topic = topics.get(subscriptionId);
  counts.set(topic, counts.get(topic) + 1);
});
client.on('error', (error) => {
  console.error(`live.mjs: ${address}: ${error.message ?? error}`);
  process.exit(1);
});
client.on('close', () => {
  console.log(`${address}: ${[...counts].map(([topic, count]) => `${count} messages of ${topic}`).join(', ')}`);
  process.exit(counts.size > 0 && [...counts.values()].every((count) => count > 0) ? 0 : 1);
});
