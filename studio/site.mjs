// Puts together the studio that needs no server: node site.mjs MODULE_FOLDER OUT LIVE PROGRAM
//
// OUT/index.html works from any web server below any path; OUT/espalier.html is the same in one file, which works from a disk;
// OUT/lessons.html lists the lessons, a page for each, which PROGRAM has read;
// LIVE is the one file with two trees instead of a library; `espalier share --live` puts another growth there. MODULE_FOLDER has
// espalier.js and espalier.wasm, made by `cmake --build --preset web`.
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { basename, dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { licencesOfModule } from "./licences.mjs";

const studio = dirname(fileURLToPath(import.meta.url));
const repository = dirname(studio);
const [moduleFolder, out, live, program] = process.argv.slice(2);
const limit = 2_000_000; // bytes of the page in all, as it is sent

function* filesBelow(folder) {
  for (const name of readdirSync(folder).sort()) {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) yield* filesBelow(path);
    else yield path;
  }
}

const gallery = join(repository, "docs/pictures/gallery");
/** A line of JSON with names and sizes, then the files; of files that lie beside the page the names alone. */
function packOf(files, beside = []) {
  const names = files.map((path) => [relative(repository, path), statSync(path).size]);
  const pictures = beside.map((path) => [relative(repository, path), 0]);
  return Buffer.concat([Buffer.from(`${JSON.stringify([...names, ...pictures])}\n`), ...files.map((path) => readFileSync(path))]);
}

const libraryFiles = ["models", "environments"].flatMap((name) => [...filesBelow(join(repository, name))]);
libraryFiles.push(join(repository, "docs/gallery.md"));
const firstGrowth = ["environments/two-trees.toml", "models/light/competing-tree.l", "models/plants.map"];

function policy(scripts) {
  return (
    `default-src 'none'; script-src ${scripts} 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; ` +
    "media-src blob:; connect-src 'self' blob:; worker-src blob:; base-uri 'none'; form-action 'none'"
  );
}

const ownScript = '<script src="studio.js" defer></script>\n';
/** The worker and the studio come while the page is read; the first script runs both. */
const loader =
  '<script src="loader.js" async></script>\n<link rel="preload" href="worker.js" as="fetch" crossorigin>\n' +
  '<link rel="preload" href="studio.js" as="script">\n';

function pageWith(head, body = "", data = {}) {
  const said = Object.entries(data).map(([name, value]) => `data-${name}="${value}" `);
  return readFileSync(join(studio, "dist/index.html"), "utf8")
    .replace("<html ", `<html data-parts="" ${said.join("")}`)
    .replace('<meta charset="utf-8">', `<meta charset="utf-8">\n${head}`)
    .replace(ownScript, "")
    .replace("<body>\n", () => `<body>\n${body}`);
}

function inScript(text) {
  return text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
}

/** A page for each text in lessons/, and one that lists them. */
function lessons(head) {
  const folder = join(repository, "lessons");
  const pages = [...filesBelow(folder)].filter((file) => file.endsWith(".md")).map((file) => {
    const { title, open, seed, steps, lesson } = JSON.parse(execFileSync(program, ["lesson", file, "--data"], { encoding: "utf8" }));
    const element = `<script type="application/json" id="lesson">${JSON.stringify(lesson).replaceAll("<", "\\u003c")}</script>\n`;
    const data = { open: `/library/${relative(repository, open)}`, ...(seed === undefined ? {} : { seed }), ...(steps ? { steps } : {}) };
    return { name: basename(file).replace(/[.]md$/, ".html"), title, page: pageWith(head, element, data) };
  });
  const entries = pages.map(({ name, title }) => `<li><a href="${name}">${title}</a></li>`);
  const list = readFileSync(join(studio, "lessons.html"), "utf8").replace("<ol></ol>", `<ol>\n${entries.join("\n")}\n</ol>`);
  return { "lessons.html": list, ...Object.fromEntries(pages.map(({ name, page }) => [name, page])) };
}

function licences() {
  const page = readFileSync(join(studio, "dist/LICENSES.txt"), "utf8");
  return `${page}\nThe module that grows plants contains parts of these packages.\n${licencesOfModule()}`;
}

