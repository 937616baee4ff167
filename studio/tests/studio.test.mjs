// The studio as people use it, in a real browser: node tests/studio.test.mjs PROGRAM
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { answered, grown as grownOn, openBrowser, openPage, rests, shot, told } from "./browser.mjs";
import { keeps, startProgram, tree, workFolder } from "./program.mjs";

const programPath = resolve(process.argv[2] ?? "build/release/espalier");
const place = workFolder();
let program;
let browser;
let page;

const canvas = () => page.locator(".viewport canvas");
const viewport = (which = page) => which.locator(".viewport");
const picture = async () => {
  await rests(page);
  return canvas().screenshot();
};

/** Waits until the picture shows a step. */
async function shows(step, which = page) {
  await which.waitForFunction((wanted) => document.querySelector(".viewport").dataset.step === String(wanted), step);
}

const grown = (which = page) => grownOn(which);

async function counts() {
  return page.locator(".status .counts").textContent();
}

before(async () => {
  program = await startProgram(programPath, place);
  browser = await openBrowser();
  page = await openPage(browser, program.address);
  await told(page);
});

after(async () => {
  await browser?.close();
  await program?.kill();
});

test("it opens with a tree that grows at once", async () => {
  await page.waitForSelector(".viewport[data-step]");
  await grown();
  await shot(page, "first");
});

test("the gallery offers models with pictures, and a search finds one that grows at once", async () => {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.waitForSelector(".card");
  assert.ok((await page.locator(".card").count()) > 20);
  await page.waitForSelector(".card img");
  await shot(page, "gallery");
  await page.fill(".gallery .search", "honda");
  await page.locator(".card").first().click();
  await page.waitForFunction(() => document.title.startsWith("honda"));
  await grown();
  assert.match(await counts(), /internodes/);
  await shot(page, "honda");
});

test("one's own file opens and grows step after step", async () => {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.getByRole("tab", { name: "My files" }).click();
  await page.locator('.card[title$="/plants/tree.l"]').click();
  await shows(8);
  await grown();
  assert.equal(await page.locator(".setting").count(), 3);
  await shot(page, "tree");
});

test("an error is underlined where it is, the plant stays, and mending it grows the plant anew", async () => {
  const before = await picture();
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("Wrong(");
  await page.waitForSelector(".cm-lintRange-error, .cm-lint-marker-error");
  assert.deepEqual(await picture(), before);
  await shot(page, "error");
  for (let i = 0; i < "Wrong()".length; i++) await page.keyboard.press(i === 0 ? "Delete" : "Backspace");
  await page.waitForFunction(() => !document.querySelector(".cm-lintRange-error"));
  await grown();
});

test("dragging a slider changes the picture while it moves, and is one thing to undo", async () => {
  const before = await picture();
  const slider = page.locator("#setting-ANGLE");
  const box = await slider.boundingBox();
  await page.mouse.move(box.x + box.width * 0.36, box.y + box.height / 2);
  await page.mouse.down();
  for (let i = 0; i < 12; i++) await page.mouse.move(box.x + box.width * (0.4 + i * 0.04), box.y + box.height / 2);
  const during = await picture();
  assert.notDeepEqual(during, before);
  await page.mouse.up();
  await shot(page, "slider");
  assert.notEqual(await slider.inputValue(), "32");
  assert.match(await page.locator(".cm-content").textContent(), /ANGLE (?!32 )/);
  await page.getByRole("button", { name: /^Undo: / }).click();
  await page.waitForFunction(() => document.querySelector("#setting-ANGLE").value === "32");
  assert.match(await page.locator(".cm-content").textContent(), /ANGLE 32 /);
});

test("the timeline shows every step, and again without asking for it twice", async () => {
  await page.locator(".scrub").focus();
  for (let step = 7; step >= 2; step--) {
    await page.keyboard.press("ArrowLeft");
    await shows(step);
    await page.waitForFunction((label) => document.querySelector(".step-label").textContent === label, `${step} / 8`);
  }
  const small = await picture();
  await shot(page, "scrub");
  for (let step = 3; step <= 7; step++) {
    await page.keyboard.press("ArrowRight");
    await shows(step);
  }
  const growth = await viewport().getAttribute("data-growth");
  const mine = page.packets.filter((packet) => packet.startsWith(`${growth} `));
  assert.deepEqual(
    mine.filter((packet, index) => mine.indexOf(packet) !== index),
    [],
  );
  await page.keyboard.press("End");
  await shows(8);
  assert.notDeepEqual(await picture(), small);
});

