import assert from "node:assert/strict";
import { test } from "node:test";
import { boxText } from "../../viewer/src/box/box_text";
import { beginOfMotion, freeWay, frictionBelow, frictionSentence, supported } from "../../viewer/src/box/cause";
import { departureOf, departureSentences, sideBeyond } from "../../viewer/src/box/departure";
import { criticalBox, excursionsTo } from "../../viewer/src/data/excursions";
import { betweenBoxes, frictionText, onFloor } from "../../viewer/src/data/friction";
import { fixedMaterials, openingsText, readOpenings } from "../../viewer/src/data/openings";
import { STOP_REASON_CODES, VERDICT_CODES } from "../../viewer/src/data/outcome";
import { pushSentence } from "../../viewer/src/data/push";
import type { BoxColumns, Results, Series, World } from "../../viewer/src/data/results";
import { caveatsOf } from "../../viewer/src/data/status";
import { meaningOf, verdictText } from "../../viewer/src/data/verdict";
import { bedOf, insideOf } from "../../viewer/src/load/container_faces";
import { accelerationAt, accelerationSteps } from "../../viewer/src/time/acceleration";
import { between, slerp, tiltOf, times } from "../../viewer/src/time/poses";
import { markers, roundStep, roundTicks, strips } from "../../viewer/src/time/strips";
import { compared, degrees, fixed, margin, metres, newtons, seconds, tickText, waysOf } from "../../viewer/src/ui/text";

const LIMITS = { move: 0.1, drop: 0.05, tilt: 10 };

test("a time lies between two samples", () => {
  const time = Float64Array.of(0, 0.1, 0.3);
  assert.deepEqual(between(time, -1), { sample: 0, share: 0 });
  assert.deepEqual(between(time, 0.1), { sample: 1, share: 0 });
  assert.equal(between(time, 0.2).sample, 1);
  assert.ok(Math.abs(between(time, 0.2).share - 0.5) < 1e-12);
  assert.deepEqual(between(time, 9), { sample: 2, share: 0 });
});

test("half way between two rotations is half the angle, the short way round", () => {
  const half = Math.SQRT1_2;
  for (const sign of [1, -1]) {
    const q = Float32Array.of(1, 0, 0, 0, sign * half, 0, 0, sign * half);
    const out = new Float32Array(4);
    slerp(q, 0, 4, 0.5, out, 0);
    assert.ok(Math.abs(out[2] - Math.sin(Math.PI / 8)) < 1e-6);
    assert.ok(Math.abs(out[3] - Math.cos(Math.PI / 8)) < 1e-6);
  }
});

test("an acceleration pushes the load against where the container goes, in the words of a planner", () => {
  const of = (...values: [number, number, number][]) =>
    values.map((value, i) => ({ start: 0.5 + i, duration: 1, value }));
  assert.equal(
    pushSentence(of([7.848, 0, 0])),
    "The load is pushed to the front with 0.8 g, from 0.5 s to 1.5 s.",
    "braking",
  );
  // A vehicle that turns left accelerates to the left, which is a negative y.
  assert.match(pushSentence(of([0, -4.905, 0])), /to the right with 0.5 g/);
  assert.match(pushSentence(of([0, 4.905, 0])), /to the left with 0.5 g/);
  assert.match(pushSentence(of([-4.905, 0, 0])), /to the rear with 0.5 g/);
  assert.match(pushSentence(of([1, 1, 0])), /to the front and left with 0.144 g/);
  assert.equal(
    pushSentence(of([0, 2, 0], [0, 1, 0], [0, -2, 0])),
    "The load is pushed to the left with 0.204 g, from 0.5 s to 2.5 s, then to the right with 0.204 g, from 2.5 s to 3.5 s.",
    "what goes on in the same direction is one push",
  );
  const light = pushSentence(of([2.943, 0, -0.5 * 9.81]));
  assert.match(light, /to the front with 0.3 g.* Meanwhile it weighs 50 % of what it weighs at rest\.$/);
  assert.equal(pushSentence(of([0, 0, 0])), "The load is not pushed to any side.");
  const many = [1, -1, 1, -1.5].map((x): [number, number, number] => [x, 0, 0]);
  assert.equal(pushSentence(of(...many)), "The load is pushed 4 times, hardest to the rear with 0.153 g.");
});

