// All tests of the page, two files at a time: node tests/all.mjs PROGRAM
import { spawn } from "node:child_process";

const program = process.argv.slice(2);
const waiting = ["studio", "page", "editors", "fit", "compare", "share"]; // the longest first

/** Runs a file of tests; what it says is shown when it is done. */
async function run(name) {
  const file = new URL(`${name}.test.mjs`, import.meta.url).pathname;
  const child = spawn(process.execPath, [file, ...program], { stdio: ["ignore", "pipe", "pipe"] });
  const said = [];
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (data) => said.push(data));
  const code = await new Promise((ended) => child.on("close", ended));
  process.stdout.write(Buffer.concat(said));
  if (code !== 0) process.exitCode = 1;
}

async function runAllThatWait() {
  for (let name = waiting.shift(); name; name = waiting.shift()) await run(name);
}

await Promise.all([runAllThatWait(), runAllThatWait()]);
