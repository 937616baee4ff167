// Files, keys, links and the page itself, in a real browser: node tests/page.test.mjs PROGRAM
import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { grown as grownOn, openBrowser, openPage, rests, shot, told } from "./browser.mjs";
import { startProgram, tree, workFolder, writeDay } from "./program.mjs";

const programPath = resolve(process.argv[2] ?? "build/release/espalier");
const place = workFolder();
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
let program;
let browser;
let page;

const grown = (which = page) => grownOn(which);

async function shows(step) {
  await page.waitForFunction((wanted) => document.querySelector(".viewport").dataset.step === String(wanted), step);
}

async function openFromGallery(words, which = page) {
  await which.getByRole("button", { name: "Gallery", exact: true }).click();
  await which.fill(".gallery .search", words);
  await which.locator(".card").first().click();
  await which.locator(".gallery").waitFor({ state: "hidden" });
}

/** Tools over the picture that its edges cut off. */
const toolsCutOff = () =>
  page.evaluate(() => {
    const edges = document.querySelector(".viewport").getBoundingClientRect();
    const cut = ({ left, right }) => left < edges.left || right > edges.right;
    const tools = [...document.querySelectorAll(".picture-over :is(select, button, input, .field-tools *)")];
    return tools.filter((tool) => cut(tool.getBoundingClientRect()) && tool.offsetParent).map((tool) => tool.outerHTML.slice(0, 80));
  });

const text = () => page.locator(".cm-content").textContent();

before(async () => {
  writeDay(place.folder);
  program = await startProgram(programPath, place, [join(place.folder, "tree.l")]);
  browser = await openBrowser();
  page = await openPage(browser, program.address);
  await told(page);
  await page.waitForSelector(".viewport[data-step]");
});

after(async () => {
  await browser?.close();
  await program?.kill();
});

test("what the command line names is shown, and no gallery above it", async () => {
  await grown();
  assert.match(await page.title(), /^tree\.l/);
  assert.equal(await page.locator(".gallery").isVisible(), false);
});

test("wide and narrow pages show the plant", async () => {
  for (const [width, height, least] of [
    [390, 844, 380],
    [768, 1024, 280],
    [1024, 768, 380],
    [1280, 720, 500],
  ]) {
    await page.setViewportSize({ width, height });
    await rests(page);
    const box = await page.locator(".viewport canvas").boundingBox();
    assert.ok(box.width >= least && box.height >= 300, `${width}: ${box.width} x ${box.height}`);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, `${width} wide`);
    assert.deepEqual(await toolsCutOff(), [], `${width} wide`);
    const status = await page.locator(".status").evaluate((line) => [line.scrollWidth, line.clientWidth]);
    assert.ok(status[0] <= status[1], `${width} wide: the counts have ${status}`);
    await shot(page, `width-${width}`);
  }
  await page.setViewportSize({ width: 390, height: 844 });
  await page.getByRole("button", { name: "Show or hide the settings" }).click();
  const picture = await page.locator(".viewport canvas").boundingBox();
  const panel = await page.getByRole("complementary", { name: "Settings and measurements" }).boundingBox();
  await rests(page);
  assert.ok(panel.y >= picture.y + picture.height - 1 && picture.height > 250);
  await shot(page, "width-390-settings");
  await page.getByRole("button", { name: "Show or hide the settings" }).click();
  await page.setViewportSize({ width: 1280, height: 720 });
});

