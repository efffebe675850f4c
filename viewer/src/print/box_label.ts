/** Labels of boxes in the drawings of a load. */

/** Pixels: letters, and shares of that: the width of one, and the height of a line. */
export const LETTER = 7;
const LETTER_WIDTH = 0.56;
export const LINE_HEIGHT = 1.15;
const MOST_LINES = 3;

/** The text in lines of so many letters at most, unless one of its words has more. */
function wrapped(text: string, letters: number): string[] {
  const lines: string[] = [];
  for (const word of text.split(/\s+/).filter((part) => part !== "")) {
    const last = lines.length - 1;
    if (last >= 0 && lines[last].length + 1 + word.length <= letters) lines[last] += ` ${word}`;
    else lines.push(word);
  }
  return lines;
}

/** The lines of the label that fits into a face of so many pixels: the name, else the number, else none. */
export function fittingLabel(
  { name, number }: { name: string; number: number },
  width: number,
  height: number,
): string[] {
  const letters = Math.floor((width - 3) / (LETTER_WIDTH * LETTER));
  const most = Math.min(MOST_LINES, 1 + (height - 2 - LETTER) / (LINE_HEIGHT * LETTER));
  const fits = (lines: string[]) =>
    lines.length > 0 && lines.length <= most && lines.every((line) => line.length <= letters);
  return [wrapped(name, letters), [String(number)]].find(fits) ?? [];
}

/** Pixels that a label takes: width and height. */
export const sizeOfLabel = (lines: readonly string[]): [number, number] => [
  LETTER_WIDTH * LETTER * Math.max(0, ...lines.map((line) => line.length)),
  LINE_HEIGHT * LETTER * lines.length,
];
