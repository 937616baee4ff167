// Imported when it is asked for: a message that comes while a module still loads would find nobody.
self.onmessage = async ({ data: { files, options } }) => {
  const { World } = await import("../index.js");
  const world = new World(files, options);
  while (!world.ended) {
    world.grow();
    const { positions, normals, colors, indices } = world.mesh({ triangles: 20_000 });
    const arrays = { positions, normals, colors, indices };
    const step = { step: world.step, last: world.lastStep, statistics: world.statistics, mesh: arrays };
    self.postMessage(step, Object.values(arrays).map(({ buffer }) => buffer));
  }
};
