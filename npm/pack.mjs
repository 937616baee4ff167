// Puts the package together: node pack.mjs MODULE_FOLDER OUT
//
// MODULE_FOLDER has core.mjs and core.wasm, made by `cmake --build --preset web --target espalier_npm`. OUT becomes the
// package's folder, and OUT.tgz the file that npm installs.
import { execFileSync } from "node:child_process";
import { copyFileSync, cpSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { licencesOfModule } from "../studio/licences.mjs";

const npm = dirname(fileURLToPath(import.meta.url));
const repository = dirname(npm);
const [moduleFolder, out] = process.argv.slice(2).map((path) => resolve(path));
const given = ["environments/lone-tree.toml", "environments/two-trees.toml", "models/light/competing-tree.l", "models/plants.map"];

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
for (const name of ["index.js", "node.js", "api.js", "index.d.ts", "README.md"]) copyFileSync(join(npm, name), join(out, name));
for (const name of ["core.mjs", "core.wasm"]) copyFileSync(join(moduleFolder, name), join(out, name));
cpSync(join(npm, "examples"), join(out, "examples"), { recursive: true });
for (const name of given) cpSync(join(repository, name), join(out, "examples", name));
copyFileSync(join(repository, "LICENSE"), join(out, "LICENSE"));
writeFileSync(join(out, "LICENSES.txt"), `The module contains parts of these packages.\n${licencesOfModule()}`);
const version = /project\(espalier VERSION ([\d.]+)/.exec(readFileSync(join(repository, "CMakeLists.txt"), "utf8"))[1];
const description = JSON.parse(readFileSync(join(npm, "package.json"), "utf8"));
writeFileSync(join(out, "package.json"), `${JSON.stringify({ ...description, version }, null, 2)}\n`);
const [{ filename, size, unpackedSize }] = JSON.parse(
  execFileSync("npm", ["pack", "--json", "--pack-destination", dirname(out)], { cwd: out, encoding: "utf8" }),
);
renameSync(join(dirname(out), filename), `${out}.tgz`);
console.log(`${out}.tgz: ${(size / 1e6).toFixed(2)} MB, unpacked ${(unpackedSize / 1e6).toFixed(1)} MB`);
