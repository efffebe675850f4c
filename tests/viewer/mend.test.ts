import assert from "node:assert/strict";
import { test } from "node:test";
import type { Load, LoadBox } from "holdfast-engine";
import { UPRIGHT } from "../../viewer/src/data/openings";
import type { World } from "../../viewer/src/data/results";
import { withOneMore } from "../../viewer/src/mend/free_place";
import {
  against,
  changed,
  closedUp,
  leftFloating,
  lowered,
  moved,
  swapped,
  turned,
  withMats,
  without,
} from "../../viewer/src/mend/load_edits";
import { pressedSide, remediesOf } from "../../viewer/src/mend/remedies";

const [FRONT, REAR, LEFT, RIGHT] = UPRIGHT;
const SIZE = [6, 2.4, 2.4];

const box = (x: number, y: number, z: number, length = 1, width = 0.8, height = 0.6): LoadBox => ({
  corner_min: [x, y, z],
  corner_max: [x + length, y + width, z + height],
  material: 1,
});
const loadOf = (...boxes: LoadBox[]): Load => ({ name: "load", boxes });
const placeOf = (load: Load, index: number) => load.boxes[index].corner_min;

test("edits give another load, with the size of the box as it was", () => {
  const load = loadOf(box(1, 0.5, 0), box(3, 0.5, 0));
  const next = moved(load, 1, 0, -0.1);
  assert.deepEqual(placeOf(next, 1), [2.9, 0.5, 0]);
  assert.deepEqual(next.boxes[1].corner_max, [3.9, 1.3, 0.6]);
  assert.deepEqual(placeOf(load, 1), [3, 0.5, 0]);
  assert.deepEqual(turned(load, 0).boxes[0].corner_max, [1.8, 1.5, 0.6]);
  const heavy = loadOf({ ...box(1, 0.5, 0), centre_of_mass: [0.1, 0.02, 0.3] });
  assert.deepEqual(turned(heavy, 0).boxes[0].centre_of_mass, [-0.02, 0.1, 0.3]);
  assert.equal(withMats(load, [1], 0.6).boxes[1].mat, 0.6);
  assert.deepEqual(without(load, 0).boxes, [load.boxes[1]]);
  const named = changed(load, 0, { name: "Paper", mass: 250, material: "pallet" });
  assert.deepEqual(named.boxes[0], { ...load.boxes[0], name: "Paper", mass: 250, material: "pallet" });
  assert.equal(named.boxes[1], load.boxes[1]);
});

test("two boxes swap their places: the corner at the front and the left, or the far wall where one stood at it", () => {
  const load = loadOf(box(0, 0, 0), box(3, 1.2, 0, 1.2, 1.2), box(2, 0.4, 0, 0.5, 0.5));
  const next = swapped(load, 0, 1, SIZE);
  assert.deepEqual(placeOf(next, 1), [0, 0, 0]);
  assert.deepEqual(placeOf(next, 0), [3, 1.6, 0], "at the right wall, though it is narrower");
  assert.deepEqual(next.boxes[0].corner_max, [4, 2.4, 0.6]);
  assert.deepEqual(placeOf(swapped(load, 1, 2, SIZE), 1), [2, 0.4, 0], "away from the walls the corner stays");
  const rear = loadOf(box(5, 0, 0), box(0, 1, 0, 2, 0.8));
  assert.deepEqual(placeOf(swapped(rear, 0, 1, SIZE), 1), [4, 0, 0]);
  const across = loadOf(box(0, 0, 0, 1, 2.4), box(2, 0, 0, 1, 1));
  assert.deepEqual(placeOf(swapped(across, 0, 1, SIZE), 1), [0, 0, 0], "a place at both walls has its left corner");
});

test("of two boxes on each other the upper one becomes the lower one; others may be left without anything beneath", () => {
  const load = loadOf(box(0, 0, 0, 1, 0.8, 1), box(0, 0, 1, 1, 0.8, 0.6), box(0, 0, 1.6), box(2, 0, 0, 1, 0.8, 0.9));
  for (const next of [swapped(load, 0, 1, SIZE), swapped(load, 1, 0, SIZE)]) {
    assert.deepEqual([placeOf(next, 1)[2], placeOf(next, 0)[2]], [0, 0.6]);
    assert.deepEqual(leftFloating(load, next), []);
  }
  assert.deepEqual(leftFloating(load, swapped(load, 0, 3, SIZE)), [1], "the new one is 10 cm lower");
  const floating = loadOf(box(0, 0, 0), box(3, 0, 1));
  assert.deepEqual(leftFloating(floating, moved(floating, 0, 0, 1)), [], "it was so before");
});

