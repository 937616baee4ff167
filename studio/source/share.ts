/** Shares a growth as one HTML file that needs no server, and a model as a link. */
import { openDialog } from "./dialog.js";
import { download, h, whole } from "./elements.js";
import { compress, toBase64, urlSafe } from "./view/index.js";
import type { SharedModel } from "./protocol.js";
import { errorText, type Studio } from "./state.js";
import type { PlantScene, Recording, SkyLook } from "./view/index.js";

const marker = "/*--- studio ---*/";
const longestLink = 8000;

/** A file of the page, or, where the page is one file, the element that stands for it. */
async function textOf(address: string): Promise<string> {
  const inside = document.querySelector(`[data-file="${address}"]`)?.textContent;
  if (inside) return inside;
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${address} could not be read.`);
  return response.text();
}

/** Text that may stand inside a script element. */
function inScript(text: string): string {
  return text.replaceAll("</", "<\\/").replaceAll("<!--", "<\\!--");
}

function escaped(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
}

async function bytesOf(blob: Promise<Blob> | null): Promise<string> {
  return blob ? toBase64(new Uint8Array(await (await blob).arrayBuffer())) : "";
}

async function recordingOf(
  studio: Studio,
  scene: PlantScene,
  steps: number[],
  progress: (part: number) => void,
): Promise<Recording> {
  const packets: string[] = [];
  const skies: SkyLook[] = [];
  for (const [index, step] of steps.entries()) {
    const packet = await studio.frames.fetch(step);
    packets.push(toBase64(await compress(packet.message)));
    const sky = studio.skyOf(packet);
    if (sky) skies.push(sky);
    progress((index + 1) / steps.length);
  }
  const shapes = await Promise.all(studio.shapeMessages.map(async (message) => toBase64(await compress(message))));
  const images = await Promise.all(studio.pictures.map(({ colours }) => bytesOf(colours)));
  const reliefs = await Promise.all(studio.pictures.map(({ normals }) => bytesOf(normals)));
  const shown = studio.limbs;
  const limbs = shown && steps.includes(shown.step) ? [toBase64(await compress(shown.message))] : [];
  return {
    title: studio.document?.name ?? "Plant",
    theme: studio.theme,
    steps,
    packets,
    shapes,
    images,
    reliefs,
    limbs,
    camera: scene.orbit.state,
    light: scene.shownLight,
    skies: scene.shownSky ? skies : [],
  };
}

async function htmlOf(recording: Recording): Promise<string> {
  const [script, style] = await Promise.all([textOf("studio.js"), textOf("studio.css")]);
  const viewer = script.slice(0, script.indexOf(marker));
  const policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:";
  return `<!doctype html>
<html lang="en" data-theme="${recording.theme}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>${escaped(recording.title)}</title>
<style>${style}</style>
</head>
<body class="recording">
<script type="application/json" id="recording">${inScript(JSON.stringify(recording)).replaceAll("<\\!--", "\\u003c!--").replaceAll("<\\/", "\\u003c/")}</script>
<script>${inScript(viewer)}
EspalierView.playRecording();</script>
</body>
</html>
`;
}

/** At most `count` steps, evenly spaced, the last among them. */
function chosenSteps(last: number, count: number): number[] {
  const steps = new Set<number>();
  for (let i = 0; i < count; i++) steps.add(Math.round((last * (i + 1)) / count));
  if (count > last) steps.add(0);
  return [...steps].sort((a, b) => a - b);
}

export function shareHtmlDialog(studio: Studio, scene: PlantScene): void {
  const last = studio.frames.lastStep;
  const count = h("input", "number", {
    type: "number",
    min: 1,
    max: last + 1,
    value: Math.min(last + 1, 120),
    id: "share-count",
  });
  const state = h("p", "hint", { role: "status" });
  const start = h("button", "button primary", { type: "submit" }, "Write the file");
  const form = h(
    "form",
    "form",
    {
      onsubmit: (event) => {
        event.preventDefault();
        void run();
      },
    },
    h("p", "", {}, "One HTML file that shows the growth in every browser, without Espalier: it can be turned and played."),
    h("label", "", { for: "share-count" }, `Steps to take, of ${last + 1}`),
    count,
    h("div", "form-end", {}, state, start),
  );
  const dialog = openDialog("Share as HTML", form);

  async function run(): Promise<void> {
    start.disabled = true;
    try {
      const steps = chosenSteps(last, Math.max(1, Number(count.value)));
      const recording = await recordingOf(
        studio,
        scene,
        steps,
        (part) => (state.textContent = `${Math.round(part * 100)} % of the steps`),
      );
      const blob = new Blob([await htmlOf(recording)], { type: "text/html" });
      download(blob, `${recording.title}.html`);
      dialog.close();
      studio.tell("note", `${recording.title}.html holds ${whole(steps.length)} steps in ${(blob.size / 1e6).toFixed(1)} MB.`);
    } catch (error) {
      state.textContent = errorText(error);
    }
    start.disabled = false;
  }
}

/** The present document with its settings. */
async function sharedModel(studio: Studio): Promise<SharedModel> {
  const { main, files, seed, steps } = await studio.connection.request("share", {});
  return { main, files, seed, steps };
}

/** Without the address of a studio: whoever opens it runs one of their own, at another port. */
async function linkOf(model: SharedModel): Promise<string> {
  return `espalier:model=${urlSafe(toBase64(await compress(new TextEncoder().encode(JSON.stringify(model)))))}`;
}

/** Which texts leave this machine with the link. */
function whatItTakesAlong(model: SharedModel): HTMLElement {
  const own = model.files.filter(({ content }) => content !== undefined);
  return h(
    "div",
    "",
    {},
    h("p", "", {}, own.length > 0 ? "It takes along the texts of these files:" : "It takes along no text: all its files come with Espalier."),
    h("ul", "shared-files", {}, ...own.map(({ path }) => h("li", "", {}, h("code", "", {}, path)))),
  );
}

export async function shareLinkDialog(studio: Studio): Promise<void> {
  try {
    const model = await sharedModel(studio);
    const link = await linkOf(model);
    if (link.length > longestLink)
      throw new Error(
        `This is too long for a link: ${whole(link.length)} characters of ${whole(longestLink)}. Save the files and send them, or share the growth as HTML.`,
      );
    const field = h("textarea", "wide", { readonly: true, rows: 8, "aria-label": "Link" });
    field.value = `${model.main}, for Espalier ${studio.version}. To open it, start "espalier studio" and paste this whole text into the search field of its gallery:\n${link}`;
    const copy = h(
      "button",
      "button primary",
      {
        type: "button",
        onclick: () => {
          field.select();
          void navigator.clipboard.writeText(field.value).then(() => (copy.textContent = "Copied"));
        },
      },
      "Copy",
    );
    openDialog(
      "Share as a link",
      h(
        "p",
        "",
        {},
        "The link holds the texts that did not come with Espalier, the seed and the steps. The text around it says how to open it: in a studio of the same version, by pasting it into the search field of the gallery.",
      ),
      whatItTakesAlong(model),
      field,
      h("div", "form-end", {}, copy),
    );
  } catch (error) {
    studio.tell("error", errorText(error));
  }
}