test("the plant plays from its first step to its last", async () => {
  await page.selectOption("[aria-label='Steps a second']", "4");
  await page.evaluate(() => {
    const viewport = document.querySelector(".viewport");
    window.stepsShown = [];
    new MutationObserver(() => window.stepsShown.push(Number(viewport.dataset.step))).observe(viewport, { attributeFilter: ["data-step"] });
  });
  await page.getByRole("button", { name: "Play (P)" }).click();
  // A slow machine may leave out steps, but neither the first nor the last.
  await page.waitForFunction(() => window.stepsShown.includes(0) && window.stepsShown.at(-1) === 8);
  const steps = await page.evaluate(() => window.stepsShown.slice(window.stepsShown.indexOf(0)));
  assert.deepEqual(steps, [...steps].sort((a, b) => a - b));
});

test("an organ tells what it is, its history and the production that made it", async () => {
  const box = await canvas().boundingBox();
  // The trunk stands in the middle, near the ground.
  for (let part = 0.9; part > 0.5; part -= 0.02) {
    await page.mouse.click(box.x + box.width / 2, box.y + box.height * part);
    await answered(page);
    if (await page.locator(".pick .facts").count()) break;
  }
  await page.waitForSelector(".pick .facts");
  assert.match(await page.locator(".pick-head code").textContent(), /^Internode\(/);
  assert.ok((await page.locator(".pick .small-chart canvas").count()) >= 2);
  await page.waitForSelector(".marked-line");
  await shot(page, "organ");
  await page.locator(".place").first().click();
  assert.match(await page.locator(".cm-activeLine").textContent(), /-->|Internode/);
});

test("another seed is another plant, and undo brings the first one back", async () => {
  await page.getByRole("tab", { name: "Settings" }).click();
  const before = await picture();
  const seed = await page.locator("#setting-seed").inputValue();
  await page.getByRole("button", { name: "Dice" }).click();
  await page.waitForFunction((old) => document.querySelector("#setting-seed").value !== old, seed);
  await grown();
  assert.notDeepEqual(await picture(), before);
  await canvas().focus();
  await page.keyboard.press("Control+z");
  await page.waitForFunction((old) => document.querySelector("#setting-seed").value === old, seed);
  await grown();
  await page.locator(".pick-head [aria-label='Forget this organ']").evaluateAll((buttons) => buttons.forEach((button) => button.click()));
  await shot(page, "seed");
});

test("charts follow the statistics, and a pinned growth stays beside a later one", async () => {
  await page.getByRole("tab", { name: "Charts" }).click();
  await page.waitForSelector(".chart canvas");
  await page.getByRole("button", { name: "Pin this growth", exact: true }).click();
  await page.getByRole("tab", { name: "Settings" }).click();
  await page.locator("#setting-RATIO").focus();
  for (let i = 0; i < 20; i++) await page.keyboard.press("ArrowLeft");
  await grown();
  await page.getByRole("tab", { name: "Charts" }).click();
  await page.waitForSelector(".chart");
  await rests(page);
  await shot(page, "charts");
  assert.match(await page.locator(".chart").first().textContent(), /pinned/);
});

test("an export is a file that holds the plant", async () => {
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("menuitem", { name: /^Export/ }).click();
  await page.selectOption("#export-format", "obj");
  await shot(page, "export");
  const [file] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Export", exact: true }).click(),
  ]);
  assert.match(readFileSync(await file.path(), "utf8"), /^v /m);
});

test("the shared HTML shows the growth without a server", async () => {
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("menuitem", { name: /^Share as HTML/ }).click();
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Write the file" }).click()]);
  const path = join(place.base, "shared.html");
  await file.saveAs(path);
  const alone = await openPage(browser, `file://${path}`, { offline: true });
  await alone.waitForFunction(() => document.body.dataset.step === "8");
  await rests(alone);
  const whole = await alone.locator("canvas").screenshot();
  await shot(alone, "shared");
  await alone.getByRole("button", { name: "Play" }).click();
  await alone.waitForFunction(() => Number(document.body.dataset.step) < 8); // which one depends on how busy the machine is
  await alone.waitForFunction(() => document.body.dataset.step === "8");
  await alone.locator("input[type=range]").fill("2");
  await rests(alone);
  assert.notDeepEqual(await alone.locator("canvas").screenshot(), whole);
  assert.deepEqual(alone.problems, []);
  await alone.context().close();
});

test("a link opens the same model in a studio", async () => {
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("menuitem", { name: /^Share as a link/ }).click();
  const link = await page.getByRole("textbox", { name: "Link" }).inputValue();
  assert.ok(link.length < 8000 && link.includes("\nespalier:model="));
  assert.match(await page.locator(".shared-files").textContent(), /tree\.l/);
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.locator(".gallery .search").fill(link);
  const dialog = page.getByRole("dialog", { name: "Open a link" });
  assert.match(await dialog.textContent(), /shared\/tree.*tree\.l, [\d,]+ bytes/s);
  const written = join(place.folder, "shared", "tree", "tree.l");
  assert.ok(!existsSync(written));
  await dialog.getByRole("button", { name: "Write and open" }).click();
  await page.locator("header [title$='/shared/tree/tree.l']").waitFor();
  await grown();
  assert.ok(existsSync(written));
  assert.match(await page.locator(".cm-content").textContent(), /A tree for tests/);
});

