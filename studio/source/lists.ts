/** The element of a list at an index that the caller knows to be in it. */
export function at<Element>(list: ArrayLike<Element>, index: number): Element {
  const element = list[index];
  if (element === undefined) throw new RangeError(`A list of ${list.length} elements has none with the index ${index}.`);
  return element;
}

/** Adds to a number of a list, and returns what it was before. */
export function increase(numbers: Uint32Array, index: number, by: number): number {
  const before = at(numbers, index);
  numbers[index] = before + by;
  return before;
}
