// What browsers get packed, unpacked by what it begins with.
import assert from "node:assert/strict";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { load } from "./load.mjs";

const { streamOfBytes, ungzipped, unpacked } = await load("view/compression.ts");

const words = "a plant\n";
/** `printf 'a plant\n' | xz --check=crc32` */
const byXz = Buffer.from("/Td6WFoAAAFpIt42AgAhARYAAAB0L+WjAQAHYSBwbGFudAoA/fJriwABHAhEYCrIkEKZDQEAAAAAAVla", "base64");
const textOf = async (unpack, bytes) => (await unpack(streamOfBytes(new Uint8Array(bytes)))).text();

test("xz, gzip and plain bytes are told apart", async () => {
  for (const bytes of [byXz, gzipSync(words), Buffer.from(words)]) assert.equal(await textOf(unpacked, bytes), words);
  assert.equal(await textOf(unpacked, []), "");
});

test("a page's first script unpacks gzip alone", async () => {
  for (const bytes of [gzipSync(words), Buffer.from(words)]) assert.equal(await textOf(ungzipped, bytes), words);
  assert.deepEqual(Buffer.from(await (await ungzipped(streamOfBytes(new Uint8Array(byXz)))).arrayBuffer()), byXz);
});
