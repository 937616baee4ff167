/** Espalier in node. */
import { readFile } from "node:fs/promises";
import { start } from "./api.js";

await start(await readFile(new URL("./core.wasm", import.meta.url)));

export { EspalierError, Model, ModuleString, World } from "./api.js";
