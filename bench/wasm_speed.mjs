// Processor time of the engine in WebAssembly over that of the program, in one run: the bundled layouts under the bundled
// accelerations at `screening`, those worlds in which something moves. The program counts its own time, world by world.
//   node bench/wasm_speed.mjs [REPEATS]      after `make viewer-engine` and `make program`
import { ENGINE, inputsOf, screenedByProgram } from "../tests/viewer/engine_worlds.mjs";

const repeats = Number(process.argv[2] ?? 3);
const { loadEngine } = await import(ENGINE);
const begin = performance.now();
const engine = await loadEngine();
const loading = performance.now() - begin;
const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

const ratios = [];
let slowest = { seconds: 0 };
for (let i = 0; i < repeats; ++i) {
  const worlds = screenedByProgram().filter((world) => world.steps > world.steps_skipped);
  let program = 0;
  let wasm = 0;
  for (const world of worlds) {
    const inputs = inputsOf(engine, world);
    const before = process.cpuUsage();
    const { stateHash } = engine.screen(inputs);
    const used = process.cpuUsage(before);
    if (stateHash !== world.state_hash) throw new Error(`${world.layout} under ${world.acceleration}: other bits`);
    const seconds = (used.user + used.system) / 1e6;
    wasm += seconds;
    program += world.cpu_seconds;
    // A world that is unstable has not begun its time.
    if (world.end_time_s > 0 && seconds / world.end_time_s > slowest.seconds) slowest = { ...world, seconds: seconds / world.end_time_s };
  }
  ratios.push(wasm / program);
  console.log(
    `${worlds.length} worlds: program ${program.toFixed(2)} s, WebAssembly ${wasm.toFixed(2)} s, ratio ${ratios[i].toFixed(2)}`,
  );
}
console.log(`median ratio ${median(ratios).toFixed(2)}; compiled in ${loading.toFixed(0)} ms`);
console.log(
  `slowest: ${slowest.layout} under ${slowest.acceleration}, ${slowest.boxes} boxes, ${slowest.seconds.toFixed(2)} s of processor time per simulated second`,
);
