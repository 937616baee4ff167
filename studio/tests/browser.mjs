// A real Chromium with WebGL in software, and small helpers for the tests.
import { mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const shots = join(dirname(fileURLToPath(import.meta.url)), "../shots");

export async function openBrowser() {
  mkdirSync(shots, { recursive: true });
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
}

/** A page that fails the test at the first error of its scripts. */
export async function openPage(browser, address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(Number(process.env.PATIENCE ?? 30_000));
  page.problems = [];
  page.packets = [];
  page.on("websocket", (socket) =>
    socket.on("framereceived", ({ payload }) => {
      if (typeof payload === "string" || payload.toString("latin1", 0, 4) !== "ESP1") return;
      page.packets.push(`${payload.readUInt32LE(4)} ${payload.readInt32LE(8)}`);
    }),
  );
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") page.problems.push(message.text());
  });
  await page.goto(address);
  return page;
}

/** Until the program has told a page that it opened all that there is. */
export async function told(page) {
  await page.waitForFunction(() => document.body.dataset.told !== undefined);
}

/** Until the program has all that was changed here, and has grown it to its end: its last step, or the one that is looked at. */
export async function grown(page) {
  await page.waitForFunction(() => {
    const waits = ["asks", "unsent", "behind"].some((name) => document.body.hasAttribute(`data-${name}`));
    return !waits && document.querySelector(".status").dataset.state === "done";
  });
}

/** Until the program has answered all that this page has asked. */
export async function answered(page) {
  await page.waitForFunction(() => !document.body.hasAttribute("data-asks"));
}

/** Until the picture is as it will stay: drawn in its finest, with the limbs that were asked for. */
export async function rests(page) {
  const frames = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  await page.evaluate(frames);
  await page.waitForFunction(() => {
    const canvas = document.querySelector("canvas");
    return !canvas.hasAttribute("data-draws") && !canvas.hasAttribute("data-waits");
  });
}

export async function shot(page, name) {
  await page.screenshot({ path: join(shots, `${name}.png`) });
}