test("a displacement is told in words: forwards, left, down", () => {
  assert.deepEqual(waysOf([-0.123, 0.04, -0.02]), [
    ["forwards", "12.3 cm"],
    ["right", "4.0 cm"],
    ["down", "2.0 cm"],
  ]);
  assert.deepEqual(waysOf([1.5, -0.0004, 0]), [["backwards", "1.50 m"]]);
  assert.deepEqual(waysOf([0, 0, 0]), []);
});

test("the time line has a curve for each side that the load is pushed to", () => {
  const segments = [
    { start: 0, duration: 1, value: [7.848, 0, 0] },
    { start: 1, duration: 1, value: [0, -4.905, 0] },
  ];
  const [pushed] = strips({ series: null, segments, accelerated: true } as unknown as World, 0, 2);
  const curves = pushed.lines.map(({ label, values }) => [label, ...Array.from(values, (v) => Number(v.toFixed(6)))]);
  assert.deepEqual(curves, [
    ["front", 0.8, 0, 0],
    ["right", 0, 0.5, 0.5],
  ]);
});

test("segments of an acceleration hold from their start to before their end", () => {
  const segments = [{ start: 0.5, duration: 1, value: [7.848, 0, 0] as [number, number, number] }];
  assert.equal(accelerationAt(segments, 0.49)[0], 0);
  assert.equal(accelerationAt(segments, 0.5)[0], 7.848);
  assert.equal(accelerationAt(segments, 1.5)[0], 0);
});

/** Boxes from their lowest corners and sizes, m, and where their centres of mass are from their middles. */
function boxesOf(list: { at: number[]; size: number[]; centre?: number[] }[]): BoxColumns {
  const centreOf = ({ centre = [0, 0, 0] }: (typeof list)[number]) => centre;
  return {
    id: Uint32Array.from(list, (_, i) => i + 1),
    size: Float32Array.from(list.flatMap(({ size }) => size)),
    centre: Float32Array.from(list.flatMap(centreOf)),
    reference: Float32Array.from(
      list.flatMap((box) => box.at.map((low, axis) => low + box.size[axis] / 2 + centreOf(box)[axis])),
    ),
  } as unknown as BoxColumns;
}

const pile = boxesOf([
  { at: [1, 0, 0], size: [1, 1, 1] },
  { at: [2.2, 0, 0], size: [1, 1, 1] },
  { at: [1.5, 0, 1], size: [1, 1, 0.5], centre: [0.2, -0.1, 0.15] },
]);

test("the way of a box is free until the next box or the wall", () => {
  const container = [6, 2.4, 2.4];
  assert.ok(Math.abs(freeWay(pile, container, 0, 0, true) - 0.2) < 1e-5);
  assert.ok(Math.abs(freeWay(pile, container, 0, 0, false) - 1) < 1e-5);
  assert.ok(Math.abs(freeWay(pile, container, 1, 0, true) - 2.8) < 1e-5);
});

const SIZE = [6, 2.4, 2.2] as const;
const TRAILER = readOpenings(
  { "Container/OpenSides": "rear roof", "Container/DropSides": "left 60 right 62.5", "Container/BedHeight": "120" },
  2.2,
);

