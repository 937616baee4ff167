// Settings that are found from what was measured: node tests/fit.test.mjs PROGRAM
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { grown, openBrowser, openPage, rests, shot, told } from "./browser.mjs";
import { startProgram, workFolder } from "./program.mjs";

const programPath = resolve(process.argv[2] ?? "build/release/espalier");
const place = workFolder();
let program;
let browser;
let page;

const shoot = `#define ANGLE 60   /* angle of branches; 10..80; degrees */
#define RATIO 0.6  /* of lengths; 0.5..0.95 */
lsystem: 1
derivation length: 6
axiom: A(1)
A(s) --> !(0.06 * s) F(s) [ &(ANGLE) A(s * RATIO) ] /(137.5) A(s * 0.9)
endlsystem
`;

const espalier = (...words) => execFileSync(programPath, words, { cwd: place.folder, stdio: "pipe" });
const settingOf = (name) => page.locator(`[id="setting-${name}"]`).inputValue().then(Number);

before(async () => {
  writeFileSync(join(place.folder, "shoot.l"), shoot);
  espalier("run", "shoot.l", "--define", "ANGLE=35", "--define", "RATIO=0.8", "--output", "truth");
  espalier("scan", "truth", "--at", "8,2,8", "--at=-8,2,-8", "--angle", "0.15", "--no-ground", "--output", "truth.ply");
  const rows = [0, 1, 2, 3, 4, 5, 6].map((step) => `${step},${step < 2 ? "" : (1 - 0.9 ** step) / 0.1}\n`);
  writeFileSync(join(place.folder, "course.csv"), ["step,height\n", ...rows].join(""));
  program = await startProgram(programPath, place, ["shoot.l"]);
  browser = await openBrowser();
  page = await openPage(browser, program.address);
  await told(page);
  await grown(page);
});

after(async () => {
  await browser?.close();
  await program?.kill();
});

test("points of a scanner stand beside the plant", async () => {
  await page.getByRole("tab", { name: "Fit" }).click();
  await rests(page);
  const without = await page.locator(".viewport canvas").screenshot();
  await page.setInputFiles("#fit-file", join(place.folder, "truth.ply"));
  await page.waitForSelector(".fit-files li");
  assert.match(await page.locator(".fit-files li").textContent(), /truth\.ply points, \d+ numbers are compared/);
  await rests(page);
  assert.notDeepEqual(await page.locator(".viewport canvas").screenshot(), without);
  await shot(page, "fit-before");
});

test("a fit moves the sliders to what the measured plant was grown with, and undo takes it back", async () => {
  await page.getByRole("button", { name: "Fit", exact: true }).click();
  await page.waitForSelector(".fit-found table", { timeout: 120_000 });
  await grown(page);
  assert.ok(Math.abs((await settingOf("ANGLE")) - 35) < 0.5, `ANGLE is ${await settingOf("ANGLE")}`);
  assert.ok(Math.abs((await settingOf("RATIO")) - 0.8) < 0.008, `RATIO is ${await settingOf("RATIO")}`);
  assert.match(await page.locator(".fit-found").textContent(), /standard error/);
  await rests(page);
  await shot(page, "fit-after");
  await page.getByRole("button", { name: /^Undo: Fit/ }).click();
  await grown(page);
  assert.equal(await settingOf("ANGLE"), 60);
});

test("what was followed stands in the charts as dots, and files below the folder are read", async () => {
  await page.fill("#fit-place", "course.csv");
  await page.getByRole("button", { name: "Read" }).click();
  await page.waitForFunction(() => document.querySelectorAll(".fit-files li").length === 2);
  await page.getByRole("tab", { name: "Charts" }).click();
  await page.waitForFunction(() => document.querySelector(".charts .u-legend")?.textContent.includes("measured"));
  await shot(page, "fit-course");
});

test("a file that cannot be compared with is refused with a reason", async () => {
  await page.getByRole("tab", { name: "Fit" }).click();
  await page.setInputFiles("#fit-file", { name: "words.csv", mimeType: "text/csv", buffer: Buffer.from("height\nlong\n") });
  await page.waitForFunction(() => document.querySelector(".messages").textContent.includes("expected a number"));
  assert.equal(await page.locator(".fit-files li").count(), 2);
});

test("a fit is stopped, and the best so far stays", async () => {
  await page.getByRole("button", { name: "Forget course.csv" }).click();
  await page.getByRole("button", { name: "Fit", exact: true }).click();
  await page.waitForFunction(() => document.querySelector(".fit progress").value > 3);
  await page.locator(".fit").getByRole("button", { name: "Stop", exact: true }).click();
  await page.waitForFunction(() => document.querySelector(".fit [role=status]").textContent.startsWith("Stopped"));
  assert.deepEqual(page.problems, []);
});
