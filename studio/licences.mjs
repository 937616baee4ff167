// What the module that grows plants has in it: texts of Debian.
import { readFileSync } from "node:fs";

const packages = ["emscripten", "libfmt-dev", "libtomlplusplus-dev", "libglm-dev", "libeigen3-dev", "nlohmann-json3-dev"];

export function licencesOfModule() {
  return packages
    .map((name) => `${"-".repeat(80)}\n${name}\n\n${readFileSync(`/usr/share/doc/${name}/copyright`, "utf8")}`)
    .join("\n");
}