test("settings say what is open, how high walls and floor are, and which materials are fixed", () => {
  assert.deepEqual(readOpenings({}, 2.2), { walls: [2.2, 2.2, 2.2, 2.2], roof: true, bedHeight: 0 });
  assert.equal(openingsText(readOpenings({}, 2.2), 2.2), null);
  assert.deepEqual(TRAILER, { walls: [2.2, 0, 0.6, 0.625], roof: false, bedHeight: 1.2 });
  assert.equal(
    openingsText(TRAILER, 2.2),
    "rear, roof open; left 60 cm high; right 62.5 cm high; floor 120 cm above the ground",
  );
  const high = readOpenings({ "Container/DropSides": "Left=400, front", "Container/BedHeight": "0" }, 2.2);
  assert.deepEqual(
    high,
    { walls: [2.2, 2.2, 2.2, 2.2], roof: true, bedHeight: 0 },
    "a wall is no higher than the roof",
  );
  const settings = {
    "Material 2/Fixed": "true",
    "Material 3/Fixed": "false",
    "Material 4/Mass": "1",
    "Material wheel arch/Fixed": "yes",
  };
  assert.deepEqual([...fixedMaterials(settings)], ["2", "wheel arch"]);
});

test("a container is drawn with the walls that it has, and its floor as a block where one is open or low", () => {
  const closed = readOpenings({}, 2.2);
  assert.equal(insideOf(SIZE, closed).corners.length, 6);
  assert.equal(bedOf(SIZE, closed).corners.length, 0);
  assert.deepEqual(insideOf(SIZE, TRAILER).corners, [
    { low: [0, 0, 0], high: [6, 2.4, 0] },
    { low: [0, 0, 0], high: [0, 2.4, 2.2] },
    { low: [0, 0, 0], high: [6, 0, 0.6] },
    { low: [0, -0.05, 0.6], high: [6, 0, 0.6] },
    { low: [0, 2.4, 0], high: [6, 2.4, 0.625] },
    { low: [0, 2.4, 0.625], high: [6, 2.4 + 0.05, 0.625] },
  ]);
  const block = bedOf(SIZE, TRAILER).corners;
  assert.deepEqual(block[0], { low: [-0.05, -0.05, -1.2], high: [-0.05, 2.4 + 0.05, 0] });
  assert.deepEqual(block[1].low, [6, -0.05, -1.2], "it ends with the floor where the rear is open");
  assert.equal(bedOf(SIZE, { ...TRAILER, bedHeight: 0 }).corners.length, 0);
});

test("a point is beyond a side that lets it out", () => {
  const beyond = (...point: number[]) => sideBeyond(SIZE, TRAILER, point);
  assert.equal(beyond(3, 1, 1), -1);
  assert.equal(beyond(6.1, 1, 1), 1);
  assert.equal(beyond(6.1, -0.2, -1), 2, "the farther one");
  assert.equal(beyond(-0.1, 1, 1), 4, "behind a full wall, it went out above");
  assert.equal(sideBeyond(SIZE, { ...TRAILER, roof: true }, [-0.1, 1, 1]), -1);
});

