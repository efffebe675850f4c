import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { FILLS } from "../../viewer/src/print/drawing";
import { PACKAGES } from "./places";

/** What is seen of linear red, green and blue without the cones of one kind: Machado, Oliveira and Fernandes, 2009. */
const SIGHTS: Record<string, number[][]> = {
  all: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

/** Two colours that lie side by side are told apart from here on, in CIELAB. */
const TOLD_APART = 12;

const times = (matrix: number[][], of: number[]) => matrix.map((row) => row.reduce((sum, a, i) => sum + a * of[i], 0));

function lab(hex: string, sight: number[][]): number[] {
  const linear = [1, 3, 5].map((i) => {
    const value = Number.parseInt(hex.slice(i, i + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
  const seen = times(sight, linear).map((value) => Math.min(1, Math.max(0, value)));
  const xyz = times(
    [
      [0.4124 / 0.9505, 0.3576 / 0.9505, 0.1805 / 0.9505],
      [0.2126, 0.7152, 0.0722],
      [0.0193 / 1.089, 0.1192 / 1.089, 0.9505 / 1.089],
    ],
    seen,
  );
  const [x, y, z] = xyz.map((value) => (value > 0.008856 ? Math.cbrt(value) : 7.787 * value + 16 / 116));
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

const distance = (a: string, b: string, sight: number[][]) => {
  const [from, to] = [lab(a, sight), lab(b, sight)];
  return Math.hypot(...from.map((value, i) => value - to[i]));
};

function checkApart(colours: Record<string, string>, what: string): void {
  const names = Object.keys(colours);
  for (const [kind, sight] of Object.entries(SIGHTS))
    for (const [i, a] of names.entries())
      for (const b of names.slice(i + 1)) {
        const far = distance(colours[a], colours[b], sight);
        assert.ok(far > TOLD_APART, `${what}: ${a} and ${b} differ by ${far.toFixed(1)} with ${kind}`);
      }
}

const STYLE = readFileSync(path.resolve(path.dirname(PACKAGES), "style.css"), "utf8");

/** The colours of verdicts as the style sheet has them: those of the light page, and over them those of the dark one. */
function verdicts(dark: boolean): Record<string, string> {
  const [light, other] = STYLE.split(':root[data-theme="dark"]');
  const of = (text: string) =>
    Object.fromEntries(
      [...text.split("}")[0].matchAll(/--verdict-(\d): (#\w{6});/g)].map(([, code, hex]) => [code, hex]),
    );
  return dark ? { ...of(light), ...of(other) } : of(light);
}

for (const dark of [false, true])
  test(`the colour-blind tell verdicts apart, ${dark ? "dark" : "light"}`, () => {
    const colours = verdicts(dark);
    assert.deepEqual(Object.keys(colours), ["0", "1", "2", "3", "4", "6"]);
    checkApart(colours, "verdicts");
  });

test("the colour-blind tell the boxes of a printed page apart", () => {
  checkApart(FILLS, "boxes");
});
