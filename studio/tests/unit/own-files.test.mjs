// Saving where a browser offers its dialog, with a disk and a dialog of this test.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const file = (name, text) => [`/home/${name}`, new TextEncoder().encode(text)];

const { saveOwnFiles } = await load("web/own-files.ts");

/** Of one page, which remembers what it was given to write; tests have files of their own. */
function newDisk() {
  const disk = {};
  const downloads = [];
  const asked = [];
  const pick = async ({ suggestedName }) => {
    asked.push(suggestedName);
    return handleOf(disk, `chosen-${suggestedName}`);
  };
  return { disk, downloads, asked, pick, save: (files, picker = pick) => saveOwnFiles(files, picker, (name) => downloads.push(name)) };
}

function handleOf(disk, name) {
  return {
    createWritable: async () => {
      let text = "";
      return {
        write: async (bytes) => (text += new TextDecoder().decode(bytes)),
        close: async () => (disk[name] = text),
      };
    },
  };
}

test("the first save asks for a file, and later ones write it again", async () => {
  const page = newDisk();
  await page.save([file("a.l", "one")]);
  await page.save([file("a.l", "two"), ["/state/studio.json", new Uint8Array(1)], ["/home/gone.l", null]]);
  assert.deepEqual(page.asked, ["a.l"]);
  assert.deepEqual(page.disk, { "chosen-a.l": "two" });
  assert.deepEqual(page.downloads, []);
});

test("of several files the first is asked for, and the others are downloaded", async () => {
  const page = newDisk();
  await page.save([file("b.l", "model"), file("b.v", "view")]);
  assert.deepEqual([page.asked, page.downloads], [["b.l"], ["b.v"]]);
  // A file that is known needs no question, so another may be asked for.
  await page.save([file("b.l", "model 2"), file("b.v", "view 2")]);
  assert.deepEqual([page.asked, page.downloads], [["b.l", "b.v"], ["b.v"]]);
  assert.deepEqual(page.disk, { "chosen-b.l": "model 2", "chosen-b.v": "view 2" });
});

test("a browser without the dialog, or that refuses it, downloads; a dialog that is closed writes nothing", async () => {
  const page = newDisk();
  await page.save([file("c.l", "one")], null);
  assert.deepEqual(page.downloads, ["c.l"]);
  const fails = (name) => async () => {
    throw new DOMException("", name);
  };
  await page.save([file("c.l", "one")], fails("SecurityError"));
  assert.deepEqual(page.downloads, ["c.l", "c.l"]);
  await page.save([file("c.l", "one")], fails("AbortError"));
  assert.deepEqual([page.downloads.length, page.disk], [2, {}]);
});
