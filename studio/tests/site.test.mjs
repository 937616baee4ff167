// The studio that needs no server, in a real browser: node tests/site.test.mjs FOLDER, as studio/site.mjs has made it.
//
// Files are served below a path of their own, as a page of a larger site is.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { grown, openBrowser, openPage, rests, shot, told } from "./browser.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const folder = resolve(process.argv[2] ?? "../build/web/site");
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".png": "image/png" };
const below = "/some/where/";
const asked = []; // names of files
const missing = new Set();
let server;
let browser;
let page;
let address;

async function serve(request, response) {
  const path = new URL(request.url, "http://localhost").pathname;
  try {
    if (!path.startsWith(below)) throw new Error("outside");
    const name = path.slice(below.length) || "index.html";
    asked.push(name);
    if (missing.has(name)) throw new Error("missing");
    const bytes = await readFile(join(folder, name));
    response.writeHead(200, { "Content-Type": types[extname(name)] ?? "application/octet-stream" }).end(bytes);
  } catch {
    response.writeHead(404).end();
  }
}

/** A page, and every address that it asks for. */
async function openSite(where) {
  const opened = await openPage(browser, "about:blank");
  opened.requests = [];
  opened.on("request", (request) => opened.requests.push(request.url()));
  await opened.goto(where);
  return opened;
}

/** Its first step does not end. */
const slow =
  "lsystem: 1\nStartEach: { i = 0; while (i < 90000) { j = 0; while (j < 90000000) { j = j + 1; } i = i + 1; } }\nderivation length: 40\naxiom: F(1) A\n" +
  "A --> F(1) A\nendlsystem\n";

/** A page that notes, whenever a worker begins, whether the studio runs already; and the steps that it hears, and when it has drawn. */
async function openNoting(where) {
  const opened = await openPage(browser, "about:blank");
  await opened.addInitScript(() => {
    window.begins = [];
    window.steps = [];
    window.Worker = class extends Worker {
      constructor(...given) {
        super(...given);
        window.begins.push("EspalierView" in window ? "after the studio" : "before the studio");
        this.addEventListener("message", ({ data }) => {
          const step = /^{"say":"growth".*"step":(-?[0-9]+)/.exec(data)?.[1];
          if (step) window.steps.push(Number(step));
        });
      }
      postMessage(message) {
        if (message.kind === "taken") window.steps.push("drawn");
        super.postMessage(message);
      }
    };
  });
  await opened.goto(where);
  return opened;
}

const text = (which = page) => which.locator(".cm-content").textContent();

/** Rules of axe that are broken gravely. */
function violations(which) {
  return which.evaluate(
    `${axe}; axe.run(document, { resultTypes: ["violations"] }).then(({ violations }) =>
      violations.filter(({ impact }) => impact === "critical" || impact === "serious").map(({ id }) => id))`,
  );
}

async function openFromGallery(words, which = page) {
  await which.getByRole("button", { name: "Gallery", exact: true }).click();
  await which.fill(".gallery .search", words);
  await which.locator(".card").first().click();
  await which.locator(".gallery").waitFor({ state: "hidden" });
}

before(async () => {
  server = createServer(serve);
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  address = `http://127.0.0.1:${server.address().port}${below}`;
  browser = await openBrowser();
  page = await openSite(address);
});

after(async () => {
  await browser?.close();
  server?.close();
});

test("a tree grows in the page, and nothing outside its folder is asked for", async () => {
  await told(page);
  await grown(page);
  await rests(page);
  await shot(page, "site");
  const outside = page.requests.filter((url) => !url.startsWith(address) && !/^(blob|data):/.test(url));
  assert.deepEqual(outside, []);
  assert.deepEqual(page.problems, []);
});

test("the worker begins before the studio runs, and every part comes once, for the workers that follow, too", async () => {
  const before = asked.length;
  const own = await openNoting(address);
  await told(own);
  await grown(own);
  assert.deepEqual(await own.evaluate(() => window.begins), ["before the studio"]);
  await openFromGallery("Honda", own);
  await grown(own);
  await own.locator(".cm-content").click();
  await own.keyboard.press("Control+A");
  await own.keyboard.insertText(slow);
  await own.waitForFunction(() => document.querySelector(".status").dataset.state === "growing");
  await own.getByRole("button", { name: "Stop the growth" }).click();
  await own.waitForFunction(() => document.querySelector(".status").dataset.state === "done");
  assert.deepEqual(await own.evaluate(() => window.begins), ["before the studio", "after the studio"]);
  const parts = asked.slice(before).filter((name) => /^[^/]*[.](js|xz|pack)$/.test(name));
  assert.deepEqual(parts.sort(), ["espalier.wasm.xz", "library.pack", "loader.js", "studio.js", "worker.js"]);
  assert.deepEqual(own.problems, []);
  await own.context().close();
});

test("a part that is not there is told", async () => {
  for (const name of ["espalier.wasm.xz", "worker.js"]) {
    missing.add(name);
    const own = await openSite(address);
    await own.getByText(`${name} could not be loaded (404)`).first().waitFor();
    missing.delete(name);
    await own.context().close();
  }
});

test("a model of the library grows, and a number that is edited changes it", async () => {
  await openFromGallery("Honda");
  await grown(page);
  const counted = () => page.locator(".status").textContent();
  const before = await counted();
  const steps = page.getByRole("spinbutton", { name: "Steps" }).first();
  await steps.fill("5");
  await steps.press("Enter");
  await page.waitForFunction((was) => document.querySelector(".status").textContent !== was, before);
  await grown(page);
  assert.notEqual(await counted(), before);
  await rests(page);
  await shot(page, "site-honda");
});

test("a scene with soil grows, with its fields", async () => {
  await openFromGallery("two-roots");
  await page.waitForFunction(() => document.querySelector(".status").dataset.state !== undefined);
  await grown(page);
  await rests(page);
  await shot(page, "site-roots");
  assert.deepEqual(page.problems, []);
});

test("sliders stand as their author has laid them out, beside a model and in a scene, and move the plant", async () => {
  const titles = (which = page) => which.locator(".settings summary").allInnerTexts();
  const labels = () => page.locator(".settings .setting-head label:visible").allInnerTexts();
  await openFromGallery("ternary");
  await grown(page);
  await page.getByRole("tab", { name: "Settings", exact: true }).click();
  assert.deepEqual(await titles(), ["Figure", "Fork", "Through the years"]);
  assert.deepEqual((await labels()).map((label) => label.trim()).slice(2, 5), ["Angle with the parent", "First to second", "Second to third"]);
  const angle = page.getByRole("slider", { name: "Angle with the parent" });
  assert.equal(await angle.getAttribute("step"), "0.5");
  const growth = () => page.locator(".viewport").getAttribute("data-growth");
  const before = await growth();
  await angle.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((was) => document.querySelector(".viewport").dataset.growth !== was, before);
  await grown(page);
  await rests(page);
  await shot(page, "site-panels");

  const scene = await openSite(`${address}#open=environments/hedge.toml`);
  await scene.getByText("Points and shoots", { exact: true }).waitFor();
  assert.deepEqual(await titles(scene), ["Points and shoots", "Leaves"]);
  await scene.context().close();
});

test("a plant is exported as glTF", async () => {
  await openFromGallery("Honda");
  await grown(page);
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("menuitem", { name: /^Export/ }).click();
  await page.selectOption("#export-format", "gltf");
  const [file] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Export", exact: true }).click(),
  ]);
  assert.match(file.suggestedFilename(), /honda.*\.glb$/);
  const bytes = await readFile(await file.path());
  assert.equal(bytes.toString("latin1", 0, 4), "glTF");
  assert.equal(bytes.readUInt32LE(8), bytes.length);
  assert.ok(bytes.length > 10_000);
});