test("a recorded run opens from the gallery, is scrubbed and picked, and a slider grows what it grew from", async () => {
  const { base, folder } = place;
  execFileSync(programPath, ["run", join(folder, "tree.l"), "--steps", "6", "--output", join(folder, "output", "recorded")], {
    cwd: base,
  });
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.getByRole("tab", { name: "My files" }).click();
  await page.locator('.card[title$="/recorded"]').click();
  await page.waitForFunction(() => document.title.startsWith("recorded"));
  await grown();
  await shows(6);
  await page.locator(".scrub").fill("3");
  await shows(3);
  await page.locator(".scrub").fill("6");
  await shows(6);
  await page.getByLabel("Colour by").selectOption("age");
  await shot(page, "run");
  await page.getByLabel("Colour by").selectOption("");
  await page.getByRole("tab", { name: "Settings" }).click();
  await page.locator("#setting-RATIO").focus();
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => document.title.startsWith("tree"));
  await grown();
  await shows(6);
  await page.getByRole("button", { name: /^Undo: / }).click();
  await page.waitForFunction(() => document.title.startsWith("recorded"));
  await grown();
  await page.getByRole("button", { name: /^Redo: / }).click();
  await page.waitForFunction(() => document.title.startsWith("tree"));
  await grown();
});

test("two pages show the same plant", async () => {
  const other = await openPage(browser, program.address);
  await other.waitForSelector(".viewport[data-step]");
  await page.getByRole("tab", { name: "Settings" }).click();
  await page.locator("#setting-CURLY").click();
  await other.waitForFunction(() => document.querySelector("#setting-CURLY").checked);
  await grown(other);
  await shot(other, "second-page");
  assert.deepEqual(other.problems, []);
  await other.context().close();
});

test("points of a function are dragged, and the text follows", async () => {
  writeFileSync(join(place.folder, "curved.l"), tree.replace("&(ANGLE)", "&(ANGLE * func(1, 0.5))"));
  writeFileSync(
    join(place.folder, "bend.func"),
    "fver 1 1\nname: bend\nsamples: 10\nflip: off\npoints: 4\n0 0\n0.3 0.5\n0.7 0.6\n1 1\n",
  );
  writeFileSync(join(place.folder, "curved.v"), "function: bend.func\n");
  writeFileSync(join(place.folder, "curved.toml"), '[simulation]\nsteps = 7\n[[plant]]\nmodel = "curved.l"\nview = "curved.v"\n');
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.getByRole("tab", { name: "My files" }).click();
  await page.locator('.card[title$="/curved.toml"]').click();
  await page.getByRole("tab", { name: /bend\.func/ }).click();
  await grown();
  const before = await picture();
  const point = await page.locator(".point").nth(2).boundingBox();
  await page.mouse.move(point.x + 5, point.y + 5);
  await page.mouse.down();
  await page.mouse.move(point.x + 5, point.y - 60, { steps: 6 });
  await page.mouse.up();
  await grown();
  assert.notDeepEqual(await picture(), before);
  assert.doesNotMatch(await page.locator(".cm-content").textContent(), /0\.7 0\.6/);
  await shot(page, "function");
});

test("a graph of components is drawn, and the form of a component changes the plant", async () => {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.locator(".gallery .search").fill("bush.pgraph");
  await page.locator('.card[title$="/bush.pgraph"]').click();
  await page.waitForFunction(() => document.title.startsWith("bush.pgraph"));
  await grown();
  const before = await picture();
  await page.getByRole("tab", { name: "Graph", exact: true }).click();
  await page.getByRole("button", { name: "fork, Phiball" }).click();
  await page.waitForSelector(".marked-line");
  await page.locator("#graph-count").fill("2");
  await page.locator("#graph-count").press("Enter");
  await page.waitForFunction(() => /count 2/.test(document.querySelector(".cm-content").textContent));
  await grown();
  assert.notDeepEqual(await picture(), before);
  await shot(page, "graph");
  await page.getByRole("tab", { name: "Settings" }).click();
});

