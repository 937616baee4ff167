// The editors of side files and the look of the picture, in a real browser; all.mjs runs it behind the rest.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { after, before, describe, test } from "node:test";
import { grown as grownOn, openBrowser, openPage, rests, shot, told } from "./browser.mjs";
import { startProgram, workFolder } from "./program.mjs";

const programPath = resolve(process.argv[2] ?? "build/release/espalier");
const place = workFolder();
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** A shoot with everything that L-studio has editors for. */
const shoot = `#define GROWN 6   /* steps until a leaf has its size; 1..20 */
lsystem: 1
derivation length: 8
axiom: ;(1) @Tx(1) A
A --> I(0) [ &(60) ;(2) L(0) ] /(137.5) A
I(t) : t < GROWN --> I(t + 1)
L(t) : t < GROWN --> L(t + 1)
homomorphism
I(t) --> !(0.1 + 0.05 * t) F(0.4) [ +(90) f(0.3) @L("%d", t) ]
L(t) --> ~l(0.3 + 0.2 * t)
endlsystem
`;
const corners = [0, 1, 2, 3].flatMap((row) =>
  [0, 1, 2, 3].map((column) => `${((column - 1.5) * 0.3).toFixed(4)} ${(row * 0.4).toFixed(4)} ${row === 3 ? "0.2000" : "0.0000"}`),
);
const leaf = `-0.5 0.5 0 1.2 -0.1 0.3
CONTACT POINT X: 0.00 Y: 0.00 Z: 0.00
END POINT X: 0.00 Y: 1.20 Z: 0.00
HEADING X: 0.00 Y: 1.00 Z: 0.00
UP X: 0.00 Y: 0.00 Z: 1.00
SIZE: 1.00
blade
TOP COLOR: 0 DIFFUSE: 0 BOTTOM COLOR: 0 DIFFUSE: 0
AL: ~ A: ~ AR: ~
L: ~ R: ~
BL: ~ B: ~ BR: ~
${[0, 4, 8, 12].map((row) => corners.slice(row, row + 4).join("  ")).join("\n")}
`;

function writeObject(folder) {
  writeFileSync(join(folder, "shoot.l"), shoot);
  writeFileSync(join(folder, "leaf.s"), leaf);
  writeFileSync(join(folder, "rough.bark"), "size = 64\n");
  writeFileSync(join(folder, "shoot.v"), "surface: l leaf.s 1\nline style: cylinder\ntexture: F rough.bark\n");
  const scene = (colours) =>
    `[simulation]\nsteps = 8\n[[plant]]\nmodel = "shoot.l"\nview = "shoot.v"\n${colours}\n[environment.light]\nprocess = "voxel-shade"\nvoxel = 0.25\n`;
  const map = new Uint8Array(768).map((_, i) => [110, 80, 50, 60, 140, 60][i % 6]);
  writeFileSync(join(folder, "shoot.map"), map);
  writeFileSync(join(folder, "mapped.toml"), scene('colour_map = "shoot.map"'));
  const brown = [1, 0, 40, 30, 20, 110, 80, 50, 0, 0, 0, 0, 0, 0, 0];
  const green = [2, 0, 20, 50, 20, 60, 140, 60, 0, 0, 0, 0, 0, 0, 0];
  writeFileSync(join(folder, "shoot.mat"), new Uint8Array([...brown, ...green]));
  writeFileSync(join(folder, "matted.toml"), scene('materials = "shoot.mat"'));
  writeFileSync(
    join(folder, "laid.l"),
    "#define GROWN 4   /* steps until a leaf has its size; 1..20 whole */\n#define ANGLE 30  /* of leaves; 0..90; degrees */\n" +
      "#define LENGTH 1  /* of internodes; 0.1..5; m */\n#define WIDTH 0.1 /* of internodes; 0.01..1; m */\n" +
      "lsystem: 1\nderivation length: 4\naxiom: A\nA --> !(WIDTH) F(LENGTH) [ &(ANGLE) F(GROWN / 10) ] /(137.5) A\nendlsystem\n",
  );
  writeFileSync(
    join(folder, "laid.panel"),
    '[[panel]]\ntitle = "Internodes"\ncolumns = 2\nsettings = [\n  { name = "WIDTH", label = "Thickness" },\n' +
      '  { name = "LENGTH", label = "Length", unit = "metres", lowest = 0.5, highest = 2, step = 0.25 },\n]\n\n' +
      '[[panel]]\ntitle = "Leaves"\nopen = false\nsettings = ["ANGLE"]\n',
  );
  const curve = (name, ...points) => `fver 1 1\nname: ${name}\nsamples: 0\nflip: off\npoints: ${points.length}\n${points.join("\n")}\n`;
  const falling = curve("FALLING", "0 0.8", "0.4 0.4", "0.6 0.4", "1 0.2");
  const steep = curve("STEEP", "0 90", "0.3 60", "0.6 40", "1 30");
  writeFileSync(join(folder, "set.fset"), `funcgalleryver 1 1\nitems: 2\n${falling}${steep}`);
  writeFileSync(join(folder, "swelling.func"), curve("swelling", "0 0", "0.25 0.5", "0.75 1", "1 1.5"));
  writeFileSync(join(folder, "functions.v"), "function set: set.fset\nfunction: swelling.func\n");
  writeFileSync(join(folder, "functions.toml"), '[simulation]\nsteps = 2\n[[plant]]\nmodel = "shoot.l"\nview = "functions.v"\n');
}