/** Letters that need no escape in a page, which the page gets with each part. */
const letters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%()*+,-./:;=?@[]^_{|";

function to85(bytes) {
  const text = [];
  for (let from = 0; from < bytes.length; from += 4) {
    let number = 0;
    for (let i = 0; i < 4; i++) number = number * 256 + (bytes[from + i] ?? 0);
    let five = "";
    for (let i = 0; i < 5; i++, number = Math.floor(number / 85)) five = letters[number % 85] + five;
    text.push(five.slice(0, Math.min(4, bytes.length - from) + 1));
  }
  return text.join("");
}

function packedByXz(bytes) {
  const options = ["--format=xz", "--check=crc32", "--lzma2=preset=9e,lc=4,lp=0,pb=0", "--stdout"]; // bytes, not words
  return execFileSync("xz", options, { input: bytes, maxBuffer: 1 << 26 });
}

/** One file: scripts, styles and parts are elements of it. The worker begins before the other parts are read. */
function singleFile(parts, data = {}) {
  const text = (name) => readFileSync(join(studio, "dist", name), "utf8");
  const begins = [
    `<script type="text/plain" id="part-worker.js">${inScript(worker.toString())}</script>\n`,
    `<script>${inScript(text("loader.js"))}</script>\n`,
  ];
  const elements = Object.entries(parts).map(
    ([name, bytes]) => `<script type="application/base85" data-letters="${letters}" id="part-${name}">${to85(bytes)}</script>\n`,
  );
  const icon = `data:image/svg+xml;base64,${Buffer.from(text("icon.svg")).toString("base64")}`;
  return pageWith(`<meta http-equiv="Content-Security-Policy" content="${policy("'unsafe-inline'")}">`, [...begins, ...elements].join(""), data)
    .replace("icon.svg", icon)
    .replace('<link rel="stylesheet" href="studio.css">', () => `<style data-file="studio.css">${text("studio.css")}</style>`);
}

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const module = packedByXz(readFileSync(join(moduleFolder, "espalier.wasm")));
const worker = Buffer.concat([readFileSync(join(moduleFolder, "espalier.js")), readFileSync(join(studio, "dist/worker.js"))]);
const head = `<meta http-equiv="Content-Security-Policy" content="${policy("'self'")}">\n${loader}`;
const files = {
  "index.html": pageWith(head, "", { lessons: "lessons.html" }),
  "espalier.wasm.xz": module,
  "library.pack": packedByXz(packOf(libraryFiles, [...filesBelow(gallery)])),
  "worker.js": worker,
};
files["LICENSES.txt"] = licences();
for (const name of ["loader.js", "studio.js", "studio.css", "icon.svg"]) files[name] = readFileSync(join(studio, "dist", name));
for (const [name, bytes] of Object.entries({ ...files, ...lessons(head) })) writeFileSync(join(out, name), bytes);
for (const path of filesBelow(gallery)) {
  const place = join(out, relative(repository, path));
  mkdirSync(dirname(place), { recursive: true });
  copyFileSync(path, place);
}
const inside = {
  "espalier.wasm.xz": module,
  "studio.js": gzipSync(readFileSync(join(studio, "dist/studio.js")), { level: 9 }), // which browsers unpack beside the page's thread
  "LICENSES.txt": packedByXz(licences()),
};
writeFileSync(join(out, "espalier.html"), singleFile({ ...inside, "library.pack": packedByXz(packOf(libraryFiles)) }));
const ownGrowth = { ...inside, "library.pack": packedByXz(packOf(firstGrowth.map((name) => join(repository, name)))) };
writeFileSync(live, singleFile(ownGrowth, { open: `/library/${firstGrowth[0]}` }));

let total = 0;
for (const [name, bytes] of Object.entries(files)) {
  const size = /[.](xz|pack)$/.test(name) ? bytes.length : gzipSync(bytes, { level: 9 }).length;
  if (name !== "LICENSES.txt") total += size;
  console.log(`${name}: ${(size / 1000).toFixed(1)} kB compressed`);
}
console.log(`together ${(total / 1000).toFixed(1)} kB of ${limit / 1000} kB`);
if (total > limit) process.exit(1);
