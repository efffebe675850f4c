import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { hitBox } from "../../viewer/src/live/box_hit";
import { DrivenAcceleration } from "../../viewer/src/live/driven_acceleration";
import { bitsSentence } from "../../viewer/src/live/live_words";
import { dragged, placed } from "../../viewer/src/live/placing";
import { accelerationText, engineSettings, settingsText } from "../../viewer/src/live/saved_files";
import { SpeedMeter } from "../../viewer/src/live/speed_meter";
import { pullForce } from "../../viewer/src/live/spring";

const BRAKE = [
  { start: 0.5, duration: 1, value: [7.8, 0, 0] as [number, number, number] },
  { start: 2, duration: 1, value: [0, 3, 0] as [number, number, number] },
];

test("an acceleration that nobody takes over is that of the file, and zero after it", () => {
  const driven = new DrivenAcceleration(BRAKE);
  assert.deepEqual(driven.at(0.7), [7.8, 0, 0]);
  assert.deepEqual(driven.at(1.7), [0, 0, 0]);
  assert.deepEqual(driven.segments(4), [...BRAKE, { start: 3, duration: 1, value: [0, 0, 0] }]);
  assert.deepEqual(driven.segments(1), [{ start: 0.5, duration: 0.5, value: [7.8, 0, 0] }]);
});

test("a driver takes over from the file, and changes hold until the next one", () => {
  const driven = new DrivenAcceleration(BRAKE);
  driven.set(1, [5, 0, 0]);
  driven.set(1, [4, 0, 0]);
  driven.set(1.25, [4, 0, 0]);
  driven.set(1.5, [0, 0, 1]);
  assert.ok(driven.taken);
  assert.deepEqual(driven.at(1.5), [0, 0, 1]);
  assert.deepEqual(driven.segments(2), [
    { start: 0.5, duration: 0.5, value: [7.8, 0, 0] },
    { start: 1, duration: 0.5, value: [4, 0, 0] },
    { start: 1.5, duration: 0.5, value: [0, 0, 1] },
  ]);
});

test("a driver who takes over before the start leaves nothing of the file", () => {
  const driven = new DrivenAcceleration(BRAKE);
  driven.set(0, [1, 0, 0]);
  assert.deepEqual(driven.segments(3), [{ start: 0, duration: 3, value: [1, 0, 0] }]);
  assert.deepEqual(driven.segments(0), []);
});

test("an acceleration file has a line per segment, in numbers that are read as they are", () => {
  const text = accelerationText([{ start: 1 / 3, duration: 0.1, value: [0.6 * 9.81, 0, -0] }], "why");
  const numbers = text.split("\n")[2].split("\t").map(Number);
  assert.deepEqual(numbers, [1 / 3, 0.1, 0.6 * 9.81, 0, 0]);
});

test("settings leave out what is of the run, and what has no value", () => {
  const given = {
    "Contact/BoxBox": "0.5",
    "Contact/FrictionModel": "product",
    "Simulation Settings/BoxFriction": "0.7",
    "Material 3/Density": "300",
    "Native/Tolerance": "",
    "Screening/Engine": "bullet",
    "Screening/Norm": "road",
    "Screening/Margins": "true",
    "Loads/Unit": "mm",
  };
  const asGiven = engineSettings(given, {}).map(([, key]) => key);
  assert.deepEqual(asGiven, ["FrictionModel", "BoxFriction", "Density", "Engine"]);
  const pairs = { "Contact/BoxBox": "0.2", "Contact/FrictionModel": "pairs", "Native/Accuracy": "screening" };
  const settings = engineSettings(given, pairs);
  assert.deepEqual(settings, [
    ["Contact", "BoxBox", "0.2"],
    ["Contact", "FrictionModel", "pairs"],
    ["Material 3", "Density", "300"],
    ["Screening", "Engine", "native"],
    ["Native", "Accuracy", "screening"],
  ]);
  const rows = {
    ...given,
    "Contact/FrictionModel": "pairs",
    "Friction/carton, pallet": "0.4",
    "Material pallet/Friction": "0.3",
  };
  assert.deepEqual(
    engineSettings(rows, {}).filter(([section]) => /^Friction|pallet$/.test(section)),
    [["Friction", "carton, pallet", "0.4"]],
  );
  assert.ok(
    !engineSettings(rows, pairs).some(([section]) => section === "Friction"),
    "a coefficient of all pairs is of these too",
  );
  assert.match(
    settingsText(settings, "why"),
    /^# why\n\n\[Contact\]\nBoxBox = 0\.2\nFrictionModel = pairs\n\n\[Material 3\]\nDensity = 300\n/,
  );
});

