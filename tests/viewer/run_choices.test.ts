import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { test } from "node:test";
import type { Engine } from "holdfast-engine";
import {
  advicesOf,
  fromText,
  NORM_SIZES,
  normChoice,
  runSettings,
  toText,
  USUAL,
  whyNotUsed,
} from "../../viewer/src/screen/run_choices";
import { ENGINE } from "./places";

const skip = existsSync(ENGINE) ? false : "make viewer-engine has not built the engine";
const engine: Engine = skip ? null : await (await import(ENGINE)).loadEngine();

test("an address keeps what is not usual, a norm with its size among it", () => {
  assert.equal(toText(USUAL), "");
  const choices = { ...USUAL, norm: normChoice("eumos-40509", true), normSize: "0,5", floor: "0.3", margins: false };
  assert.equal(toText(choices), "norm:eumos-40509:;normSize:0,5;floor:0.3;margins:false");
  assert.deepEqual(fromText(toText(choices)), choices);
});

test("the page asks for the sizes of a norm that the program takes, and for none of a norm that has its own", {
  skip,
}, () => {
  for (const { name, takesSize } of engine.catalogue().norms) {
    const choices = { ...USUAL, norm: normChoice(name, takesSize) };
    const runs = (normSize: string) => engine.run(runSettings({ ...choices, normSize })).norm!.name;
    if (!takesSize) {
      assert.equal(whyNotUsed(choices), null);
      assert.equal(runs("0.5"), name, "a size that was typed for another norm is left out");
      continue;
    }
    const [least, largest] = NORM_SIZES;
    for (const normSize of [String(least), "0,5", String(largest)]) {
      assert.equal(whyNotUsed({ ...choices, normSize }), null);
      assert.equal(runs(normSize), `${name}:${normSize.replace(",", ".")}`);
    }
    for (const normSize of ["", "much", String(0.99 * least), String(1.01 * largest)]) {
      assert.match(whyNotUsed({ ...choices, normSize })!, new RegExp(`^${name} needs a size K: a number of g from`));
      assert.throws(() => runs(normSize), /K g, from 0\.01 to 2/);
    }
  }
});

test("what would help is offered for each end that a file may count from", () => {
  const said = (accepted: string) => advicesOf(accepted).map(({ text, change }) => [text, change]);
  assert.deepEqual(said('everything fits with --axes "x -z y", which are length, width and height'), [
    ["Take the axes x -z y as length, width, height", { axes: "x -z y", format: "" }],
  ]);
  assert.deepEqual(
    said('everything fits with --axes "z x y" where it counts from the front, --axes "-z x y" from the rear'),
    [
      ["Take the axes z x y, counted from the front", { axes: "z x y", format: "" }],
      ["Take the axes -z x y, counted from the rear", { axes: "-z x y", format: "" }],
    ],
  );
  assert.deepEqual(said("everything fits another one if the lengths are mm: --unit mm --container 40hc"), [
    ["Take lengths as mm and the container 40hc", { unit: "mm", container: "40hc" }],
  ]);
  assert.deepEqual(said("everything fits with --format py3dbp"), [
    ["Read it as a file of py3dbp", { format: "py3dbp", axes: "" }],
  ]);
  assert.deepEqual(said("--unit says another"), []);
});