describe("editors of side files", () => {
  let program;
  let browser;
  let page;

  const canvas = () => page.locator(".viewport canvas");
  const text = () => page.evaluate(() => document.querySelector(".cm-content").innerText);
  /** A digest of the picture once it rests and its limbs are drawn as they are to be. */
  const picture = async () => {
    await rests(page);
    return createHash("sha1").update(await canvas().screenshot()).digest("hex");
  };
  const grown = () => grownOn(page);
  const open = async (name) => {
    await page.getByRole("button", { name: "Gallery", exact: true }).click();
    await page.getByRole("tab", { name: "My files" }).click();
    await page.locator(`.card[title$="/${name}"]`).click();
    await page.waitForFunction((title) => document.title.startsWith(title), name);
    await grown();
  };
  const tab = (name) => page.getByRole("tab", { name }).click();
  const undo = async () => {
    await page.getByRole("button", { name: /^Undo: / }).click();
    await grown();
  };
  const saved = async (name) => {
    await page.getByRole("button", { name: "Save", exact: true }).click();
    await page.getByRole("button", { name: "Dismiss" }).first().click();
    return readFileSync(join(place.folder, name));
  };

  before(async () => {
    writeObject(place.folder);
    program = await startProgram(programPath, place);
    browser = await openBrowser();
    page = await openPage(browser, program.address);
    await told(page);
    await page.waitForSelector(".viewport[data-step]");
    await page.getByRole("button", { name: "No more hints" }).click();
  });

  after(async () => {
    assert.deepEqual(page.problems, []);
    await browser?.close();
    await program?.kill();
  });

  /** Controls that a reader of screens could not name. */
  const nameless = () =>
    page.evaluate(() =>
      [...document.querySelectorAll("button, input, select, textarea, [role=slider]")]
        .filter((element) => element.checkVisibility() && !element.closest(".cm-editor"))
        .filter(
          (element) =>
            !(element.getAttribute("aria-label") || element.title || element.labels?.length || element.textContent.trim()),
        )
        .map((element) => element.outerHTML.slice(0, 120)),
    );

  /** Rules of axe that a part of the page breaks. */
  const broken = async (part) => {
    await page.evaluate(axe);
    return page.evaluate(
      async (where) => (await window.axe.run(where, { resultTypes: ["violations"] })).violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`),
      part,
    );
  };

  test("a point of a surface is dragged: text and picture follow, and undo brings both back", async () => {
    await open("mapped.toml");
    await tab(/leaf\.s/);
    const [words, before] = [await text(), await picture()];
    const point = await page.locator(".surface .point").nth(13).boundingBox();
    await page.mouse.move(point.x + 4, point.y + 4);
    await page.mouse.down();
    await page.mouse.move(point.x + 44, point.y - 46, { steps: 6 });
    await page.mouse.up();
    await grown();
    assert.notEqual(await text(), words);
    assert.notEqual(await picture(), before);
    await shot(page, "surface");
    assert.deepEqual(await nameless(), []);
    await undo();
    assert.equal(await text(), words);
    assert.equal(await picture(), before);
    assert.equal((await saved("leaf.s")).toString(), leaf);
  });

  test("a range of a colour map is blended: picture and bytes follow, and undo brings the bytes back", async () => {
    const original = readFileSync(join(place.folder, "shoot.map"));
    await tab(/shoot\.map/);
    const before = await picture();
    await page.getByRole("button", { name: "Colour 2", exact: true }).click();
    await page.getByRole("button", { name: "Colour 9", exact: true }).click({ modifiers: ["Shift"] });
    await page.getByLabel("Colour at the beginning of the range").fill("#ff2000");
    await page.getByLabel("Colour at the end of the range").fill("#0020ff");
    await grown();
    assert.notEqual(await picture(), before);
    await shot(page, "colour-map");
    assert.deepEqual(await nameless(), []);
    const bytes = await saved("shoot.map");
    assert.deepEqual([...bytes.subarray(6, 9)], [255, 32, 0]);
    assert.deepEqual([...bytes.subarray(27, 30)], [0, 32, 255]);
    assert.deepEqual([...bytes.subarray(15, 18)], [146, 32, 109]); // three sevenths of the way
    assert.deepEqual(bytes.subarray(30), original.subarray(30));
    while (await page.getByRole("button", { name: /^Undo: Edit shoot\.map/ }).count()) await undo();
    assert.equal(await picture(), before);
    assert.deepEqual(await saved("shoot.map"), original);
  });

  test("the form of a view file changes its text and the picture, and takes a setting out again", async () => {
    await tab(/shoot\.v/);
    const [words, before] = [await text(), await picture()];
    await page.getByRole("button", { name: "Add light" }).click();
    await page.getByLabel("light: where it comes from, infinitely far away x").fill("-2");
    await page.keyboard.press("Enter");
    await page.locator("input[aria-label='background color']").fill("#336699");
    await grown();
    assert.match(await text(), /light: V -2 1 0/);
    assert.match(await text(), /background color: 0\.2 0\.4 0\.6/);
    assert.notEqual(await picture(), before);
    await shot(page, "view-form");
    assert.deepEqual(await nameless(), []);
    await page.getByText("Turtle", { exact: true }).click();
    const width = page.locator("input[type=range][aria-label='angle increment']");
    await width.focus();
    await page.keyboard.press("ArrowRight");
    await grown();
    assert.match(await text(), /angle increment: 46/);
    await page.getByRole("button", { name: /Take "angle increment" out/ }).click();
    await page.getByRole("button", { name: /Take "background color" out/ }).click();
    await page.getByRole("button", { name: "Remove light" }).click();
    await grown();
    assert.equal((await text()).trim(), words.trim());
  });

  test("a material has colours and transparency, which its bytes and the picture have too", async () => {
    const original = readFileSync(join(place.folder, "shoot.mat"));
    await open("matted.toml");
    await tab(/shoot\.mat/);
    const before = await picture();
    await page.getByRole("option", { name: "Material 2" }).click();
    await page.getByLabel("Diffuse").fill("#c02060");
    await page.getByLabel("Transparency").fill("120");
    await grown();
    assert.notEqual(await picture(), before);
    await shot(page, "materials");
    assert.deepEqual(await nameless(), []);
    const bytes = await saved("shoot.mat");
    assert.deepEqual([...bytes.subarray(15, 23)], [2, 120, 20, 50, 20, 0xc0, 0x20, 0x60]);
    while (await page.getByRole("button", { name: /^Undo: Edit shoot\.mat/ }).count()) await undo();
    assert.deepEqual(await saved("shoot.mat"), original);
  });

  test("a new function is made beside the model, named by the view file, and opens in its editor", async () => {
    await page.getByRole("button", { name: /^New side file/ }).click();
    await shot(page, "new-file");
    await page.getByRole("menuitem", { name: /^Function/ }).click();
    await page.locator("#new-file-name").fill("vigour.func");
    await page.keyboard.press("Enter");
    await page.waitForSelector(".tab[aria-selected=true]:has-text('vigour.func')");
    await page.waitForSelector(".point-plane .point");
    assert.match(readFileSync(join(place.folder, "vigour.func"), "utf8"), /^name: vigour$/m);
    await tab(/shoot\.v/);
    assert.match(await text(), /function: vigour\.func/);
    await shot(page, "function-new");
  });

  test("names are completed and explained in scenes, view files and other notations", async () => {
    const completes = async (typed, expected) => {
      await page.locator(".cm-content").click();
      await page.keyboard.press("Control+End");
      await page.keyboard.type(typed);
      await page.locator(".cm-tooltip-autocomplete li", { hasText: expected }).first().waitFor();
      await page.keyboard.press("Escape");
      for (let i = 0; i < typed.length; i++) await page.keyboard.press("Backspace");
    };
    const explains = async (line, word) => {
      const box = await page.locator(".cm-line", { hasText: line }).first().boundingBox();
      await page.mouse.move(box.x + 30, box.y + 9);
      await page.mouse.move(box.x + 32, box.y + 10);
      await page.waitForSelector(".cm-tooltip-hover");
      assert.match(await page.locator(".cm-tooltip-hover").innerText(), word);
      await page.mouse.move(600, 300);
    };
    await tab(/matted\.toml/);
    await completes("dissi", "dissipation");
    await explains("voxel =", /edge of a voxel/);
    await tab(/shoot\.v/);
    await completes("scale m", "scale multiplier:");
    await explains("line style", /how lines are drawn/);
    await page.getByRole("button", { name: "Gallery", exact: true }).click();
    await page.locator(".gallery .search").fill("bush.pgraph");
    await page.locator('.card[title$="/bush.pgraph"]').click();
    await page.waitForFunction(() => document.title.startsWith("bush.pgraph"));
    await grown();
    assert.equal(await page.locator(".graph-box .graph-symbol").count(), await page.locator(".graph-box").count());
    await explains("Phiball fork", /Phiball/);
    await explains("recursion 5", /recursion/);
    await page.getByRole("button", { name: "Gallery", exact: true }).click();
    await page.locator(".gallery .search").fill(".species");
    await page.locator('.card[title$=".species"]').first().click();
    await page.waitForFunction(() => document.title.includes(".species"));
    await grown();
    await completes("RatioP", "RatioPower");
  });

  test("limbs wear bark, labels show, and a smooth skin is made on demand", async () => {
    await open("mapped.toml");
    const tubes = await picture();
    await shot(page, "bark");
    const look = page.getByRole("button", { name: /^What is drawn/ });
    await look.click();
    await page.getByRole("menuitemcheckbox", { name: /Smooth skin/ }).click();
    await page.waitForFunction(() => document.querySelector(".viewport canvas").dataset.limbs === "smooth");
    assert.notEqual(await picture(), tubes);
    await shot(page, "skin");
    await look.click();
    await page.getByRole("menuitemcheckbox", { name: /Smooth skin/ }).click();
    assert.equal(await picture(), tubes);
    await look.click();
    await page.getByRole("menuitemcheckbox", { name: /Labels/ }).click();
    assert.notEqual(await picture(), tubes);
    await look.click();
    await page.getByRole("menuitemcheckbox", { name: /Labels/ }).click();
  });

  test("a field shows as the surface of one value, which a slider moves", async () => {
    await page.selectOption("[aria-label=Field]", "light");
    await page.selectOption("[aria-label='Field as']", "surface");
    await page.getByLabel("Value on the surface").fill("0.5");
    const half = await picture();
    await shot(page, "field-surface");
    await page.getByLabel("Value on the surface").fill("0.8");
    assert.notEqual(await picture(), half);
    await page.selectOption("[aria-label=Field]", "");
    assert.notEqual(await picture(), half);
  });

  test("the functions of a model show in one plane, one of them is edited, and axes have numbers", async () => {
    await open("functions.toml");
    await tab(/set\.fset/);
    const names = await page.locator(".function-row label").allInnerTexts();
    assert.deepEqual(names.map((name) => name.trim().replace(/\s+/g, " ")), ["FALLING", "STEEP", "swelling swelling.func"]);
    const ticks = (kind) => page.locator(`.point-plane .tick${kind}`).allTextContents();
    assert.deepEqual(await ticks(".across"), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    // STEEP is of another range, and FALLING would be flat beside it.
    assert.deepEqual(await ticks(":not(.across)"), ["0", "0.5", "1.0", "1.5"]);
    assert.equal(await page.locator(".point-plane .curve.behind").count(), 1);
    await page.getByLabel("Show STEEP behind").check();
    assert.deepEqual(await ticks(":not(.across)"), ["0", "20", "40", "60", "80", "100"]);
    await page.getByLabel("Show STEEP behind").uncheck();

    const values = () => page.locator(".function-row output").allTextContents();
    await page.locator(".point-plane .point").first().focus();
    assert.deepEqual(await values(), ["0.8", "", "0"]);
    const box = await page.locator(".point-plane").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    const [x] = (await page.locator(".plane-place").textContent()).match(/[\d.]+/);
    // Bernstein's polynomials of the control points; x has the four digits that show.
    const cubic = (points, t) => points.reduce((sum, point, i) => sum + point * [1, 3, 3, 1][i] * t ** i * (1 - t) ** (3 - i), 0);
    let t = 0.5;
    for (let i = 0; i < 60; i++) t -= (cubic([0, 0.4, 0.6, 1], t) - Number(x)) / 1.2;
    assert.ok(Math.abs(Number((await values())[0]) - cubic([0.8, 0.4, 0.4, 0.2], t)) < 1e-3);
    await shot(page, "functions");

    await page.locator(".point-plane .point").nth(1).focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowUp");
    await grown();
    assert.match(await text(), /\n0\.41 0\.425\n/);
    await page.getByLabel("y of the point").fill("3");
    await page.keyboard.press("Enter");
    await grown();
    assert.match(await text(), /\n0\.41 3\n/);
    assert.deepEqual(await ticks(":not(.across)"), ["0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"]);

    const radio = (name) => page.getByRole("radio", { name });
    await radio(/swelling/).focus();
    await page.keyboard.press("Space");
    await page.waitForSelector(".tab[aria-selected=true]:has-text('swelling.func')");
    assert.ok(await radio("swelling").isChecked());
    assert.equal(await page.evaluate(() => document.activeElement.type), "radio");
    await page.keyboard.press("ArrowUp");
    await page.waitForSelector(".tab[aria-selected=true]:has-text('set.fset')");
    assert.ok(await radio("STEEP").isChecked());
    await page.locator(".point-plane .point").nth(2).focus();
    await page.keyboard.press("Shift+ArrowDown");
    await grown();
    assert.match(await text(), /\n0\.6 30\n/);
    assert.deepEqual(await nameless(), []);
    for (const theme of ["dark", "light"]) {
      await page.getByRole("button", { name: "Light or dark" }).click();
      await page.waitForFunction((wanted) => document.documentElement.dataset.theme === wanted, theme);
      assert.deepEqual(await broken(".side-tools"), [], theme);
      await shot(page, `functions-${theme}`);
    }
  });

  test("sliders stand in the panels of their author, who edits them as a text", async () => {
    await open("laid.l");
    await page.getByRole("tab", { name: "Settings", exact: true }).click();
    const titles = () => page.locator(".settings summary").allInnerTexts();
    const labels = () => page.locator(".settings .setting-head label:visible").allInnerTexts();
    assert.deepEqual(await titles(), ["Internodes", "Leaves"]);
    assert.deepEqual((await labels()).map((label) => label.trim()), ["Thickness", "Length"]);
    const slider = page.getByRole("slider", { name: "Length" });
    assert.deepEqual(await slider.evaluate(({ min, max, step, value }) => [min, max, step, value]), ["0.5", "2", "0.25", "1"]);
    assert.equal(await page.locator(".setting:has(#setting-LENGTH) .unit").innerText(), "metres");
    const [left, right] = await Promise.all(["WIDTH", "LENGTH"].map((name) => page.locator(`.setting:has(#setting-${name})`).boundingBox()));
    assert.ok(left.y === right.y && right.x >= left.x + left.width, "side by side");
    await page.getByText("Leaves", { exact: true }).click();
    await page.getByRole("slider", { name: "Angle" }).waitFor();
    await shot(page, "panels");
    assert.deepEqual(await nameless(), []);
    assert.deepEqual(await broken(".settings"), []);

    await slider.focus();
    await page.keyboard.press("ArrowRight");
    await grown();
    await tab(/laid\.l/);
    assert.match(await text(), /#define LENGTH 1\.25 /);
    await undo();
    const all = page.getByRole("switch", { name: "All settings" });
    await all.check();
    assert.equal(await page.locator(".settings .setting").count(), 4);
    assert.equal(await page.evaluate(() => document.activeElement.id), "settings-all");
    await all.uncheck();
    assert.equal(await page.locator(".settings .setting").count(), 3);

    await tab(/laid\.panel/);
    const words = await text();
    await page.locator(".cm-line", { hasText: 'title = "Leaves"' }).click();
    await page.keyboard.press("End");
    for (let i = 0; i < 'Leaves"'.length; i++) await page.keyboard.press("Backspace");
    await page.keyboard.type('Twigs"');
    await page.waitForFunction(() => [...document.querySelectorAll(".settings summary")].some((one) => one.textContent === "Twigs"));
    await grown();
    await undo();
    assert.deepEqual(await titles(), ["Internodes", "Leaves"]);
    assert.equal(await text(), words);

    await open("shoot.l");
    await page.getByRole("button", { name: /^New side file/ }).click();
    await page.getByRole("menuitem", { name: /^Panels/ }).click();
    await page.keyboard.press("Enter");
    await page.waitForSelector(".tab[aria-selected=true]:has-text('shoot.panel')");
    assert.match(await text(), /{ name = "GROWN", label = "grown: steps until a leaf has its size", lowest = 1, highest = 20 }/);
    await page.getByRole("switch", { name: "All settings" }).waitFor();
  });
});
