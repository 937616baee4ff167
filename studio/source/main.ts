/** The studio: puts the page together. */
import { Changes } from "./changes.js";
import { ChartsPanel } from "./charts.js";
import { Comparison } from "./compare.js";
import { Editor } from "./editor/editor.js";
import { FitPanel } from "./fit.js";
import { Gallery } from "./gallery.js";
import { GraphPanel } from "./graph.js";
import { Header } from "./header.js";
import { takeKey } from "./key.js";
import { Layout, Tabs } from "./layout.js";
import { Messages } from "./messages.js";
import { PickPanel } from "./pick.js";
import { SettingsPanel } from "./settings.js";
import { lessonOfPage, LessonPanel, type Lesson } from "./lesson.js";
import { hasModel, openLink, openNamed } from "./links.js";
import { tellReadiness } from "./readiness.js";
import { Studio } from "./state.js";
import { StatusLine } from "./status.js";
import { Sweep } from "./sweep.js";
import { Timeline } from "./timeline.js";
import { Viewport } from "./viewport.js";

function useTheme(studio: Studio): void {
  const apply = () => (document.documentElement.dataset.theme = studio.theme);
  apply();
  studio.on("theme", apply);
}

function keysOfThePage(header: Header, timeline: Timeline, picked: PickPanel): void {
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    const command = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    if (command && key === "s") {
      event.preventDefault();
      void header.save();
      return;
    }
    if (target.closest(".cm-editor, textarea, input[type=text], input[type=number], input[type=search], select, dialog")) return;
    const actions: Record<string, () => void> = command
      ? { z: () => void header.step(event.shiftKey ? "redo" : "undo"), y: () => void header.step("redo") }
      : {
          p: () => timeline.toggle(),
          escape: () => void picked.pick(null),
          n: () => void picked.go(1),
          b: () => void picked.go(-1),
          ",": () => timeline.goTo(timeline.step - 1),
          ".": () => timeline.goTo(timeline.step + 1),
        };
    const action = actions[key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/** A link that was opened as the address of this page. */
async function openAddress(studio: Studio): Promise<boolean> {
  const fragment = location.hash;
  if (!hasModel(fragment)) return openNamed(studio, fragment);
  history.replaceState(null, "", location.pathname);
  return openLink(studio, fragment);
}

/** The lesson before the texts; where these are hidden, alone. */
function showLesson(lesson: Lesson, panel: LessonPanel, editor: Editor, layout: Layout): void {
  const first = { name: "Lesson", content: panel.element };
  const shown = new Tabs("Lesson and texts", [first, { name: "Texts", content: editor.element }], "lesson-tab");
  shown.offer("Texts", lesson.texts !== "hidden");
  shown.show("Lesson");
  layout.left.append(shown.element);
  layout.setOpen("left", true);
}

function start(): void {
  const lesson = lessonOfPage();
  const studio = new Studio(takeKey());
  useTheme(studio);
  tellReadiness(studio);
  const changes = new Changes(studio);
  const layout = new Layout();
  const timeline = new Timeline(studio);
  const editor = new Editor(studio, changes, lesson !== null && lesson.texts !== "free");
  const messages = new Messages(studio);
  const comparison = new Comparison(studio, () => viewport.scene);
  const viewport: Viewport = new Viewport(studio, timeline, comparison, (module) => void picked.pick(module));
  const picked: PickPanel = new PickPanel(
    studio,
    () => viewport.scene,
    editor,
    timeline,
    () => {
      viewport.hints.did("asked");
      tabs.show("Organ");
    },
    (words) => viewport.words.say(words),
  );
  timeline.started = () => viewport.hints.did("played");
  const charts = new ChartsPanel(studio, timeline, comparison, lesson?.charts);
  const sweep = new Sweep(studio, changes, () => viewport.scene);
  const settings = new SettingsPanel(studio, changes, null, (setting) => sweep.open(setting));
  const gallery = new Gallery(studio, () => studio.frames.look("last"));
  const graph: GraphPanel = new GraphPanel(studio, changes, editor, (offered) => tabs.offer("Graph", offered));
  const tabs = new Tabs(
    "Measures",
    [
      { name: "Settings", content: settings.element },
      { name: "Graph", content: graph.element },
      { name: "Organ", content: picked.element },
      { name: "Charts", content: charts.element },
      { name: "Fit", content: new FitPanel(studio, changes).element },
    ],
    "right-tab",
  );
  tabs.offer("Graph", false);
  tabs.offer("Fit", false);
  const title = lesson?.title ?? "";
  const header = new Header({ studio, changes, editor, layout, scene: viewport.scene, gallery: () => void gallery.show(), title });
  header.shared = () => viewport.hints.did("shared");
  if (lesson) {
    showLesson(lesson, new LessonPanel(studio, changes, lesson), editor, layout);
    tabs.offer("Settings", lesson.texts === "free");
    tabs.show("Charts");
  } else layout.left.append(editor.element);
  layout.right.append(tabs.element);
  layout.centre.append(viewport.element);
  document.body.append(
    header.element,
    messages.banner,
    layout.element,
    timeline.element,
    new StatusLine(studio, viewport.scene).element,
    messages.element,
    gallery.element,
  );
  keysOfThePage(header, timeline, picked);
  gallery.behind = [layout.element, timeline.element];
  let first = true;
  studio.on("connection", (state) => {
    if (state !== "open" || !first) return;
    first = false;
    tabs.offer("Fit", studio.fits && lesson === null);
    void openAddress(studio).then((opened) => {
      if (!opened && !studio.opened) void gallery.show();
    });
  });
  // Another address in the same tab.
  window.addEventListener("hashchange", () => {
    if (studio.connection.state === "open") void openAddress(studio).then((opened) => opened && gallery.hide());
    else studio.connection.connectWith(takeKey());
  });
  studio.connection.connect();
}

start();