test("a box leaves through an open side or over a low one, and falls to the ground where there is one", () => {
  const boxes = boxesOf([{ at: [2, 0, 0], size: [1, 1, 1] }]);
  const left = (endDisplacement: number[], tilt: number, series: Series | null = null, openings = TRAILER) => {
    const results = { thresholds: LIMITS } as unknown as Results;
    const end = excursionsTo(Float32Array.from(endDisplacement), Float32Array.of(tilt));
    const moved = { ...boxes, end, endDisplacement: Float32Array.from(endDisplacement) };
    const world = { boxes: moved, series, container: { size: SIZE, openings } };
    return departureSentences(results, world as unknown as World, 0).join();
  };
  assert.equal(left([0.5, 0, 0], 0), "");
  assert.equal(left([4, 0, 0], 0), "It left through the open rear.");
  assert.equal(left([4, 0, -1.2], 90), "It left through the open rear, and fell to the ground.");
  assert.equal(left([4, 0, -1.2], 90, null, { ...TRAILER, bedHeight: 0 }), "It left through the open rear.");
  assert.equal(left([0, -1, -1.2], 90), "It tipped over the low left side, and fell to the ground.");
  assert.equal(left([0, -1, -1.2], 5), "It went over the low left side, and fell to the ground.");
  // It goes over the left side first, and ends behind the rear.
  const series = {
    time: Float64Array.of(0, 0.1, 0.2),
    displacement: Float32Array.of(0, 0, 0, 0, -0.6, 0.4, 4, -1, -1.2),
    orientation: Float32Array.of(1, 0, 0, 0, Math.SQRT1_2, Math.SQRT1_2, 0, 0, 1, 0, 0, 0),
  } as unknown as Series;
  assert.equal(left([4, -1, -1.2], 0, series), "It tipped over the low left side by 0.10 s, and fell to the ground.");
  const outside = boxesOf([{ at: [5.8, 0, 0], size: [1, 1, 1] }]);
  const still = { ...outside, end: excursionsTo(new Float32Array(3), new Float32Array(1)) };
  const container = { size: SIZE, openings: TRAILER };
  const world = { boxes: { ...still, endDisplacement: new Float32Array(3) }, series: null, container };
  const results = { thresholds: LIMITS } as unknown as Results;
  assert.equal(departureOf(results, world as unknown as World, 0), null, "loaded outside, it leaves through nothing");
  // Beyond the sill as loaded, it tips out before t = 0.
  const fallen = Float32Array.of(0.2, 0, -1.2);
  const settling = {
    time: Float64Array.of(-2, -1.5),
    displacement: Float32Array.of(0, 0, 0, ...fallen),
    orientation: Float32Array.of(1, 0, 0, 0, 0, 0, 1, 0),
  } as unknown as Series;
  const tipped = { ...outside, end: excursionsTo(fallen, Float32Array.of(180)), endDisplacement: fallen };
  const unstable = { boxes: tipped, series: settling, container };
  assert.deepEqual(departureSentences(results, unstable as unknown as World, 0), [
    "It left through the open rear while the load settled, and fell to the ground.",
  ]);
  assert.equal(departureOf(results, unstable as unknown as World, 0)?.time, -1.5, "not before it falls");
});

test("a base is supported by what it stands on", () => {
  assert.equal(supported(pile, 0), 1);
  assert.ok(Math.abs(supported(pile, 2) - 0.8) < 1e-5);
});

test("a box begins to move in the first sample in which it has used up a tenth of a limit", () => {
  // Three samples of two boxes: the second moves 2 cm in the first step, the first box in the next.
  const displacement = new Float32Array(18);
  displacement[3 * 3] = 0.02;
  displacement[3 * 4] = 0.03;
  displacement[3 * 5] = 0.05;
  const orientation = Float32Array.from({ length: 24 }, (_, i) => (i % 4 === 0 ? 1 : 0));
  const series = { time: Float64Array.of(0, 0.1, 0.2), displacement, orientation } as unknown as Series;
  assert.equal(beginOfMotion(series, 2, 0, LIMITS), 2);
  assert.equal(beginOfMotion(series, 2, 1, LIMITS), 1);
  assert.equal(beginOfMotion({ ...series, displacement: new Float32Array(18) }, 2, 0, LIMITS), -1);
});

test("a tilt is exact where it is small, whatever the sign of the quaternion", () => {
  const turn = (degree: number, sign: number) => {
    const half = (degree * Math.PI) / 360;
    return [sign * Math.cos(half), 0, sign * Math.sin(half), 0];
  };
  for (const [degree, sign] of [
    [1e-4, 1],
    [10, -1],
    [180, 1],
  ])
    assert.ok(Math.abs(tiltOf([...turn(30, 1), ...turn(30 + degree, sign)], 0, 4) - degree) < 1e-9);
});

