/** What the studio and a shared HTML file use of the viewer. */
export { OrbitCamera, type CameraState } from "./camera.js";
export { mapGradient, mapColour, themes, type Theme } from "./colours.js";
export { niceLength } from "./ground.js";
export type { FieldLook } from "./fields.js";
export * from "./packets.js";
export * from "./vectors.js";
export type { PictureSource } from "./pictures.js";
export type { AuthorLook, SkyLook } from "./light.js";
export type { MeasuredShape } from "./measured.js";
export { PlantScene } from "./scene3d.js";
export { steer } from "./steer.js";
export { compress, decompress, fromBase64, fromLetters, streamOfBytes, toBase64, ungzipped, unpacked, urlSafe } from "./compression.js";
export { playRecording, type Recording } from "./recording.js";