test("one more box goes to the lowest place, of these to the front, of these to the left", () => {
  const new_ = (length: number, width: number, height = 0.6) => box(0, 0, 0, length, width, height);
  const place = (load: Load, one: LoadBox, size = SIZE) => {
    const next = withOneMore(load, one, size);
    if (!next) return null;
    assert.deepEqual(next.boxes.slice(0, -1), load.boxes);
    return placeOf(next, load.boxes.length);
  };
  assert.deepEqual(place(loadOf(), new_(1, 0.8)), [0, 0, 0]);
  const row = loadOf(box(0, 0, 0), box(0, 0.8, 0));
  assert.deepEqual(place(row, new_(1, 0.8)), [0, 1.6, 0], "beside them");
  assert.deepEqual(place(row, new_(1, 0.9)), [1, 0, 0], "behind them: there is no room beside");
  assert.deepEqual(place(row, new_(1, 0.9), [1.5, 2.4, 2.4]), [0, 0, 0.6], "on them: there is no room behind");
  assert.equal(place(row, new_(1, 0.9, 2), [1.5, 2.4, 2.4]), null, "not through the roof");
  assert.equal(place(row, new_(1, 2.3), [1.5, 2.4, 2.4]), null, "0.7 of its base would be carried");
  assert.deepEqual(place(row, new_(1, 2.1), [1.5, 2.4, 2.4]), [0, 0, 0.6], "0.76 of it are");
  const uneven = loadOf(box(0, 0, 0, 0.75, 2.4, 0.6), box(0.75, 0, 0, 0.75, 2.4, 0.605));
  assert.deepEqual(place(uneven, new_(1.5, 2), [1.5, 2.4, 2.4]), [0, 0, 0.605], "half a centimetre lower carries too");
  assert.deepEqual(place(loadOf(box(1, 0, 0, 1, 2.4, 2)), new_(1.5, 1), [3.6, 2.4, 2.4]), [2, 0, 0]);
});

test("a box goes against the wall, or against what stands between", () => {
  const load = loadOf(box(1, 0.5, 0), box(3, 0.9, 0), box(3, 0.9, 0.6));
  assert.deepEqual(placeOf(against(load, 0, FRONT, SIZE), 0), [0, 0.5, 0]);
  assert.deepEqual(placeOf(against(load, 1, FRONT, SIZE), 1), [2, 0.9, 0]);
  assert.deepEqual(placeOf(against(load, 2, FRONT, SIZE), 2), [0, 0.9, 0.6], "nothing of its height is in the way");
  assert.deepEqual(placeOf(against(load, 1, REAR, SIZE), 1), [5, 0.9, 0]);
  assert.deepEqual(placeOf(against(load, 1, LEFT, SIZE), 1), [3, 0, 0]);
  assert.deepEqual(placeOf(against(load, 1, RIGHT, SIZE), 1), [3, 1.6, 0]);
});

test("all boxes close up towards a side, and what is fixed stays", () => {
  const load = loadOf(box(4, 0, 0), box(1, 0, 0), box(2.5, 1.2, 0));
  const next = closedUp(load, FRONT, SIZE, () => false);
  assert.deepEqual(
    [0, 1, 2].map((index) => placeOf(next, index)[0]),
    [1, 0, 0],
  );
  const fixed = closedUp(load, FRONT, SIZE, (index) => index === 1);
  assert.deepEqual(
    [0, 1, 2].map((index) => placeOf(fixed, index)[0]),
    [2, 1, 0],
  );
});

test("a box that stands on another goes to the floor, as near as there is room", () => {
  const load = loadOf(box(0, 0, 0), box(0, 0, 0.6), box(1, 0, 0));
  const place = placeOf(lowered(load, 1, SIZE)!, 1);
  assert.deepEqual(place, [0, 0.8, 0]);
  assert.equal(lowered(load, 0, SIZE), null, "it is there already");
  assert.equal(lowered(loadOf(box(0, 0, 0), box(0, 0, 0.6), box(0, 0, 1.2)), 1, SIZE), null, "it carries another");
  assert.equal(lowered(load, 1, [2, 0.8, 2.4]), null, "there is no room");
});

test("what may help is for the critical box and the side that it is pressed to, and is a change", () => {
  const load = loadOf(box(0, 0, 0), box(1.5, 0, 0), box(0, 0, 0.6));
  const world = (acceleration: [number, number, number], criticalBox: number) =>
    ({
      segments: [
        { start: 0, duration: 0.5, value: [0, 0, 0] },
        { start: 0.5, duration: 1, value: acceleration },
      ],
      criticalBox,
      container: { type: "", size: SIZE, openings: { walls: [], roof: true, bedHeight: 0 } },
      boxes: {
        id: Uint32Array.of(1, 2, 3),
        name: ["", "Paper", ""],
        fixed: new Uint8Array(3),
        moved: Uint8Array.of(0, 1, 1),
        fallen: new Uint8Array(3),
        tilted: new Uint8Array(3),
      },
    }) as unknown as World;
  // Braking: the container is accelerated towards the rear, the load goes to the front.
  assert.equal(pressedSide(world([7.8, 0, 0], 2)), UPRIGHT.indexOf(FRONT));
  assert.equal(pressedSide(world([0, -4.9, 0], 2)), UPRIGHT.indexOf(RIGHT));
  const texts = (of: World) => remediesOf(load, of).map(({ text }) => text);
  assert.deepEqual(texts(world([7.8, 0, 0], 2)), [
    "Box 2, Paper towards the front, until it touches",
    "A mat beneath box 2, Paper",
    "Mats beneath the 2 boxes that went beyond a limit",
  ]);
  assert.deepEqual(texts(world([0, -4.9, 0], 3)), [
    "Box 3 towards the right side, until it touches",
    "Box 3 down to the floor",
    "A mat beneath box 3",
    "All boxes towards the right side, until they touch",
    "Mats beneath the 2 boxes that went beyond a limit",
  ]);
});
