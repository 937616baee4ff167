/** Open L-systems: plants that grow by rules and exchange light, water and space with their environment. Metres; y is up. */

/** A mistake in a model or a scene, or a growth that cannot go on. */
export class EspalierError extends Error {
  readonly problems: Problem[];
}

export interface Problem {
  message: string;
  /** Where; "" and 0 if that is not known. */
  file: string;
  line: number;
  column: number;
  /** The line of the text. */
  source: string;
}

/** A string of modules: symbols with parameters. */
export class ModuleString {
  /** Symbols by their numbers. */
  readonly names: string[];
  /** The number of each module's symbol. */
  readonly letters: Uint16Array;
  /** Where each module's parameters begin, and where the last one's end. */
  readonly offsets: Uint32Array;
  readonly parameters: Float64Array;
  readonly length: number;
  symbol(index: number): string;
  parametersOf(index: number): Float64Array;
  /** In cpfg's notation: `F(1)[+(30)A]`. */
  toString(): string;
}

/** The text of an L-system in the language of cpfg. */
export class Model {
  /** `defines` replace `#define`s. */
  constructor(text: string, defines?: Record<string, number | string>);
  readonly text: string;
  readonly defines: Record<string, number | string>;
  /** Without an environment. `steps`: otherwise as the model says. Throws EspalierError. */
  derive(options?: { steps?: number; seed?: number }): ModuleString;
}

export interface WorldOptions {
  /** The file that is opened; otherwise the first that ends with `.toml`, or the first. */
  open?: string;
  seed?: number;
  steps?: number;
  /** Of a scene: values by their keys, `{ "environment.light.strength": 0.4 }`; of a model: its `#define`s. */
  set?: Record<string, number | string>;
  /** Most bytes of plants and fields; otherwise 1 GiB. */
  memory?: number;
}

export interface Mesh {
  /** x, y, z of each vertex. */
  positions: Float32Array;
  normals: Float32Array;
  uvs: Float32Array;
  /** Red, green and blue of each vertex, sRGB. */
  colors: Uint8Array;
  /** Three vertices for each triangle. */
  indices: Uint32Array;
  /** Axes and organs: `count` indices from `start` on. */
  parts: { symbol: string; plant: number; identity: string; start: number; count: number }[];
}

export interface FieldValues {
  /** x runs fastest, then y, then z. */
  values: Float32Array;
  /** Numbers of voxels. */
  size: [number, number, number];
  /** The lower corner. */
  origin: [number, number, number];
  voxel: [number, number, number];
  /** "1" for a pure number. */
  unit: string;
}

/** Plants and their environment; it begins at step 0. */
export class World {
  /** A model alone, or the files of a scene by their paths: what the scene names lies among them. Throws EspalierError. */
  constructor(grows: Model | Record<string, string | Uint8Array>, options?: WorldOptions);
  readonly step: number;
  readonly lastStep: number;
  /** No step follows. */
  readonly ended: boolean;
  /** Of all plants. */
  readonly modules: number;
  /** Names of the plants. */
  readonly plants: string[];
  readonly fields: { name: string; unit: string; meaning: string }[];
  readonly warnings: Problem[];
  /** What models have printed. */
  readonly printed: string;
  /** The row of each plant at this step: height, internodes, length and what processes tell. */
  readonly statistics: ({ plant: string } & Record<string, number | string | null>)[];
  /** One step, or so many, but not beyond the last. Throws EspalierError. */
  grow(steps?: number): this;
  string(plant?: number): ModuleString;
  /** Axes as tubes with `sides` corners, and organs; at most so many triangles. */
  mesh(options?: { plant?: number; triangles?: number; sides?: number }): Mesh;
  /** Throws EspalierError if there is none of this name. */
  field(name: string): FieldValues;
  /** Gives its memory back now; otherwise that happens when nobody holds it any more. */
  free(): void;
}
