/** A camera that turns around a target. The world's y axis points up. */
import { PerspectiveCamera, Vector3 } from "three";
import type { Vector } from "./vectors.js";

export interface CameraState {
  target: Vector;
  distance: number;
  /** Radians about the y axis, and above the horizon. */
  azimuth: number;
  elevation: number;
}

const upmost = Math.PI / 2 - 0.01;

export class OrbitCamera {
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  private target = new Vector3(0, 1, 0);
  private distance = 5;
  private azimuth = 0.5;
  private elevation = 0.16;
  private radius = 1;

  /** `changed` is called after every move. */
  constructor(private readonly changed: () => void) {
    this.update();
  }

  get state(): CameraState {
    const { x, y, z } = this.target;
    return { target: [x, y, z], distance: this.distance, azimuth: this.azimuth, elevation: this.elevation };
  }

  set state(state: CameraState) {
    this.target.set(...state.target);
    this.distance = state.distance;
    this.azimuth = state.azimuth;
    this.elevation = state.elevation;
    this.update();
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.update();
  }

  /** Shows a whole box from the present direction. */
  fit(lower: Vector, upper: Vector): void {
    const size = new Vector3(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
    this.radius = Math.max(size.length() / 2, 1e-4);
    this.target.set((lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, (lower[2] + upper[2]) / 2);
    const half = (this.camera.fov * Math.PI) / 360;
    const wide = Math.max(size.x, size.z) / 2;
    const high = size.y / 2 + 0.3 * wide * Math.sin(Math.abs(this.elevation));
    const across = wide / (Math.tan(half) * this.camera.aspect);
    this.distance = 1.18 * Math.max(high / Math.tan(half), across) + wide * 0.6;
    this.update();
  }

  /** From a direction; without one from the side, or from the front, if all lies in the plane x y. */
  home(lower: Vector, upper: Vector, flat: boolean, towardsEye: Vector | null = null): void {
    this.azimuth = flat ? 0 : 0.5;
    this.elevation = flat ? 0 : 0.16;
    if (towardsEye) {
      const [x, y, z] = towardsEye;
      this.azimuth = Math.atan2(x, z);
      this.elevation = Math.min(upmost, Math.max(-upmost, Math.atan2(y, Math.hypot(x, z))));
    }
    this.fit(lower, upper);
  }

  turn(horizontal: number, vertical: number): void {
    this.azimuth -= horizontal;
    this.elevation = Math.min(upmost, Math.max(-upmost, this.elevation + vertical));
    this.update();
  }

  zoom(factor: number): void {
    this.distance = Math.min(this.radius * 200, Math.max(this.radius * 0.002, this.distance * factor));
    this.update();
  }

  /** Moves across the picture, in parts of its height. */
  pan(right: number, up: number): void {
    const height = 2 * this.distance * Math.tan((this.camera.fov * Math.PI) / 360);
    const axis = new Vector3();
    axis.setFromMatrixColumn(this.camera.matrixWorld, 0);
    this.target.addScaledVector(axis, right * height);
    axis.setFromMatrixColumn(this.camera.matrixWorld, 1);
    this.target.addScaledVector(axis, up * height);
    this.update();
  }

  raise(part: number): void {
    this.target.y += part * this.distance;
    this.update();
  }

  private update(): void {
    const level = Math.cos(this.elevation) * this.distance;
    this.camera.position.set(
      this.target.x + level * Math.sin(this.azimuth),
      this.target.y + this.distance * Math.sin(this.elevation),
      this.target.z + level * Math.cos(this.azimuth),
    );
    this.camera.near = Math.max(this.distance * 0.002, (this.distance - this.radius * 8) * 0.5);
    this.camera.far = this.distance + this.radius * 30;
    this.camera.lookAt(this.target);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.changed();
  }
}
