#!/bin/sh
# Blender 3.4.1+dfsg-2 (Debian 12), Cycles: where a volume from an OpenVDB file is drawn.
# Expected: a voxel's value stands at indexToWorld of its index (OpenVDB), so that ten voxels 0..9 of size 1 are centred at 4.5.
# Seen: they are centred at 5: the whole volume is drawn half a voxel too far, on every axis.
# Prints what was seen; fails if that changes. Installs the packages (as root) where they are missing.
set -eu
command -v blender >/dev/null || apt-get install -y --no-install-recommends blender=3.4.1+dfsg-2+b1 >/dev/null
/usr/bin/python3 -c 'import pyopenvdb' 2>/dev/null || apt-get install -y --no-install-recommends python3-openvdb=10.0.1-2 >/dev/null
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
/usr/bin/python3 - <<'END'
import pyopenvdb
grid = pyopenvdb.FloatGrid()
grid.name = "density"
grid.transform = pyopenvdb.createLinearTransform(1.0)
grid.fill((0, 0, 0), (9, 9, 9), 1.0)
pyopenvdb.write("cube.vdb", [grid])
END
cat >draw.py <<'END'
import bpy, os
import numpy

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
here = os.getcwd() + "/"
bpy.ops.object.volume_import(filepath=here + "cube.vdb", directory=here, files=[{"name": "cube.vdb"}])
material = bpy.data.materials.new("m")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
density = nodes.new("ShaderNodeAttribute")
density.attribute_name = "density"
glow, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
links.new(density.outputs["Fac"], glow.inputs["Strength"])
links.new(glow.outputs[0], output.inputs["Volume"])
bpy.context.object.data.materials.append(material)
camera = bpy.data.objects.new("c", bpy.data.cameras.new("c"))
camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 20, (4.5, 4.5, 50)
scene.collection.objects.link(camera)
scene.camera = camera
scene.world = bpy.data.worlds.new("w")
scene.world.color = (0, 0, 0)
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 4, False
scene.render.resolution_x = scene.render.resolution_y = 200
scene.view_settings.view_transform = "Standard"
scene.render.filepath = here + "seen.png"
bpy.ops.render.render(write_still=True)
pixels = numpy.array(bpy.data.images.load(here + "seen.png").pixels[:]).reshape(200, 200, 4)[:, :, 0]
rows, columns = numpy.where(pixels > pixels.max() / 2)
for axis, places in (("x", columns), ("y", rows)):
    print("centre %s %.1f" % (axis, (places.min() + places.max() + 1) / 2 / 10 - 10 + 4.5))
print("version", bpy.app.version_string)
END
blender --background --python draw.py 2>/dev/null | grep -E '^(centre|version)' | tee seen
grep -q '^centre x 5.0$' seen && grep -q '^centre y 5.0$' seen
