// A recorded run as a page of its own: node tests/share.test.mjs PROGRAM
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { grown, openBrowser, openPage, rests, shot, told } from "./browser.mjs";
import { workFolder, writeDay } from "./program.mjs";

const program = resolve(process.argv[2] ?? "build/release/espalier");
const { base, folder } = workFolder();
let browser;

const call = (...args) => execFileSync(program, args, { cwd: folder, stdio: "pipe" });

before(async () => {
  writeFileSync(
    join(folder, "scene.toml"),
    '[[plant]]\nmodel = "tree.l"\nname = "oak"\n[timeline]\nparameters = { length = "Internode.2" }\n',
  );
  call("run", "scene.toml", "--output", "run", "--quiet");
  call("share", "run", "--output", "shared.html");
  browser = await openBrowser();
});

after(async () => browser?.close());

test("a click on a shared page tells what the organ is, step by step", async () => {
  const page = await openPage(browser, `file://${join(folder, "shared.html")}`, { offline: true });
  const card = page.locator(".organ-card");
  const fact = (name) => card.locator(`dt:text-is("${name}") + dd`).textContent();
  const goTo = async (step) => {
    await page.locator("input[type=range]").fill(String(step));
    await page.waitForFunction((wanted) => document.body.dataset.step === wanted, String(step));
    await rests(page);
  };
  await page.waitForFunction(() => document.body.dataset.step === "8");
  await rests(page);
  const plain = await page.locator("canvas").screenshot();
  const box = await page.locator("canvas").boundingBox();
  // The trunk stands in the middle, near the ground.
  for (let part = 0.95; part > 0.5 && !(await card.isVisible()); part -= 0.02) {
    await page.mouse.click(box.x + box.width / 2, box.y + box.height * part);
    await page.waitForTimeout(100);
  }
  assert.match(await card.locator("code").textContent(), /^Internode$/);
  assert.equal(await fact("Plant"), "oak");
  assert.match(await fact("Identity"), /^[0-9a-f]{16}$/);
  await rests(page);
  await shot(page, "shared-organ");
  assert.notDeepEqual(await page.locator("canvas").screenshot(), plain);

  // Internodes grow by 2 % in a step.
  const born = Number(await fact("Born in step"));
  const identity = await fact("Identity");
  const last = Number(await fact("length"));
  await goTo(7);
  assert.equal(await fact("Identity"), identity);
  assert.ok(Math.abs(Number(await fact("length")) * 1.02 - last) < 1e-4 * last);
  await goTo(born - 1);
  assert.match(await card.textContent(), /does not show the organ/);
  await goTo(8);
  assert.equal(Number(await fact("length")), last);

  await page.mouse.click(box.x + 5, box.y + 5);
  await card.waitFor({ state: "hidden" });
  await rests(page);
  assert.deepEqual(await page.locator("canvas").screenshot(), plain);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test("a page that was shared without organs shows the plant, and clicks find nothing", async () => {
  const whole = readFileSync(join(folder, "shared.html"), "utf8");
  const bare = whole.replace(/(id="recording">)(.*?)(<\/script>)/s, (_, begin, text, end) => {
    const { organs, moments, ...rest } = JSON.parse(text);
    assert.ok(organs && moments);
    return begin + JSON.stringify(rest) + end;
  });
  writeFileSync(join(base, "bare.html"), bare);
  const page = await openPage(browser, `file://${join(base, "bare.html")}`, { offline: true });
  await page.waitForFunction(() => document.body.dataset.step === "8");
  const box = await page.locator("canvas").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.85);
  await rests(page);
  assert.equal(await page.locator(".organ-card").isVisible(), false);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test("a shared page has the sun of its scene in every step", async () => {
  writeDay(folder);
  call("run", "day.toml", "--output", "day", "--quiet");
  call("share", "day", "--output", "day.html");
  const whole = readFileSync(join(folder, "day.html"), "utf8");
  const recording = JSON.parse(/id="recording">(.*?)<\/script>/s.exec(whole)[1]);
  assert.equal(recording.skies.length, recording.steps.length);
  assert.equal(recording.skies[1].sun, null);
  assert.ok(recording.skies[12].sun[1] > 0.92);
  writeFileSync(join(folder, "usual.html"), whole.replace(/"skies":\[.*?\],"camera"/, '"skies":[],"camera"'));
  const pictureOf = async (name) => {
    const page = await openPage(browser, `file://${join(folder, name)}`, { offline: true });
    await page.waitForFunction(() => document.body.dataset.step === "20");
    await page.locator("input[type=range]").fill("17");
    await page.waitForFunction(() => document.body.dataset.step === "17");
    await rests(page);
    const picture = await page.locator("canvas").screenshot();
    await shot(page, `shared-${name}`);
    assert.deepEqual(page.problems, []);
    await page.context().close();
    return picture;
  };
  assert.notDeepEqual(await pictureOf("day.html"), await pictureOf("usual.html"));
});

test("a shared page shows the soil of its roots, step by step, fitted to a phone", async () => {
  const soil = '[environment.water]\nprocess = "soil-water"\nvoxel = 0.25\ninitial = 0.2\ndomain = { lower = [-1, -2, -1], upper = [1, 0, 1] }\n';
  writeFileSync(join(folder, "soil.toml"), `[[plant]]\nmodel = "tree.l"\n${soil}[timeline]\nfields = ["water"]\n`);
  call("run", "soil.toml", "--steps", "10", "--output", "soil", "--quiet");
  call("share", "soil", "--output", "soil.html");
  const page = await openPage(browser, `file://${join(folder, "soil.html")}`, { offline: true, viewport: { width: 390, height: 800 } });
  await page.waitForFunction(() => document.body.dataset.field === "water");
  assert.match(await page.locator(".recording-bar").textContent(), /0\.2 to 0\.2 m3\/m3/);
  await rests(page);
  await shot(page, "shared-soil");
  const withSoil = await page.locator("canvas").screenshot();
  await page.getByLabel("Field").selectOption("no field");
  await page.waitForFunction(() => document.body.dataset.field === "");
  await rests(page);
  assert.notDeepEqual(await page.locator("canvas").screenshot(), withSoil);
  // The ninth frame is the first of the second text.
  await page.locator("input[type=range]").fill("8");
  await page.waitForFunction(() => document.body.dataset.step === "8");
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= 390), true);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test("a page that grows is the studio with one growth, and changes it", async () => {
  writeFileSync(join(folder, "scene-live.toml"), '[[plant]]\nmodel = "tree.l"\n[simulation]\nsteps = 4\n');
  call("share", "--live", "scene-live.toml", "--output", "live.html", "--title", 'An "oak" & more');
  assert.ok(readFileSync(join(folder, "live.html")).length < 2_500_000);
  const page = await openPage(browser, `file://${join(folder, "live.html")}`, { offline: true });
  await told(page);
  await grown(page);
  await rests(page);
  await shot(page, "live");
  const count = () => page.locator(".status").textContent();
  const before = await count();
  const steps = page.getByRole("spinbutton", { name: "Steps" }).first();
  assert.equal(await steps.inputValue(), "4");
  await steps.fill("6");
  await steps.press("Enter");
  await page.waitForFunction((was) => document.querySelector(".status").textContent !== was, before);
  await grown(page);
  assert.notEqual(await count(), before);
  assert.deepEqual(page.problems, []);
  assert.match(await page.content(), /data-open="\/library\/scene-live.toml"/);
  await page.context().close();
});

test("a page that grows has the files and the seed of a run", async () => {
  call("run", "scene.toml", "--seed", "12", "--steps", "2", "--output", "seeded", "--quiet");
  call("share", "--live", "seeded");
  const page = await openPage(browser, `file://${join(folder, "seeded/share.html")}`, { offline: true });
  await told(page);
  await grown(page);
  assert.equal(await page.getByRole("spinbutton", { name: "Seed" }).first().inputValue(), "12");
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test("a page that grows does so in the frame of another page, which may allow it scripts alone", async () => {
  call("share", "--live", "tree.l", "--output", "framed.html");
  writeFileSync(
    join(folder, "outer.html"),
    '<!doctype html><iframe sandbox="allow-scripts" src="framed.html" width="640" height="420" title="a tree"></iframe>',
  );
  const page = await openPage(browser, `file://${join(folder, "outer.html")}`, { offline: true });
  const frame = page.frameLocator("iframe");
  await frame.locator('.status[data-state="done"]').waitFor();
  assert.match(await frame.locator(".status").textContent(), /internodes/);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});
