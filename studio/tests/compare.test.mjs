// Two growths beside each other, and many of a sweep: node tests/compare.test.mjs PROGRAM
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { answered, grown, openBrowser, openPage, rests, shot, told } from "./browser.mjs";
import { startProgram, workFolder, writeDay } from "./program.mjs";

const programPath = resolve(process.argv[2] ?? "build/release/espalier");
const place = workFolder();
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
let program;
let browser;
let page;

const picture = async () => {
  await rests(page);
  return page.locator(".viewport canvas").screenshot();
};

/** Rules of axe that are broken gravely. */
const violations = () =>
  page.evaluate(
    `${axe}; axe.run(document, { resultTypes: ["violations"] }).then(({ violations }) =>
      violations.filter(({ impact }) => impact === "critical" || impact === "serious").map(({ id }) => id))`,
  );

async function open(name) {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.getByRole("tab", { name: "My files" }).click();
  await page.locator(`.card[title$="/plants/${name}"]`).click();
  await page.waitForFunction((title) => document.title.startsWith(title), name);
  await grown(page);
}

async function set(name, value) {
  const row = page.locator(".setting", { has: page.locator(`[id="setting-${name}"]`) });
  await row.getByRole("textbox").fill(value);
  await row.getByRole("textbox").press("Enter");
  await grown(page);
}

before(async () => {
  writeDay(place.folder);
  const day = join(place.folder, "day.toml");
  writeFileSync(day, readFileSync(day, "utf8").replace("steps = 20", "steps = 12"));
  program = await startProgram(programPath, place, ["tree.l"]);
  browser = await openBrowser();
  page = await openPage(browser, program.address);
  await told(page);
  await grown(page);
});

after(async () => {
  await browser?.close();
  await program?.kill();
});

test("a pinned growth stands beside the next one, with words for what it was", async () => {
  await page.getByRole("button", { name: /^Pin this growth: / }).click();
  await answered(page);
  const alone = await picture();
  await set("ANGLE", "60");
  assert.match(await page.locator(".compare [role=status]").textContent(), /^Pinned: Angle of branches 32 \(now 60\)$/);
  await page.waitForSelector("canvas[data-pinned='8']");
  assert.notDeepEqual(await picture(), alone);
  await shot(page, "compare-beside");
  assert.deepEqual(await violations(), []);
  await page.locator(".scrub").fill("5");
  await page.waitForSelector("canvas[data-pinned='5']");
  await page.locator(".scrub").fill("8");
  await page.waitForSelector("canvas[data-pinned='8']");
});

test("it can stand on the other, and be hidden", async () => {
  await page.getByLabel("Pinned plant").selectOption("on it, grey");
  await shot(page, "compare-on-it");
  const both = await picture();
  await page.getByLabel("Pinned plant").selectOption("hidden");
  assert.notDeepEqual(await picture(), both);
  await page.getByLabel("Pinned plant").selectOption("beside");
});

test("organs are coloured by what has changed of a column, and a legend has both signs", async () => {
  await page.getByLabel("Colour by").selectOption("age");
  await answered(page);
  await page.getByLabel("Colour and field by the difference").check();
  await page.waitForFunction(() => document.querySelector(".legend strong")?.textContent === "age, now − pinned");
  assert.deepEqual(await page.locator(".legend-ends span").allTextContents(), ["0", "0", "0"]);
  await page.getByLabel("Colour by").selectOption("parameter 2");
  await set("RATIO", "0.9");
  await page.waitForFunction(() => document.querySelector(".legend strong")?.textContent === "parameter 2, now − pinned");
  // The longest grows from 1 to 1; a branch of order 7 from 0.8^7 to 0.9^7, and its like.
  const [low, middle, high] = (await page.locator(".legend-ends span").allTextContents()).map(Number);
  assert.ok(low === -high && middle === 0 && high > 0.2, `${low} ${middle} ${high}`);
  await shot(page, "compare-difference");
  await page.getByLabel("Steps", { exact: true }).fill("6");
  await page.getByLabel("Steps", { exact: true }).press("Enter");
  await grown(page);
  await page.waitForFunction(() => /no difference: it was pinned at step 8/.test(document.querySelector(".legend small")?.textContent));
  await page.getByRole("button", { name: /^Pin this growth: / }).click();
  assert.equal(await page.locator("canvas[data-pinned]").count(), 0);
  await page.getByLabel("Colour by").selectOption("");
});

test("fields are compared voxel by voxel", async () => {
  await open("day.toml");
  await page.getByLabel("Field", { exact: true }).selectOption({ index: 1 });
  await page.waitForSelector(".viewport[data-field]");
  await page.getByRole("button", { name: /^Pin this growth: / }).click();
  await answered(page);
  await set("environment.light.sky.latitude", "60");
  await page.waitForFunction(() => /now − pinned/.test(document.querySelector(".legend strong")?.textContent));
  await shot(page, "compare-field");
  assert.deepEqual(page.problems, []);
});

test("a slider is swept into a grid of plants and a chart, and the document stays as it was", async () => {
  await open("tree.l");
  const text = await page.locator(".cm-content").textContent();
  await page.getByRole("button", { name: "Sweep Angle of branches …" }).click();
  const dialog = page.getByRole("dialog", { name: "Sweep Angle of branches" });
  await dialog.getByLabel("From").fill("10");
  await dialog.getByLabel("to", { exact: true }).fill("70");
  await dialog.getByLabel("plants").fill("4");
  await dialog.getByRole("button", { name: "Grow", exact: true }).click();
  await page.waitForFunction(() => /^All have grown/.test(document.querySelector("dialog [role=status]").textContent));
  assert.deepEqual(await dialog.locator(".sweep-tile").allTextContents(), ["10", "30", "50", "70"]);
  await dialog.getByLabel("Chart of").selectOption("internodes");
  assert.match(await dialog.locator(".u-legend").textContent(), /value/);
  await rests(page);
  await shot(page, "sweep");
  assert.deepEqual(await violations(), []);
  assert.equal(await page.locator(".cm-content").textContent(), text);
  assert.equal(await page.locator("#setting-ANGLE").inputValue(), "32");
  const pixels = await dialog.locator(".sweep-tile canvas").evaluateAll((all) => all.map((canvas) => canvas.toDataURL()));
  assert.equal(new Set(pixels).size, 4);
});

test("a click on a plant of a sweep takes its value, as one change", async () => {
  await page.locator(".sweep-tile", { hasText: "50" }).click();
  await grown(page);
  assert.equal(await page.locator("#setting-ANGLE").inputValue(), "50");
  assert.equal(await page.getByRole("dialog").count(), 0);
  await page.getByRole("button", { name: /^Undo: angle of branches = 50/ }).click();
  await grown(page);
  assert.equal(await page.locator("#setting-ANGLE").inputValue(), "32");
});

test("a sweep can be stopped, and its dialog closed while it goes on", async () => {
  await set("RATIO", "0.8");
  await page.getByLabel("Steps", { exact: true }).fill("12");
  await page.getByLabel("Steps", { exact: true }).press("Enter");
  await page.getByRole("button", { name: "Sweep Ratio …" }).click();
  await page.getByRole("button", { name: "Grow", exact: true }).click();
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  assert.equal(await page.getByRole("dialog").getByRole("status").textContent(), "Stopped.");
  await page.getByRole("button", { name: "Grow", exact: true }).click();
  await page.keyboard.press("Escape");
  await page.getByLabel("Steps", { exact: true }).fill("3");
  await page.getByLabel("Steps", { exact: true }).press("Enter");
  await grown(page);
  assert.deepEqual(page.problems, []);
});
