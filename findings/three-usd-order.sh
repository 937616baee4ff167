#!/bin/sh
# three.js 0.187.0 (npm), USDLoader: an attribute of a text USD file that has a default value and time samples.
# Expected: the order of the two in the file means nothing; a reader without time shows the default (UsdTimeCode::Default).
# Seen: samples that stand behind the default replace it, and what is shown is the sample at time 0.
# Prints what was seen; fails if that changes. Needs npm and node.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm init -y >/dev/null
npm install --silent --no-audit --no-fund three@0.187.0
cat >read.mjs <<'END'
import { USDLoader } from "three/addons/loaders/USDLoader.js";
const value = "        color3f[] primvars:displayColor = [(0, 1, 0)]\n";
const samples = "        color3f[] primvars:displayColor.timeSamples = {\n            0: [(1, 0, 0)],\n            4: [(0, 1, 0)],\n        }\n";
const shown = (colour) => {
  const text = `#usda 1.0
def Xform "world"
{
    def Mesh "m"
    {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
${colour}    }
}
`;
  let rgb;
  new USDLoader().parse(text).traverse((o) => { if (o.isMesh) rgb = o.material.color.toArray().join(" "); });
  return rgb;
};
const [behind, before] = [shown(samples + value), shown(value + samples)];
console.log(`default behind the samples: ${behind}; before them: ${before}`);
process.exit(behind === "0 1 0" && before === "1 0 0" ? 0 : 1);
END
node read.mjs