test("the critical box is the one that is beyond a limit first, or else has used up most of one", () => {
  const displacement = Float32Array.of(0.3, 0, 0, 0.12, 0, 0, 0.01, 0, -0.04);
  const of = excursionsTo(displacement, Float32Array.of(0, 11, 0));
  const never = () => new Float32Array(3).fill(Number.NaN);
  assert.equal(criticalBox(Float32Array.of(0.4, 0.2, Number.NaN), of, LIMITS), 2);
  assert.equal(
    criticalBox(Float32Array.of(Number.NaN, 0.2, 0.2), of, LIMITS),
    2,
    "of those at a time, the first of the layout",
  );
  assert.equal(criticalBox(Float32Array.of(0.4, Number.NaN, -0.1), of, LIMITS), 3, "while settling is before");
  assert.equal(criticalBox(never(), of, LIMITS), 1);
  const within = excursionsTo(Float32Array.of(0.05, 0, 0, 0, 0, 0, 0.01, 0, -0.04), new Float32Array(3));
  assert.equal(
    criticalBox(never(), within, LIMITS),
    3,
    "four of five centimetres down are more than five of ten aside",
  );
  assert.equal(criticalBox(never(), excursionsTo(new Float32Array(9), new Float32Array(3)), LIMITS), 0);
  const still = excursionsTo(Float32Array.of(0.0009, 0, 0, 0, 0, 0, 0, 0, 0), new Float32Array(3));
  assert.equal(criticalBox(never(), still, LIMITS), 0, "less than a hundredth of a limit is not told");
});

test("a world that ended early is at least its verdict; one that is unstable is no worse than that", () => {
  const { moved, unstable } = VERDICT_CODES;
  const { decided, timeout } = STOP_REASON_CODES;
  assert.equal(verdictText(moved, decided), "at least moved");
  assert.equal(verdictText(moved, timeout), "moved");
  assert.equal(verdictText(unstable, decided), "unstable");
});

test("meanings are of the whole journey, or of the end in a file of an earlier version; caveats are sentences", () => {
  assert.match(meaningOf(VERDICT_CODES.stayed, false), /ever/);
  assert.match(meaningOf(VERDICT_CODES.stayed, true), /at the end/);
  assert.deepEqual(
    caveatsOf(1 | 4).map(({ name }) => name),
    ["not at rest", "marginal"],
  );
  assert.deepEqual(caveatsOf(0), []);
});

test("a world that is unstable begins before 0, and is not accelerated", () => {
  const segments = [{ start: 0, duration: 1, value: [7.848, 0, 0] as [number, number, number] }];
  const world = { segments, accelerated: false, series: null, beginTime: -2, endTime: 0 } as unknown as World;
  assert.deepEqual([...times(world)], [-2, 0]);
  assert.deepEqual(accelerationSteps(world, -2, 0), [{ time: -2, value: [0, 0, 0] }]);
  const other = { ...world, accelerated: true, beginTime: 0, endTime: 3 };
  assert.deepEqual(
    accelerationSteps(other, 0, 3).map(({ time, value }) => [time, value[0]]),
    [
      [0, 7.848],
      [1, 0],
    ],
  );
});

test("marks are where boxes are beyond a limit first, those of the same time together", () => {
  assert.deepEqual(markers(Float32Array.of(0.5, Number.NaN, -0.25, 0.5)), [
    { time: -0.25, boxes: [2] },
    { time: 0.5, boxes: [0, 3] },
  ]);
});

test("times have a sign, and none where they are 0; the largest margin that is tried is open", () => {
  assert.equal(seconds(-0.9), "−0.90 s");
  assert.equal(seconds(-0.001), "0.00 s");
  assert.equal(margin(0.302), "0.30 g");
  assert.equal(margin(1.5), "1.50+ g");
  assert.equal(margin(0.5), "0.50 g");
  assert.equal(margin(0.57), "0.57 g");
  assert.equal(margin(0.495), "0.49 g", "a load stands what the text says");
  assert.equal(margin(0.505), "0.50 g");
  assert.equal(margin(-0.12), "unstable");
  assert.equal(margin(Number.NaN), "–");
});

