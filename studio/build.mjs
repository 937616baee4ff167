// Bundles the page into dist/. `node build.mjs --check` fails if dist/ differs from what the sources give.
//
// studio.js holds two scripts: the viewer (three.js, packets, camera), which a shared HTML file contains too, and the studio
// itself, which finds the viewer as the global EspalierView. A marker line parts them.
import { build } from "esbuild";
import { mkdirSync, readFileSync, readdirSync, existsSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = dirname(fileURLToPath(import.meta.url));
const source = join(root, "source");
const limit = 500_000; // bytes, compressed

const common = {
  bundle: true,
  minify: true,
  write: false,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  metafile: true,
  absWorkingDir: root,
};

/** The viewer is one module for the studio: source/view/index.ts. */
const viewerIsGlobal = {
  name: "viewer-is-global",
  setup(bundler) {
    const viewer = join(source, "view");
    bundler.onResolve({ filter: /\/view\// }, (found) => {
      const file = resolve(found.resolveDir, found.path).replace(/\.js$/, ".ts");
      if (!file.startsWith(viewer)) return undefined;
      if (file !== join(viewer, "index.ts")) return { errors: [{ text: `import view/index.js, not ${found.path}` }] };
      return { path: "view", namespace: "viewer" };
    });
    bundler.onLoad({ filter: /.*/, namespace: "viewer" }, () => ({ contents: "module.exports = EspalierView;", loader: "js" }));
  },
};

function textOf(result) {
  return result.outputFiles[0].text;
}

function packagesOf(result) {
  const names = new Set();
  for (const input of Object.keys(result.metafile.inputs)) {
    const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (match) names.add(match[1]);
  }
  return names;
}

function licences(names) {
  const parts = ["The page of the studio contains these packages.\n"];
  for (const name of [...names].sort()) {
    const folder = join(root, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    parts.push(`${"-".repeat(80)}\n${name} ${version} (${license})\n`);
    if (file) parts.push(`${readFileSync(join(folder, file), "utf8").trimEnd()}\n`);
  }
  return parts.join("\n");
}

async function bundle() {
  const viewer = await build({ ...common, entryPoints: [join(source, "view/index.ts")], globalName: "EspalierView" });
  const page = await build({ ...common, entryPoints: [join(source, "main.ts")], plugins: [viewerIsGlobal] });
  const worker = await build({ ...common, entryPoints: [join(source, "web/worker.ts")] });
  const loader = await build({ ...common, entryPoints: [join(source, "web/loader.ts")] });
  const style = await build({ ...common, entryPoints: [join(source, "studio.css")] });
  const names = new Set([...packagesOf(viewer), ...packagesOf(page), ...packagesOf(style)]);
  return {
    "index.html": readFileSync(join(source, "index.html"), "utf8"),
    "icon.svg": readFileSync(join(source, "icon.svg"), "utf8"),
    "studio.js": `${textOf(viewer)}/*--- studio ---*/\n${textOf(page)}`,
    "studio.css": textOf(style),
    "worker.js": textOf(worker),
    "loader.js": textOf(loader),
    "LICENSES.txt": licences(names),
  };
}

const files = await bundle();
const dist = join(root, "dist");
mkdirSync(dist, { recursive: true });
let total = 0;
let differs = false;
for (const [name, text] of Object.entries(files)) {
  const size = gzipSync(text, { level: 9 }).length;
  if (name !== "LICENSES.txt") total += size;
  const path = join(dist, name);
  if (process.argv.includes("--check")) {
    const same = existsSync(path) && readFileSync(path, "utf8") === text;
    if (!same) console.error(`${path} differs from what the sources give: run npm run build in studio/`);
    differs ||= !same;
  } else {
    writeFileSync(path, text);
  }
  console.log(`${name}: ${(size / 1000).toFixed(1)} kB compressed`);
}
console.log(`together ${(total / 1000).toFixed(1)} kB of ${limit / 1000} kB`);
if (total > limit || differs) process.exit(1);
