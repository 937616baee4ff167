/** Espalier in a page or a worker: the module lies beside this file. */
import { start } from "./api.js";

const response = await fetch(new URL("./core.wasm", import.meta.url));
if (!response.ok) throw new Error(`core.wasm could not be loaded (${response.status})`);
await start(await response.arrayBuffer());

export { EspalierError, Model, ModuleString, World } from "./api.js";