test("no number is a zero with a sign", () => {
  for (const zero of [-0, -0.0004]) {
    assert.equal(fixed(zero, 2), "0.00");
    assert.equal(metres(zero), "0");
    assert.equal(newtons(zero), "0 N");
    assert.equal(tickText(-0), "0");
  }
  assert.equal(fixed(-0.25, 1), "−0.3");
  assert.equal(metres(-0.25), "−25.0 cm");
});

test("two numbers that a sentence compares differ as they are printed", () => {
  assert.deepEqual(compared(0.12, 0.1, metres), ["12.0 cm", "10.0 cm"]);
  assert.deepEqual(compared(0.10004, 0.1, metres), ["10.004 cm", "10.000 cm"]);
  assert.deepEqual(compared(0.0001, 0.0002, metres), ["0.10 mm", "0.20 mm"]);
  assert.deepEqual(compared(9.98, 10, degrees), ["9.98°", "10.00°"]);
  assert.deepEqual(compared(0.1, 0.1, metres), ["10.0 cm", "10.0 cm"]);
});

const PRODUCT = {
  "Contact/FrictionModel": "product",
  "Contact/BoxBox": "0.5",
  "Contact/BoxFloor": "0.5",
  "Contact/BoxWall": "0.45",
  "Simulation Settings/BoxFriction": "0.8",
  "Simulation Settings/ContainerFriction": "0.5",
};

test("friction is that of the keys that act", () => {
  assert.equal(frictionText(PRODUCT), "box on box 0.64, on floor and walls 0.4");
  const own = { ...PRODUCT, "Material 2/Friction": "0.2" };
  assert.equal(frictionText(own), "box on box 0.64, on floor and walls 0.4, others where a material has its own");
  assert.equal(frictionText({ ...PRODUCT, "Material 2/Friction": "" }), frictionText(PRODUCT));
  const pairs = { ...PRODUCT, "Contact/FrictionModel": "pairs", "Contact/BoxFloor": "0.3" };
  assert.equal(frictionText(pairs), "box on box 0.5, on the floor 0.3, on walls 0.45");
  const row = { ...pairs, "Friction/carton, pallet": "0.4" };
  assert.equal(frictionText(row), `${frictionText(pairs)}; one pair of materials has its own`);
  const rows = { ...row, "Friction/carton, floor": "0.6" };
  assert.equal(frictionText(rows), `${frictionText(pairs)}; 2 pairs of materials have their own`);
  assert.equal(frictionText({ ...PRODUCT, "Material pallet/Friction": "0.2" }), frictionText(own));
  assert.ok(Math.abs(onFloor(PRODUCT) - 0.4) < 1e-12);
  assert.ok(Math.abs(onFloor(own, "2") - 0.1) < 1e-12);
  assert.ok(Math.abs(betweenBoxes(own, "1", "2") - 0.16) < 1e-12);
  assert.equal(onFloor(pairs, "2"), 0.3);
  assert.equal(betweenBoxes(pairs, "1", "2"), 0.5);
  assert.ok(Number.isNaN(onFloor({})));
});

test("of rows of pairs the one that says most holds, whatever the order of its names", () => {
  const settings = {
    ...PRODUCT,
    "Contact/FrictionModel": "pairs",
    "Friction/carton, pallet": "0.41",
    "Friction/carton, floor": "0.42",
    "Friction/carton, any": "0.43",
    "Friction/steel, any": "0.2",
  };
  const cases: [string, string, number][] = [
    ["carton", "pallet", 0.41],
    ["pallet", "carton", 0.41],
    ["carton", "carton", 0.43],
    ["7", "carton", 0.43],
    ["pallet", "pallet", 0.5],
    ["steel", "pallet", 0.2],
  ];
  for (const [a, b, friction] of cases) assert.equal(betweenBoxes(settings, a, b), friction, `${a} on ${b}`);
  const floors: [string, number][] = [
    ["carton", 0.42],
    ["steel", 0.2],
    ["pallet", 0.5],
  ];
  for (const [material, friction] of floors) assert.equal(onFloor(settings, material), friction, material);
  assert.equal(onFloor(settings), 0.5);
  assert.ok(
    Math.abs(betweenBoxes({ ...settings, "Contact/FrictionModel": "product" }, "carton", "pallet") - 0.64) < 1e-12,
  );
});

