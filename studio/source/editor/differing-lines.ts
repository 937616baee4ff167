/** The lines in which two texts differ. */
import { at } from "../lists.js";

export interface DifferingLine {
  /** Of which text it is. */
  of: "disk" | "mine";
  /** From 1 on. */
  number: number;
  text: string;
}

const mostCompared = 4e6; // pairs of lines; of larger texts all lines between the first and the last difference differ

/** In the order of the texts; where they differ, lines of the disk stand first. */
export function differingLines(disk: string, mine: string): DifferingLine[] {
  const [a, b] = [disk.split("\n"), mine.split("\n")];
  let begin = 0;
  while (begin < a.length && begin < b.length && a[begin] === b[begin]) begin++;
  let [endA, endB] = [a.length, b.length];
  while (endA > begin && endB > begin && a[endA - 1] === b[endB - 1]) {
    endA--;
    endB--;
  }
  const [rows, columns] = [endA - begin, endB - begin];
  const isComparable = rows * columns <= mostCompared;
  // The longest common part of what follows each pair of lines.
  const common = new Uint32Array(isComparable ? (rows + 1) * (columns + 1) : 0);
  const known = (i: number, j: number) => (isComparable ? at(common, i * (columns + 1) + j) : 0);
  if (isComparable)
    for (let i = rows - 1; i >= 0; i--)
      for (let j = columns - 1; j >= 0; j--)
        common[i * (columns + 1) + j] = a[begin + i] === b[begin + j] ? known(i + 1, j + 1) + 1 : Math.max(known(i + 1, j), known(i, j + 1));
  const lines: DifferingLine[] = [];
  let [i, j] = [0, 0];
  while (i < rows || j < columns) {
    if (i < rows && j < columns && isComparable && a[begin + i] === b[begin + j]) {
      i++;
      j++;
    } else if (i < rows && (j === columns || known(i + 1, j) >= known(i, j + 1))) {
      lines.push({ of: "disk", number: begin + i + 1, text: at(a, begin + i) });
      i++;
    } else {
      lines.push({ of: "mine", number: begin + j + 1, text: at(b, begin + j) });
      j++;
    }
  }
  return lines;
}