test("axe finds nothing critical or serious", async () => {
  await page.evaluate(axe);
  const findings = () =>
    page.evaluate(async () =>
      (await window.axe.run(document, { resultTypes: ["violations"] })).violations
        .filter(({ impact }) => impact === "critical" || impact === "serious")
        .map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`),
    );
  for (const name of ["Charts", "Organ", "Settings"]) {
    await page.getByRole("tab", { name, exact: true }).click();
    assert.deepEqual(await findings(), [], name);
  }
  await page.getByRole("button", { name: "Share" }).click();
  assert.deepEqual(await findings(), [], "menu");
  await page.getByRole("menuitem", { name: /^Export/ }).click();
  assert.deepEqual(await findings(), [], "export");
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  await page.waitForSelector(".card");
  assert.deepEqual(await findings(), [], "gallery");
});

test("keys stay in the gallery while it is open, and go back afterwards", async () => {
  const places = [];
  for (let i = 0; i < 40; i++) {
    await page.keyboard.press("Tab");
    places.push(await page.evaluate(() => Boolean(document.activeElement.closest(".columns, .timeline"))));
  }
  assert.ok(!places.includes(true));
  await page.getByRole("button", { name: "Back to the plant" }).click();
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Gallery");
});

test("screen readers are told how the growth stands", async () => {
  const state = page.getByRole("contentinfo").getByRole("status");
  assert.equal(await state.textContent(), "grown");
});

test("the picture is told in words, and keys go from organ to organ along the plant", async () => {
  const words = page.locator("#picture-words");
  await page.waitForFunction(() => /^1 plant, [\d.]+ m tall, 3,280 internodes, step 8 of 8$/.test(document.querySelector("#picture-words").textContent));
  await page.locator(".viewport canvas").focus();
  const places = [];
  for (let i = 0; i < 3; i++) {
    await page.keyboard.press("n");
    await page.waitForFunction((wanted) => document.querySelector("#picture-words").textContent.includes(`organ ${wanted} of 3,280`), i + 1);
    places.push(await page.locator(".pick-head code").textContent());
  }
  assert.equal(places[0], `Internode(7,${(1.02 ** 7).toPrecision(6)})`);
  assert.match(await words.textContent(), /, born in step \d/);
  assert.equal(await page.evaluate(() => document.activeElement.tagName), "CANVAS");
  await page.keyboard.press("b");
  await page.waitForFunction(() => document.querySelector("#picture-words").textContent.includes("organ 2 of 3,280"));
  assert.equal(await page.locator(".pick-head code").textContent(), places[1]);
  await shot(page, "organ-by-key");
  await page.keyboard.press("Escape");
  await page.keyboard.press("b");
  await page.waitForFunction(() => document.querySelector("#picture-words").textContent.includes("organ 3,280 of 3,280"));
  await page.keyboard.press("Escape");
  await page.getByRole("tab", { name: "Settings", exact: true }).click();
});

test("a number may be written with a decimal comma", async () => {
  const ratio = page.getByRole("textbox", { name: /as a number/ }).nth(1);
  await ratio.fill("0,75");
  await ratio.press("Enter");
  await page.waitForFunction(() => /#define RATIO 0\.75/.test(document.querySelector(".cm-content").textContent));
  await page.locator(".viewport canvas").focus();
  await page.keyboard.press("Control+z");
  await page.waitForFunction(() => /#define RATIO 0\.8 /.test(document.querySelector(".cm-content").textContent));
});

test("another program's text is read again, and where this page has changes it asks", async () => {
  const file = join(place.folder, "tree.l");
  writeFileSync(file, tree.replace("#define ANGLE 32", "#define ANGLE 21"));
  await page.waitForFunction(() => /#define ANGLE 21/.test(document.querySelector(".cm-content").textContent));
  await grown();
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+Home");
  await page.keyboard.type("/* mine */ ");
  await grown();
  writeFileSync(file, tree.replace("#define ANGLE 32", "#define ANGLE 55"));
  const question = page.locator(".dispute");
  await question.waitFor();
  assert.deepEqual(await question.locator("del code").allTextContents(), ["/* A tree for tests", "#define ANGLE 55      /* angle of branches; 5..80; degrees */"]);
  assert.deepEqual(await question.locator("ins code").allTextContents(), ["/* mine */ /* A tree for tests", "#define ANGLE 21      /* angle of branches; 5..80; degrees */"]);
  await shot(page, "dispute");
  await page.keyboard.press("Control+s");
  await page.locator(".message.error").waitFor();
  assert.match(readFileSync(file, "utf8"), /ANGLE 55/);
  await question.getByRole("button", { name: "Read the file again" }).click();
  await question.waitFor({ state: "detached" });
  assert.match(await text(), /#define ANGLE 55/);
  assert.doesNotMatch(await text(), /mine/);
  await page.getByRole("button", { name: "Dismiss" }).first().click();
});

test("a model of the library is saved with the files of the folder above that it reads", async () => {
  await openFromGallery("herbs/dichasium");
  await page.waitForFunction(() => document.title.startsWith("dichasium"));
  await grown();
  await page.keyboard.press("Control+s");
  await page.getByRole("dialog", { name: "Save as" }).getByRole("button", { name: "Save" }).click();
  await page.locator("header [title$='/plants/dichasium/herbs/dichasium.l']").waitFor();
  await grown();
  assert.ok(existsSync(join(place.folder, "dichasium/plants.map")));
  assert.match(readFileSync(join(place.folder, "dichasium/herbs/dichasium.l"), "utf8"), /dichasium/);
});

test("OBJ comes with its materials and the picture of its leaves", async () => {
  await openFromGallery("environments/tree.toml");
  await page.waitForFunction(() => document.title.startsWith("tree.toml"));
  await grown();
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("menuitem", { name: /^Export/ }).click();
  await page.selectOption("#export-format", "obj");
  await page.fill("#export-triangles", "20000");
  await shot(page, "export-options");
  const [file] = await Promise.all([
    page.waitForEvent("download", { timeout: 120_000 }),
    page.getByRole("button", { name: "Export", exact: true }).click(),
  ]);
  assert.match(file.suggestedFilename(), /\.zip$/);
  await file.saveAs(join(place.base, "tree.zip"));
  const bytes = readFileSync(await file.path(), "latin1");
  const [, library] = /\nmtllib (\S+)\n/.exec(bytes);
  const [, picture] = /\nmap_Kd (\S+)\n/.exec(bytes);
  for (const name of [library, picture]) assert.ok(bytes.lastIndexOf(name) > bytes.indexOf("PK\x01\x02"), name);
  const faces = bytes.match(/\nf /g).length;
  assert.ok(faces <= 20000 && faces > 10000, `${faces}`);
});

test("the cloud of points shows while a slider of the crown moves, and goes afterwards", async () => {
  const cloud = page.locator(".viewport canvas[data-cloud]");
  const slider = page.locator("[id$='CROWN_WIDTH'][type=range]").first();
  await slider.scrollIntoViewIfNeeded();
  const box = await slider.boundingBox();
  await page.mouse.move(box.x + box.width * 0.1, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.16, box.y + box.height / 2, { steps: 4 });
  await grown();
  await page.mouse.move(box.x + box.width * 0.2, box.y + box.height / 2, { steps: 4 });
  await cloud.waitFor({ state: "attached" });
  await shot(page, "cloud");
  await page.mouse.up();
  await cloud.waitFor({ state: "detached" });
  assert.match(await page.locator(".status .counts").textContent(), /[\d,]+ vertices.*[\d,]+ triangles/);
});

test("a search looks on every shelf, and its marked shelf says so", async () => {
  await page.getByRole("button", { name: "Gallery", exact: true }).click();
  const marked = page.locator(".gallery [role=tab][aria-selected=true]");
  await page.getByRole("tab", { name: "Cells" }).click();
  assert.equal(await marked.textContent(), "Cells");
  await page.fill(".gallery .search", "two-trees.toml");
  assert.equal(await marked.textContent(), "All");
  await page.fill(".gallery .search", "");
  assert.equal(await marked.textContent(), "Cells");
  await page.getByRole("tab", { name: "All", exact: true }).click();
  await page.getByRole("button", { name: "Back to the plant" }).click();
});

test("a field and the counts are those of the step that shows", async () => {
  await openFromGallery("two-trees.toml");
  await page.waitForFunction(() => document.title.startsWith("two-trees"));
  await page.locator("#setting-steps").fill("24");
  await page.keyboard.press("Enter");
  await grown();
  await shows(24);
  await page.getByLabel("Field", { exact: true }).selectOption("light");
  await page.waitForSelector(".viewport[data-field='light 24']");
  for (const width of [768, 900, 1024, 1280]) {
    await page.setViewportSize({ width, height: 720 });
    await rests(page);
    await shot(page, `field-${width}`);
    assert.deepEqual(await toolsCutOff(), [], `${width} wide`);
  }
  const modules = async () => Number(/([\d,]+) modules/.exec(await page.locator(".status .counts").textContent())[1].replace(",", ""));
  const last = await modules();
  await page.locator(".scrub").fill("3");
  await shows(3);
  await page.waitForSelector(".viewport[data-field='light 3']");
  assert.match(await page.locator(".legend").textContent(), /after step 3/);
  await page.getByLabel("Field", { exact: true }).selectOption("");
  await page.waitForFunction(() => document.querySelector(".legend").hidden);
  await page.getByLabel("Field", { exact: true }).selectOption("light");
  await page.waitForFunction(() => !document.querySelector(".legend").hidden);
  assert.ok((await modules()) < last);
  await page.locator(".scrub").fill("24");
  await shows(24);
  assert.equal(await modules(), last);
});

test("a scene's own names colour its plants, and sliders move them", async () => {
  await page.getByLabel("Colour by").selectOption("product");
  await page.waitForFunction(() => /product/.test(document.querySelector(".legend").textContent));
  await shot(page, "product");
  await page.getByLabel("Colour by").selectOption("");
  const slider = page.locator("[id='setting-plant.0.position.x']");
  assert.equal(await slider.inputValue(), "-2");
  assert.equal(await slider.getAttribute("max"), "5");
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => !/position = \[-2, 0, 0\]/.test(document.querySelector(".cm-content").textContent));
});

test("the sun of a scene goes its way through the steps, lights the plant, and can be switched off", async () => {
  await openFromGallery("plants/day.toml");
  await page.waitForFunction(() => document.title.startsWith("day.toml"));
  await grown();
  const dial = page.locator(".sun-dial");
  const look = async (step) => {
    await page.locator(".scrub").fill(String(step));
    await shows(step);
    await rests(page);
    return dial.getAttribute("aria-label");
  };
  const height = (words) => Number(/^The sun stands (\d+)° high: [\d.]+ umol m-2 s-1 of PAR, 20 % of it/.exec(words)[1]);
  // At 45 degrees, on the longest day, the sun stands 90 - 45 + 23.4 degrees high at noon.
  const noon = height(await look(12));
  assert.ok(Math.abs(noon - 68) <= 1, `${noon}`);
  await shot(page, "sun-noon");
  assert.match(await look(1), /dark/);
  const evening = height(await look(18)); // from 17 to 18 hours
  assert.ok(evening < 35 && evening > 15, `${evening}`);
  const flip = async () => {
    await page.getByRole("button", { name: /^What is drawn/ }).click();
    await page.getByRole("menuitemcheckbox", { name: "Sun and sky of the scene" }).click();
    await rests(page);
  };
  const lit = await page.locator(".viewport canvas").screenshot();
  await shot(page, "sun-evening");
  await flip();
  assert.equal(await dial.isVisible(), false);
  assert.notDeepEqual(await page.locator(".viewport canvas").screenshot(), lit);
  await flip();
  assert.equal(await dial.isVisible(), true);
  assert.deepEqual(await page.locator(".viewport canvas").screenshot(), lit);
});

test("plants that grow in light are coloured by what their organs absorb", async () => {
  await page.getByLabel("Colour by").selectOption("light.absorbed");
  await page.waitForFunction(() => /light\.absorbed/.test(document.querySelector(".legend").textContent));
  await rests(page);
  await shot(page, "absorbed");
  await page.getByLabel("Colour by").selectOption("");
});

test("a scene without a light process keeps the usual light", async () => {
  await openFromGallery("plants/tree.l");
  await page.waitForFunction(() => document.title.startsWith("tree.l"));
  await grown();
  assert.equal(await page.locator(".sun-dial").isVisible(), false);
  await page.getByRole("button", { name: /^What is drawn/ }).click();
  assert.equal(await page.getByRole("menuitemcheckbox", { name: "Sun and sky of the scene" }).count(), 0);
  await page.keyboard.press("Escape");
});

test("a link says what it needs, and opens in a studio at another port, by paste and from the command line", async () => {
  await openFromGallery("plants/tree.l");
  await page.waitForFunction(() => document.title.startsWith("tree.l"));
  await grown();
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByRole("menuitem", { name: /^Share as a link/ }).click();
  const link = await page.getByRole("textbox", { name: "Link" }).inputValue();
  await page.keyboard.press("Escape");
  assert.match(link, /^tree\.l, for Espalier \S+\. To open it, start "espalier studio" and paste/);
  assert.doesNotMatch(link, /127\.0\.0\.1|localhost/);
  const packed = /model=([\w-]+)/.exec(link)[1];
  // Links of older versions name the port of whoever sent them.
  for (const pasted of [link, `http://127.0.0.1:1/#model=${packed}`]) {
    await page.getByRole("button", { name: "Gallery", exact: true }).click();
    await page.locator(".gallery .search").fill(pasted.replace("\n", " "));
    await page.getByRole("dialog", { name: "Open a link" }).waitFor();
    await page.keyboard.press("Escape");
    await page.getByRole("button", { name: "Back to the plant" }).click();
  }
  const other = await startProgram(programPath, workFolder(), [link]);
  const second = await openPage(browser, other.address);
  await second.getByRole("dialog", { name: "Open a link" }).getByRole("button", { name: "Write and open" }).click();
  await second.waitForFunction(() => document.title.startsWith("tree.l"));
  await second.context().close();
  await other.kill();
});

