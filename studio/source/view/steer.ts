/** Steers the camera with pointer, wheel, touch and keys. */
import type { PlantScene } from "./scene3d.js";

export interface Steering {
  /** A click or tap that was not a drag. */
  clicked?: (x: number, y: number) => void;
}

const turnPerPixel = 0.008;
const steady = 4; // pixels that a click may move

class Pointers {
  private readonly down = new Map<number, { x: number; y: number }>();
  private travelled = 0;

  constructor(
    private readonly scene: PlantScene,
    private readonly steering: Steering,
  ) {}

  press(event: PointerEvent): void {
    this.scene.canvas.setPointerCapture(event.pointerId);
    if (this.down.size === 0) this.travelled = 0;
    this.down.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  }

  move(event: PointerEvent): void {
    const before = this.down.get(event.pointerId);
    if (!before) return;
    const now = { x: event.offsetX, y: event.offsetY };
    this.travelled += Math.hypot(now.x - before.x, now.y - before.y);
    if (this.travelled > steady) this.scene.keepView();
    if (this.down.size === 2) this.pinch(event.pointerId, before, now);
    else if (this.travelled > steady) this.drag(event, now.x - before.x, now.y - before.y);
    this.down.set(event.pointerId, now);
  }

  release(event: PointerEvent): void {
    const single = this.down.size === 1;
    if (this.down.delete(event.pointerId) && single && this.travelled <= steady && event.type === "pointerup")
      this.steering.clicked?.(event.offsetX, event.offsetY);
  }

  private drag(event: PointerEvent, dx: number, dy: number): void {
    const pans = (event.buttons & 6) !== 0 || event.shiftKey || event.ctrlKey || event.metaKey;
    const height = this.scene.canvas.clientHeight;
    if (pans) this.scene.orbit.pan(-dx / height, dy / height);
    else this.scene.orbit.turn(dx * turnPerPixel, dy * turnPerPixel);
  }

  private pinch(id: number, before: { x: number; y: number }, now: { x: number; y: number }): void {
    const other = [...this.down.entries()].find(([key]) => key !== id)?.[1];
    if (!other) return;
    const apart = (point: { x: number; y: number }) => Math.max(1, Math.hypot(point.x - other.x, point.y - other.y));
    this.scene.orbit.zoom(apart(before) / apart(now));
    const height = this.scene.canvas.clientHeight;
    this.scene.orbit.pan((before.x - now.x) / 2 / height, (now.y - before.y) / 2 / height);
  }
}

/** What the keys do, by `event.key`. */
function keyActions(scene: PlantScene): Record<string, () => void> {
  const { orbit } = scene;
  return {
    ArrowLeft: () => orbit.turn(-0.12, 0),
    ArrowRight: () => orbit.turn(0.12, 0),
    ArrowUp: () => orbit.turn(0, 0.08),
    ArrowDown: () => orbit.turn(0, -0.08),
    "+": () => orbit.zoom(0.85),
    "=": () => orbit.zoom(0.85),
    "-": () => orbit.zoom(1 / 0.85),
    " ": () => orbit.raise(0.04),
    Shift: () => orbit.raise(-0.04),
    f: () => scene.fit(),
    F: () => scene.fit(),
    Home: () => scene.home(),
  };
}

export function steer(scene: PlantScene, steering: Steering = {}): void {
  const { canvas } = scene;
  const pointers = new Pointers(scene, steering);
  canvas.tabIndex = 0;
  canvas.style.touchAction = "none";
  canvas.addEventListener("pointerdown", (event) => pointers.press(event));
  canvas.addEventListener("pointermove", (event) => pointers.move(event));
  canvas.addEventListener("pointerup", (event) => pointers.release(event));
  canvas.addEventListener("pointercancel", (event) => pointers.release(event));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", () => scene.fit());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      scene.keepView();
      scene.orbit.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.003));
    },
    { passive: false },
  );
  const actions = keyActions(scene);
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    scene.keepView();
    action();
  });
}
