// Settings in the groups of their headings, and as the author of a document lays them out.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { asLaidOut, byHeading, panelText } = await load("panels.ts");
const { span } = await load("settings.ts");

const setting = (name, more = {}) => ({
  name,
  label: name.toLowerCase(),
  kind: "number",
  value: 2,
  text: "2",
  default: "2",
  lowest: 0,
  highest: 10,
  whole: false,
  unit: "m",
  group: "",
  changed: false,
  ...more,
});
const slider = (name, more = {}) => ({ name, label: null, unit: null, lowest: null, highest: null, step: null, ...more });
const settings = [setting("A", { group: "One" }), setting("B", { group: "Two" }), setting("C", { group: "One" })];

test("without panels settings stand under their headings", () => {
  assert.deepEqual(byHeading(settings).map(({ title, settings: inside }) => [title, inside.map(({ name }) => name)]), [["One", ["A", "C"]], ["Two", ["B"]]]);
});

test("a panel has its order, and what it says of a slider replaces what the setting says", () => {
  const sliders = [slider("C", { label: "Width", unit: "", lowest: 1, highest: 3, step: 0.5 }), slider("GONE"), slider("A")];
  const [panel] = asLaidOut({ panels: [{ title: "Crown", columns: 2, open: false, sliders }], settings });
  assert.deepEqual([panel.title, panel.columns, panel.open], ["Crown", 2, false]);
  assert.deepEqual(panel.settings.map(({ name, label, unit, lowest, highest }) => [name, label, unit, lowest, highest]), [["C", "Width", "", 1, 3], ["A", "a", "m", 0, 10]]);
  assert.deepEqual(panel.settings.map(span), [
    { lowest: 1, highest: 3, step: 0.5 },
    { lowest: 0, highest: 10, step: 0.01 },
  ]);
});

test("the text of panels names all settings with their ends", () => {
  const open = setting("D", { lowest: null, highest: null, label: 'the "D"' });
  assert.equal(
    panelText([settings[0], open]),
    '[[panel]]\ntitle = "One"\nsettings = [\n  { name = "A", label = "a", lowest = 0, highest = 10 },\n]\n\n' +
      '[[panel]]\ntitle = "Settings"\nsettings = [\n  { name = "D", label = "the \\"D\\"" },\n]\n',
  );
});