test("a growth is shared as a page of its own", async () => {
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("menuitem", { name: /^Share as HTML/ }).click();
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Write the file" }).click()]);
  assert.match(await readFile(await file.path(), "utf8"), /EspalierView/);
});

test("unsaved work is found again", async () => {
  await openFromGallery("Honda");
  await grown(page);
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+Home");
  await page.keyboard.type("/* mine */ ");
  await grown(page);
  // The browser keeps it when the worker has told of it, ten times a second.
  await page.waitForFunction(
    () =>
      new Promise((found) => {
        const open = indexedDB.open("espalier-studio", 1);
        open.onsuccess = () => {
          const kept = open.result.transaction("files").objectStore("files").get("/state/studio.json");
          kept.onsuccess = () => {
            open.result.close();
            found(kept.result !== undefined && new TextDecoder().decode(kept.result).includes("/* mine */"));
          };
        };
      }),
  );
  await page.reload();
  await told(page);
  await grown(page);
  assert.match(await text(), /\/\* mine \*\//);
});

test("what is saved is written into the file that was chosen once", async () => {
  const own = await openSite(address);
  await told(own);
  await grown(own);
  // A dialog of the system answers no test.
  await own.evaluate(() => {
    window.disk = {};
    window.asked = [];
    window.showSaveFilePicker = async ({ suggestedName }) => {
      window.asked.push(suggestedName);
      const write = async (bytes) => (window.disk[suggestedName] = new TextDecoder().decode(bytes));
      return { createWritable: async () => ({ write, close: async () => undefined }) };
    };
  });
  await own.keyboard.press("Control+s");
  await own.getByRole("dialog", { name: "Save as" }).getByRole("button", { name: "Save" }).click();
  await own.waitForFunction(() => Object.keys(window.disk).length === 1);
  await own.locator(".cm-content").click();
  await own.keyboard.press("Control+Home");
  await own.keyboard.type("# mine ");
  await grown(own);
  await own.keyboard.press("Control+s");
  await own.waitForFunction(() => Object.values(window.disk).some((content) => content.startsWith("# mine ")));
  assert.equal(await own.evaluate(() => window.asked.length), 1);
  assert.deepEqual(own.problems, []);
  await own.context().close();
});

test("a step that takes too long is stopped, and the text stays", async () => {
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+A");
  await page.keyboard.insertText(slow);
  await page.waitForFunction(() => document.querySelector(".status").dataset.state === "growing");
  await page.getByRole("button", { name: "Stop the growth" }).click();
  await page.waitForFunction(() => document.querySelector(".status").dataset.state === "done");
  assert.match(await text(), /90000000/);
  assert.equal(await page.getByRole("spinbutton", { name: "Steps" }).first().inputValue(), "0");
});

test("a change is heard in the midst of a step that takes too long", async () => {
  const steps = page.getByRole("spinbutton", { name: "Steps" }).first();
  await steps.fill("30");
  await steps.press("Enter");
  await page.waitForFunction(() => document.querySelector(".status").dataset.state === "growing");
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+A");
  await page.keyboard.insertText("lsystem: 1\nderivation length: 6\naxiom: F(1) A\nA --> F(1) A\nendlsystem\n");
  await grown(page);
  assert.match(await text(), /derivation length: 6/);
  assert.match(await page.locator(".status").textContent(), /31 internodes/);
});

test("axe finds nothing critical or serious, and no script comes from a text", async () => {
  assert.deepEqual(await violations(page), []);
  const policy = await page.locator("meta[http-equiv=Content-Security-Policy]").getAttribute("content");
  assert.match(policy, /script-src 'self' 'wasm-unsafe-eval';/);
  assert.match(policy, /default-src 'none'/);
});

test("a file of the library has an address", async () => {
  const named = await openSite(`${address}#open=models/course/04-signals.l`);
  await told(named);
  await grown(named);
  await named.waitForFunction(() => document.querySelector(".document-name").textContent.startsWith("04-signals"));
});

test("the gallery leads to the lessons, and a lesson to the next", async () => {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.getByRole("link", { name: "Lessons of two minutes" }).click();
  await page.getByRole("link", { name: "A signal climbs the stem" }).click();
  await told(page);
  await grown(page);
  assert.equal(await page.locator(".lesson h2").first().textContent(), "A signal climbs the stem");
  await page.getByRole("link", { name: "Next lesson" }).click();
  await page.getByRole("heading", { name: "Chance that can be repeated" }).first().waitFor();
  await told(page);
});

test("a goal is reached by the slider that its author chose, on a phone", async () => {
  const phone = await openPage(browser, `${address}04-signals.html`, { viewport: { width: 390, height: 800 } });
  await told(phone);
  await grown(phone);
  await phone.waitForFunction(() => document.querySelector(".goals small").textContent.startsWith("height is 2.37"));
  assert.equal(await phone.locator(".lesson").getAttribute("data-goals"), "0");
  const delay = phone.locator(".lesson input.number");
  await delay.fill("14");
  await delay.press("Enter");
  await phone.waitForFunction(() => document.querySelector(".lesson").dataset.goals === "1");
  assert.equal(await phone.locator(".lesson section .verdict").textContent(), "All goals are reached.");
  await phone.getByLabel("the signal catches up with it").check();
  assert.match(await phone.locator(".question .verdict").textContent(), /^Right\. /);
  await rests(phone);
  await shot(phone, "site-lesson");
  await phone.getByRole("button", { name: "Start again" }).click();
  await phone.waitForFunction(() => document.querySelector(".lesson").dataset.goals === "0");
  await phone.getByRole("tab", { name: "Texts" }).click();
  await phone.locator(".cm-line").first().click();
  await phone.keyboard.type("nothing");
  assert.doesNotMatch(await text(phone), /nothing/);
  assert.deepEqual(await violations(phone), []);
  assert.deepEqual(phone.problems, []);
});

test("two trees grow in the file that a clone holds", async () => {
  const held = await openNoting(new URL("../dist/live.html", import.meta.url).href);
  await told(held);
  await grown(held);
  assert.deepEqual(await held.evaluate(() => window.begins), ["before the studio"]);
  const steps = await held.evaluate(() => window.steps);
  const drawn = steps.indexOf("drawn");
  assert.ok(steps.slice(0, drawn).every((step) => step <= 0), `${steps.slice(0, drawn)}: nothing grows on before the first picture is drawn`);
  assert.ok(steps.slice(drawn).some((step) => step > 0));
  await rests(held);
  await shot(held, "site-live");
  assert.match(await held.locator(".document-name").textContent(), /^two-trees/);
  assert.deepEqual(held.problems, []);
});

test("one file works from a disk", async () => {
  const alone = await openSite(pathToFileURL(join(folder, "espalier.html")).href);
  await told(alone);
  await grown(alone);
  await rests(alone);
  await shot(alone, "site-file");
  const outside = alone.requests.filter((url) => !/^(file:.*espalier\.html|blob:|data:)/.test(url));
  assert.deepEqual(outside, []);
  assert.deepEqual(alone.problems, []);
});
