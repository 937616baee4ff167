#!/bin/sh
# three.js 0.187.0 (npm), USDLoader: a mesh with one displayColor for each face (interpolation = "uniform").
# Expected: every face has its colour.
# Seen: the whole mesh has the first one, without a warning; a GeomSubset and a material for each colour are shown.
# Prints what was seen; fails if that changes. Needs npm and node.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm init -y >/dev/null
npm install --silent --no-audit --no-fund three@0.187.0
cat >read.mjs <<'END'
import { USDLoader } from "three/addons/loaders/USDLoader.js";
const material = (name, colour) => `        def Material "${name}"
        {
            token outputs:surface.connect = </world/materials/${name}/s.outputs:surface>
            def Shader "s"
            {
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor = ${colour}
                token outputs:surface
            }
        }
`;
const subset = (name, face) => `        def GeomSubset "${name}"
        {
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            rel material:binding = </world/materials/${name}>
            int[] indices = [${face}]
        }
`;
const colours = (more) => {
  const text = `#usda 1.0
def Xform "world"
{
    def Mesh "m"
    {
        int[] faceVertexCounts = [3, 3]
        int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
${more}    }
    def Scope "materials"
    {
${material("red", "(1, 0, 0)")}${material("blue", "(0, 0, 1)")}    }
}
`;
  const seen = [];
  new USDLoader().parse(text).traverse((o) => {
    if (o.isMesh) for (const m of [o.material].flat()) seen.push(m.color.toArray().join(" "));
  });
  return seen.join(", ");
};
const primvar = '        color3f[] primvars:displayColor = [(1, 0, 0), (0, 0, 1)] (\n            interpolation = "uniform"\n        )\n';
const [uniform, subsets] = [colours(primvar), colours(subset("red", 0) + subset("blue", 1))];
console.log(`displayColor of each face: ${uniform}; GeomSubsets: ${subsets}`);
process.exit(uniform === "1 0 0" && subsets === "1 0 0, 0 0 1" ? 0 : 1);
END
node read.mjs
