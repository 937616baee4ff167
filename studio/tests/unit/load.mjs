// A module of the page's sources, compiled for node.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const source = join(dirname(fileURLToPath(import.meta.url)), "../../source");

export async function load(path) {
  const options = { bundle: true, write: false, format: "esm", platform: "browser", logLevel: "error" };
  const result = await build({ ...options, entryPoints: [join(source, path)] });
  return import(`data:text/javascript;base64,${Buffer.from(result.outputFiles[0].contents).toString("base64")}`);
}