test("a box is called by its number, and by its name where it has another one", () => {
  const boxes = { id: Uint32Array.of(1, 2, 3), name: ["Paper 1", "", "3"] };
  assert.deepEqual(
    [0, 1, 2].map((box) => boxText(boxes, box)),
    ["box 1, Paper 1", "box 2", "box 3"],
  );
  assert.equal(boxText(boxes, 0, "Box"), "Box 1, Paper 1");
});

test("a push is compared with the friction of what is below the box, and reads as more where it is more", () => {
  const boxes = { ...pile, material: ["1", "2", "1"], mat: new Float64Array(3).fill(Number.NaN) };
  const settings = { ...PRODUCT, "Material 2/Friction": "0.4" };
  assert.ok(Math.abs(frictionBelow(settings, boxes, 1) - 0.2) < 1e-12);
  assert.ok(Number.isNaN(frictionBelow(settings, boxes, 2)), "it stands on two materials");
  assert.ok(Math.abs(frictionBelow(PRODUCT, boxes, 2) - 0.64) < 1e-12);
  const onMat = { ...boxes, mat: Float64Array.of(Number.NaN, 0.6, 0.7) };
  assert.deepEqual(
    [1, 2].map((box) => frictionBelow(settings, onMat, box)),
    [0.6, 0.7],
  );
  assert.equal(frictionSentence(0.8, 0.5), "The push of 0.80 g is more than friction holds (0.50 g).");
  assert.equal(frictionSentence(0.104, 0.1), "The push of 0.104 g is more than friction holds (0.100 g).");
  assert.match(frictionSentence(0.505, 0.5) ?? "", /just holds, or just does not/);
  assert.equal(frictionSentence(0.3, 0.5), null);
  assert.equal(frictionSentence(0.3, Number.NaN), null);
});

test("axes end at round numbers, with a zero among them, and none has a range of 0", () => {
  assert.deepEqual(roundTicks(0, 7.848), [0, 4, 8]);
  assert.deepEqual(roundTicks(0, 1234), [0, 1000, 2000]);
  assert.deepEqual(roundTicks(-7.848, 7.848), [-10, 0, 10]);
  assert.deepEqual(roundTicks(-0.3, 7.848), [-10, 0, 10]);
  assert.deepEqual(roundTicks(0, 0.3), [0, 0.2, 0.4]);
  assert.deepEqual(roundTicks(0, 0), [0, 0.5, 1]);
  assert.deepEqual(roundTicks(0, 1, true), [0, 1]);
  assert.deepEqual(roundTicks(0, 3, true), [0, 2, 4]);
  assert.equal(roundStep(0.07, [1, 2, 5]), 0.1);
});

test("each curve has a unit, and an axis that takes in all of its values", () => {
  const series = {
    time: Float64Array.of(0, 1),
    acceleration: new Float32Array(6),
    energy: Float32Array.of(0, 2345),
    fallen: Uint32Array.of(0, 0),
  };
  const world = { series, segments: [], accelerated: true } as unknown as World;
  const found = strips(world, 0, 1).map(({ unit, ticks }) => ({ unit, ticks }));
  assert.deepEqual(found, [
    { unit: "g", ticks: [0, 0.5, 1] },
    { unit: "kJ", ticks: [0, 2, 4] },
    { unit: "boxes", ticks: [0, 1] },
  ]);
});
