/** Points of side editors are moved with the arrows, too. */

/** The step of an arrow to the right and down; null for another key. */
export function arrowStep(key: string, by: number): [number, number] | null {
  switch (key) {
    case "ArrowLeft":
      return [-by, 0];
    case "ArrowRight":
      return [by, 0];
    case "ArrowUp":
      return [0, -by];
    case "ArrowDown":
      return [0, by];
    default:
      return null;
  }
}