test("a plant that becomes very large asks before, and stops if it is told so", async () => {
  const doubling = "lsystem: 1\nderivation length: 30\naxiom: A\nA --> AA\nendlsystem\n";
  writeFileSync(join(place.folder, "doubling.l"), doubling);
  await openFromGallery("plants/doubling.l");
  await page.waitForSelector(".status[data-state=asks]");
  const question = page.getByRole("alert").filter({ hasText: "very large" });
  assert.match(await question.textContent(), /step 23 may have 8,388,608 modules\./);
  await shot(page, "asks");
  await question.getByRole("button", { name: "Stop here" }).click();
  await page.waitForSelector(".status[data-state=stopped]");
  assert.equal(await question.isVisible(), false);
  assert.match(await page.locator(".status .counts").textContent(), /^4,194,304 modules/);
});

test("a wrong key says so, and the right address is taken", async () => {
  const wrong = await openPage(browser, program.address.replace(/token=.*/, "token=00000000000000000000000000000000"));
  await wrong.waitForSelector(".banner:not([hidden])");
  assert.match(await wrong.locator(".banner").textContent(), /key.*espalier studio.*terminal/);
  assert.doesNotMatch(await wrong.locator(".banner").textContent(), /no connection/);
  await shot(wrong, "wrong-key");
  await wrong.getByRole("textbox", { name: "Address or key" }).fill(program.address);
  await wrong.getByRole("button", { name: "Open", exact: true }).click();
  await wrong.waitForSelector(".viewport[data-step]");
  await wrong.waitForSelector(".banner", { state: "hidden" });
  await wrong.context().close();
});

test("nothing went wrong on the page", () => assert.deepEqual(page.problems, []));
