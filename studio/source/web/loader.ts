/**
 * The first script of a page that has its own session. The worker runs before the studio does: it unpacks the module, opens the
 * first plant and grows it while this thread is busy with the page. A thread that is busy would not let it begin.
 */
import { ungzipped } from "../view/index.js";
import { howToBegin } from "./beginning.js";
import { keptFiles } from "./kept.js";
import type { Begun, FromWorker, ToWorker } from "./messages.js";
import { packedPart, packedParts, streamOf } from "./packed.js";

/** Those of a page of one file stand before this script, as they are: what unpacks the others must not wait itself. */
async function workerScript(): Promise<string> {
  const inside = document.getElementById("part-worker.js")?.textContent;
  const text = inside ?? (await new Response(await streamOf(packedPart("worker.js"))).text());
  return URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
}

const pageIsRead = new Promise<void>((resolve) => {
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", () => resolve());
  else resolve();
});

async function beginSession(): Promise<Begun> {
  const reading = keptFiles();
  const script = await workerScript();
  const worker = new Worker(script);
  const heard: FromWorker[] = [];
  const runs = new Promise<void>((resolve) => {
    const hear = (data: FromWorker) => {
      heard.push(data);
      resolve();
    };
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => hear(data);
    worker.onerror = (event) => {
      event.preventDefault();
      hear({ kind: "failed", why: event.message });
    };
  });
  await pageIsRead;
  const kept = await reading;
  const begin: ToWorker = { kind: "begin", parts: packedParts(), kept, begin: howToBegin(true), rests: 0 };
  worker.postMessage(begin);
  await runs;
  return { script, worker, kept, heard };
}

/** The studio tells what went wrong, if anything did. */
async function runStudio(): Promise<void> {
  const script = document.createElement("script");
  const packed = packedPart("studio.js");
  if ("address" in packed) script.src = "studio.js";
  else {
    script.dataset.file = "studio.js";
    script.textContent = await (await ungzipped(await streamOf(packed))).text();
  }
  document.body.append(script);
}

async function begin(): Promise<void> {
  window.espalierBegun = beginSession();
  await window.espalierBegun.catch(() => undefined);
  await pageIsRead;
  await runStudio();
}

void begin();
