// Reads run.mcap with the packages @mcap/core, @foxglove/omgidl-parser and @foxglove/omgidl-serialization, with which
// Foxglove and Lichtblick read it: decodes every message by the definition of its type in the file.
import fs from 'node:fs';

import { parseIDL } from '@foxglove/omgidl-parser';
import { MessageReader } from '@foxglove/omgidl-serialization';
import { McapStreamReader } from '@mcap/core';

const [file] = process.argv.slice(2);
const reader = new McapStreamReader({ validateCrcs: true });
reader.append(fs.readFileSync(file));
const schemas = new Map();
const decoders = new Map(); // by channel
const types = new Set();
let count = 0;
for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
  if (record.type === 'Schema') schemas.set(record.id, record);
  if (record.type === 'Channel') {
    const schema = schemas.get(record.schemaId);
    const text = new TextDecoder().decode(schema.data);
    if (schema.encoding === 'omgidl') decoders.set(record.id, new MessageReader(schema.name, parseIDL(text)));
    types.add(schema.name);
  }
  if (record.type === 'Message') {
    const message = decoders.get(record.channelId)?.readMessage(record.data);
    if (message?.vehicle_id > 30) throw new Error(`${file}: message ${count}: vehicle ${message.vehicle_id}`);
    ++count;
  }
}
if (!reader.done() || count === 0) throw new Error(`${file}: ends early`);
console.log(`${file}: ${count} messages of ${types.size} types decoded`);
