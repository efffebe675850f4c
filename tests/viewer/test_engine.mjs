// The engine of the page, in node: the same bits as the program, and errors that say what is wrong.
//   node --test tests/viewer/test_engine.mjs        after `make viewer-engine` and `make program`
import assert from "node:assert/strict";
import { test } from "node:test";
import { accelerations, ENGINE, inputsOf, layouts, screenedByProgram } from "./engine_worlds.mjs";

const { loadEngine, EngineError } = await import(ENGINE);
const engine = await loadEngine();
const still = new Float64Array([0, 2, 0, 0, 0]);
const oneBox = new Float64Array([2, 1, 0, 2.5, 1.5, 0.5, 1]);

test("every bundled layout under every bundled acceleration ends in the bits of the program", (t) => {
  const expected = screenedByProgram();
  assert.equal(expected.length, layouts.length * accelerations.length);
  const different = [];
  for (const world of expected) {
    const outcome = engine.screen(inputsOf(engine, world));
    if (outcome.stateHash !== world.state_hash) {
      different.push(`${world.layout} under ${world.acceleration}: ${outcome.stateHash}, not ${world.state_hash}`);
      continue;
    }
    assert.equal(outcome.verdict, world.verdict);
    assert.equal(outcome.stopReason, world.stop_reason);
    assert.equal(outcome.endTime, world.end_time_s);
    assert.equal(outcome.fallen, world.fallen_boxes);
    assert.equal(outcome.moved, world.moved_boxes);
    assert.equal(outcome.steps, world.steps);
    assert.equal(outcome.unstable, world.unstable_boxes);
    assert.equal(outcome.criticalBox, world.critical_box);
    assert.equal(outcome.peakDisplacement, world.peak_displacement_m);
    assert.equal(outcome.endDisplacement, world.end_displacement_m);
  }
  assert.deepEqual(different, []);
  t.diagnostic(
    `${expected.length} state hashes compared, ${new Set(expected.map((w) => w.state_hash)).size} different ones`,
  );
});

test("a world in pieces ends as a whole one", () => {
  const world = { layout: "seed_example.txt", acceleration: "road_brake_0g8.txt" };
  const inputs = inputsOf(engine, world);
  const { stateHash, endTime } = engine.screen(inputs);
  const live = engine.world(inputs);
  assert.ok(live.endTime >= endTime, "the latest end, after the time to come to rest");
  for (let time = 0; live.time < live.endTime; time += 1 / 60) live.advance(time);
  assert.equal(live.stateHash(), stateHash);
  assert.equal(live.poses().length, 7 * live.boxCount);
  live.free();
});

test("acceleration, friction and forces change on the way", () => {
  const world = engine.world({ boxes: oneBox, segments: still });
  world.advance(0.5);
  world.setFriction(0.5, 0.2, 0.5);
  world.setAcceleration([7, 0, 0]);
  world.advance(1);
  assert.ok(Math.abs(world.poses()[0] - (2.25 - 0.125 * (7 - 0.2 * 9.81))) < 1e-4);
  assert.ok(Math.abs(world.velocities()[0] + 0.5 * (7 - 0.2 * 9.81)) < 1e-3);
  world.setAcceleration([0, 0, 0]);
  world.setForce(0, [0, 100, 0], [world.poses()[0], 1.25, 0]);
  world.advance(1.25);
  assert.ok(Math.abs(world.velocities()[1]) > 0.1);
  world.setForce(0, [0, 0, 0]);
  world.free();
});

test("what cannot be used is an error with a sentence", () => {
  const refused = (work, sentence) =>
    assert.throws(work, (error) => error instanceof EngineError && sentence.test(error.message));
  refused(() => engine.readLayout("header\n0 0 0 1 1 x 0\n", { name: "a.txt" }), /^a\.txt:2:11: /);
  refused(() => engine.readAcceleration("0 1 a 0 0\n", "b.txt"), /^b\.txt:1:5: /);
  refused(() => engine.world({ boxes: oneBox, segments: new Float64Array(0) }), /no segments/);
  refused(
    () => engine.world({ boxes: oneBox, segments: still, config: "[Native]\nAccuracy = perfect\n" }),
    /config:2:12: /,
  );
  refused(
    () => engine.world({ boxes: oneBox, segments: still, settings: [["Native", "Accuracies", "x"]] }),
    /unknown key/,
  );
  refused(
    () => engine.world({ boxes: oneBox, segments: still, settings: [["Screening", "Engine", "bullet"]] }),
    /plug-in/,
  );
  refused(() => engine.screen({ boxes: new Float64Array([0, 0, 0, 9, 1, 1, 0]), segments: still }), /outside/);
  const world = engine.world({ boxes: oneBox, segments: still });
  refused(() => world.setForce(1, [1, 0, 0]), /no such box: 1/);
  refused(() => world.setAcceleration([NaN, 0, 0]), /cannot be used/);
  refused(() => world.sideForces(), /WallForces/);
  world.free();
  refused(() => world.advance(1), /no such object/);
});

test("a config is read as the program reads it", () => {
  const text =
    "; comment\n[Screening] ; another\nSettleSeconds : 0.5 ; after a value\n  MoveThreshold=0.1\n[Native]\nAccuracy = screening\n";
  const inputs = (given) => ({ boxes: oneBox, segments: new Float64Array([0, 1, 6, 0, 0]), ...given });
  const keys = [
    ["Screening", "SettleSeconds", "0.5"],
    ["Screening", "MoveThreshold", "0.1"],
    ["Native", "Accuracy", "screening"],
  ];
  assert.deepEqual(engine.screen(inputs({ config: text })), engine.screen(inputs({ settings: keys })));
  assert.match(engine.version, /^\d+\.\d+\.\d+$/);
});

test("worlds leave nothing behind", () => {
  const inputs = inputsOf(engine, { layout: layouts[0].name, acceleration: accelerations[0].name });
  const run = () => {
    const world = engine.world(inputs);
    world.advance(0.1);
    world.free();
  };
  for (let i = 0; i < 20; ++i) run();
  const before = engine.wasm.memory.buffer.byteLength;
  for (let i = 0; i < 200; ++i) run();
  assert.equal(engine.wasm.memory.buffer.byteLength, before);
});
