// Makes the pictures of docs/studio.md anew: node tests/pictures.mjs PROGRAM. ffmpeg gives them a palette, which makes them small.
import { execFileSync } from "node:child_process";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { answered, grown, openBrowser, openPage, rests } from "./browser.mjs";
import { startProgram, workFolder } from "./program.mjs";

const pictures = join(dirname(fileURLToPath(import.meta.url)), "../../docs/pictures");
const place = workFolder();
const programPath = resolve(process.argv[2] ?? "build/release/espalier");
const program = await startProgram(programPath, place);
const browser = await openBrowser();
const page = await openPage(browser, program.address, { viewport: { width: 1180, height: 664 } });

async function save(name) {
  await grown(page);
  await rests(page);
  const whole = join(place.base, name);
  await page.screenshot({ path: whole });
  const palette = "split[a][b];[a]palettegen=max_colors=160:stats_mode=full[p];[b][p]paletteuse=dither=none";
  execFileSync("ffmpeg", [
    "-loglevel",
    "error",
    "-y",
    "-i",
    whole,
    "-filter_complex",
    palette,
    "-fflags",
    "+bitexact",
    join(pictures, name),
  ]);
}

async function open(name, title = name) {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.locator(".gallery .search").fill(name);
  await page.locator(`.card[title*="${name}"]`).first().click();
  await page.waitForFunction((part) => document.title.includes(part), title);
  await grown(page);
}

async function pick(symbol) {
  const box = await page.locator(".viewport canvas").boundingBox();
  for (let y = 0.85; y > 0.2; y -= 0.015)
    for (const x of [0.5, 0.48, 0.52, 0.46, 0.54]) {
      await page.mouse.click(box.x + box.width * x, box.y + box.height * y);
      await answered(page);
      const text = (await page.locator(".pick-head code").count()) ? await page.locator(".pick-head code").textContent() : "";
      if (text.startsWith(symbol)) return;
    }
}

await page.waitForSelector(".viewport[data-step]");
await grown(page);
await page.getByRole("button", { name: "No more hints" }).click();
await page.getByRole("tab", { name: "Settings" }).click();
await page.locator("#setting-seed").fill("7");
await page.keyboard.press("Enter");
await page.evaluate(() => document.activeElement.blur());
await save("studio.png");
await open("lychnis");
await pick("I(");
await save("studio-organ.png");
await open("leaf-day");
await page.getByLabel("Step", { exact: true }).fill("26");
await pick("L");
await save("studio-leaf.png");
await open("stand-measured");
await page.getByRole("tab", { name: "Settings" }).click();
await page.getByLabel("Colour by").selectOption("light.absorbed");
await page.waitForFunction(() => /light\.absorbed/.test(document.querySelector(".legend").textContent));
await save("studio-light.png");
await page.getByLabel("Colour by").selectOption("");
await open("wind-pine");
await page.getByRole("tab", { name: "Graph", exact: true }).click();
await page
  .getByRole("button", { name: /, Tree$/ })
  .first()
  .click();
await save("studio-graph.png");
await open("language/shoot", "shoot");
await page.getByRole("tab", { name: /shape\.fset/ }).click();
await page.getByRole("radio", { name: "BRANCH" }).check();
const plane = await page.locator(".point-plane").boundingBox();
await page.mouse.move(plane.x + 0.6 * plane.width, plane.y + 0.45 * plane.height);
await save("studio-functions.png");
await open("trees/ternary", "ternary");
await page.getByRole("tab", { name: "Settings", exact: true }).click();
await page.getByRole("tab", { name: /ternary\.panel/ }).click();
await save("studio-panels.png");
await open("maple");
await page.getByRole("tab", { name: /maple\.v/ }).click();
await page.getByRole("button", { name: "Add light" }).click();
await page.getByLabel("light: where it comes from, infinitely far away x").fill("1");
await page.keyboard.press("Enter");
await page.evaluate(() => document.activeElement.blur());
await page.waitForFunction(() => document.querySelector(".viewport canvas").dataset.limbs === "tubes");
await save("studio-view.png");
await open("honda");
await page.getByRole("button", { name: /^Pin this growth: / }).click();
await answered(page);
await page.getByRole("tab", { name: "Settings" }).click();
await page.locator("#setting-A2").fill("-85");
await page.evaluate(() => document.activeElement.blur());
await save("studio-compare.png");
await page.getByRole("button", { name: /pin/i, pressed: true }).first().click();
// The forgotten tree of docs/fitting.md.
const espalier = (...words) => execFileSync(programPath, words, { cwd: place.base, stdio: "pipe" });
const truth = { R1: 0.86, R2: 0.74, A1: 17, A2: -48, DIVERGENCE: 120 };
const defines = Object.entries(truth).flatMap(([name, value]) => ["--define", `${name}=${value}`]);
espalier("run", join(pictures, "../../models/trees/honda.l"), ...defines, "--output", "forgotten");
const places = ["8,2,8", "-8,2,-8", "8,2,-8"].map((at) => `--at=${at}`);
espalier("scan", "forgotten", ...places, "--angle", "0.15", "--no-ground", "--output", "forgotten.ply");
await open("honda");
await page.getByRole("tab", { name: "Fit" }).click();
await page.setInputFiles("#fit-file", join(place.base, "forgotten.ply"));
for (const [name, low, high] of [["A1", 0, 40], ["A2", -80, -20]]) {
  await page.locator(`.fit-row:has([id="fit-${name}"]) .number`).first().fill(String(low));
  await page.locator(`.fit-row:has([id="fit-${name}"]) .number`).last().fill(String(high));
}
for (const box of await page.locator(".fit-row input[type=checkbox]").all()) {
  if (!((await box.getAttribute("id")).slice(4) in truth)) await box.uncheck();
}
await page.getByRole("button", { name: "Fit", exact: true }).click();
await page.waitForSelector(".fit-found table", { timeout: 300_000 });
await page.locator(".fit-rows").evaluate((rows) => rows.scrollIntoView());
await save("studio-fit.png");
await browser.close();
await program.kill();