test("a box is put where it is told, and keeps its size", () => {
  const boxes = Float64Array.of(0, 0, 0, 0.5, 0.4, 0.3, 7);
  const row = placed(boxes, 0, [1.2, 0.1, 0]);
  [1.2, 0.1, 0, 1.7, 0.5, 0.3, 7].forEach((value, i) => {
    assert.ok(Math.abs(row[i] - value) < 1e-9);
  });
  assert.equal(boxes[0], 0, "the layout before is left as it was");
});

test("a box that is dragged goes against what it comes near, and past it otherwise", () => {
  const boxes = Float64Array.of(0, 0, 0, 0.5, 0.5, 0.5, 0, 2, 0, 0, 2.5, 0.5, 0.5, 0);
  const container = [6, 2.4, 2.4];
  assert.equal(dragged(boxes, 0, [1.48, 0], container)[0], 1.5, "against the other box");
  assert.equal(dragged(boxes, 0, [1.2, 0], container)[0], 1.2, "free");
  assert.equal(dragged(boxes, 0, [1.48, 1], container)[0], 1.48, "the other box does not face it");
  assert.equal(dragged(boxes, 0, [0, 1.89], container)[1], 1.9, "against the wall");
  assert.equal(dragged(boxes, 0, [-3, 0], container)[0], 0, "not through the wall");
});

test("a ray meets a box that is turned where it should", () => {
  const box = {
    place: new THREE.Vector3(1, 2, 3),
    rotation: new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), Math.PI / 4),
    size: new THREE.Vector3(2, 2, 2),
  };
  const ray = new THREE.Ray(new THREE.Vector3(-9, 2, 3), new THREE.Vector3(1, 0, 0));
  assert.ok(hitBox(ray, box)!.distanceTo(new THREE.Vector3(1 - Math.SQRT2, 2, 3)) < 1e-12);
  assert.equal(hitBox(new THREE.Ray(new THREE.Vector3(-9, 4, 3), new THREE.Vector3(1, 0, 0)), box), null);
});

test("a pull of ten centimetres pulls with the weight, a long one with no more than thirty", () => {
  const still = new THREE.Vector3();
  assert.ok(Math.abs(pullForce(new THREE.Vector3(0.1, 0, 0), still, 20).x - 20 * 9.81) < 1e-9);
  assert.ok(Math.abs(pullForce(new THREE.Vector3(0, 50, 0), still, 20).y - 30 * 20 * 9.81) < 1e-9);
  const slowed = pullForce(new THREE.Vector3(0.1, 0, 0), new THREE.Vector3(1, 0, 0), 20);
  assert.ok(slowed.x < 20 * 9.81);
});

test("speed is that of the latest pictures; what is possible is the engine's alone", () => {
  const meter = new SpeedMeter();
  assert.ok(Number.isNaN(meter.shown) && Number.isNaN(meter.possible));
  for (let i = 0; i <= 40; ++i) meter.picture(i / 10, i < 20 ? 0 : (i - 20) / 5);
  assert.ok(Math.abs(meter.shown - 2) < 1e-9);
  meter.step(0.1, 0.02);
  assert.ok(Math.abs(meter.possible - 5) < 1e-9);
});

test("what a replay says of the file", () => {
  const world = { engine: "native", stateHash: "00ff", verdict: 0, endTime: 3 };
  const said = (hash: string, change = {}, software = "holdfast 2.0.0") =>
    bitsSentence({ software }, { ...world, ...change }, "2.0.0", hash);
  assert.deepEqual(said("00ff"), { same: true, text: "The same bits as the file" });
  assert.match(said("00fe").text, /Other bits than the file's, whose hash is 00ff/);
  assert.match(said("00fe", {}, "holdfast 0.9.0").text, /of holdfast 0\.9\.0, this page of 2\.0\.0/);
  assert.match(said("00fe", { endTime: -0.9 }).text, /ended while it settled/);
  assert.match(said("00ff", { engine: "bullet" }).text, /of the engine bullet: there are no bits/);
});
