#!/bin/sh
# Blender 3.4.1+dfsg-2 (Debian 12), bpy.ops.wm.obj_import: a line element of several vertices.
# Expected: `l 1 2 3 4` is a polyline of three edges (Wavefront's appendix B1: "l v1/vt1 v2/vt2 v3/vt3 ...").
# Seen: its first edge alone, without a word; three elements of two vertices keep all three edges.
# Prints what was seen; fails if that changes. Installs the package (as root) where it is missing.
set -eu
version=3.4.1+dfsg-2+b1
command -v blender >/dev/null || apt-get install -y --no-install-recommends "blender=$version" >/dev/null
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nl 1 2 3 4\n' >polyline.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nl 1 2\nl 2 3\nl 3 4\n' >pairs.obj
cat >read.py <<'END'
import bpy
for name in ("polyline", "pairs"):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=name + ".obj")
    print("edges of", name, len(bpy.context.selected_objects[0].data.edges))
print("version", bpy.app.version_string)
END
blender --background --python read.py 2>/dev/null | grep -E '^(edges|version)' | tee seen
grep -q '^edges of polyline 1$' seen && grep -q '^edges of pairs 3$' seen