test("every control has a name, and the keys reach the picture", async () => {
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select, textarea, canvas[tabindex]")]
      .filter((element) => element.checkVisibility() && !element.closest(".cm-editor"))
      .filter(
        (element) =>
          !(element.getAttribute("aria-label") || element.title || element.labels?.length || element.textContent.trim()),
      )
      .map((element) => element.outerHTML.slice(0, 120)),
  );
  assert.deepEqual(nameless, []);
  const before = await picture();
  await canvas().focus();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  assert.notDeepEqual(await picture(), before);
  await page.keyboard.press("Home");
  await page.getByRole("button", { name: "Light or dark" }).click();
  await rests(page);
  await shot(page, "dark");
  await page.getByRole("button", { name: "Light or dark" }).click();
});

test("texts and signs stand out from what is behind them, in both themes", async () => {
  const pairs = [
    ["--text", "--panel"],
    ["--text", "--page"],
    ["--text-soft", "--panel"],
    ["--text-soft", "--panel-soft"],
    ["--text-soft", "--page"],
    ["--accent", "--panel"],
    ["--accent-text", "--accent"],
    ["--error", "--error-soft"],
    ["--warning", "--panel"],
    ["--text", "--mark"],
    ...["comment", "keyword", "string", "number", "name", "sign", "meta"].map((name) => [`--syntax-${name}`, "--panel"]),
  ];
  for (const theme of ["light", "dark"]) {
    const ratios = await page.evaluate(contrasts, { theme, pairs });
    assert.deepEqual(
      ratios.filter(({ ratio }) => ratio < 4.5),
      [],
      theme,
    );
  }
});

/** Contrast ratios as WCAG 2.2 defines them. */
function contrasts({ theme, pairs }) {
  const root = document.documentElement;
  const before = root.dataset.theme;
  root.dataset.theme = theme;
  const style = getComputedStyle(root);
  const luminance = (name) => {
    const bytes = style
      .getPropertyValue(name)
      .trim()
      .slice(1)
      .match(/../g)
      .map((part) => parseInt(part, 16) / 255);
    const [r, g, b] = bytes.map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ratios = pairs.map(([text, ground]) => {
    const [low, high] = [luminance(text), luminance(ground)].sort((a, b) => a - b);
    return { text, ground, ratio: (high + 0.05) / (low + 0.05) };
  });
  root.dataset.theme = before;
  return ratios;
}

test("a leaf shows the course of its day, and a click on a curve goes to that hour", async () => {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.locator(".gallery .search").fill("leaf-day");
  await page.locator('.card[title*="leaf-day"]').first().click();
  await page.waitForFunction(() => document.title.includes("leaf-day"));
  await grown();
  await page.getByLabel("Step", { exact: true }).fill("26");
  await shows(26);
  const box = await canvas().boundingBox();
  search: for (let y = 0.15; y < 0.6; y += 0.02) {
    for (const x of [0.5, 0.53, 0.47, 0.56, 0.44]) {
      await page.mouse.click(box.x + box.width * x, box.y + box.height * y);
      await answered(page);
      if ((await page.locator(".pick-head code").allTextContents()).includes("L")) break search;
    }
  }
  await page.waitForSelector(".pick .day");
  for (const name of ["light.flux", "leaves.assimilation", "leaves.transpiration", "leaves.conductance", "leaves.temperature"]) {
    assert.equal(await page.locator(`.day [aria-label="${name} by hour"] canvas`).count(), 1, name);
  }
  assert.match(await page.locator(".day").textContent(), /leaves\.assimilation, umol m-2 s-1/);
  await shot(page, "day");
  const curve = page.locator('.day [aria-label="leaves.assimilation by hour"] .u-over');
  await curve.click({ position: { x: 5, y: 20 } });
  await page.waitForFunction(() => Number(document.querySelector(".viewport").dataset.step) < 5);
});

test("the work is found again after the program was killed in the middle of a growth", async () => {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.getByRole("tab", { name: "My files" }).click();
  await page.locator('.card[title$="/plants/tree.l"]').click();
  await page.waitForFunction(() => document.title.startsWith("tree.l"));
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+Home");
  await page.keyboard.type("/* kept work */ ");
  await page.getByRole("tab", { name: "Settings" }).click();
  await page.locator("#setting-steps").fill("14");
  await page.keyboard.press("Enter");
  await keeps(place, "kept work", '"steps":14');
  await program.kill("SIGKILL");
  await page.waitForSelector(".banner:not([hidden])");
  await shot(page, "lost");
  assert.match(await page.locator(".cm-content").textContent(), /kept work/);
  assert.deepEqual(
    page.problems.filter((text) => !/ERR_CONNECTION_REFUSED|WebSocket/.test(text)),
    [],
  );
  program = await startProgram(programPath, place);
  page = await openPage(browser, program.address);
  await page.waitForFunction(() => /kept work/.test(document.querySelector(".cm-content")?.textContent ?? ""));
  await shot(page, "found-again");
});
