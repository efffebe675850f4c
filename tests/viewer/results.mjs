// Makes the results files that the tests of the page read: node tests/viewer/results.mjs PROGRAM FOLDER
import { spawn, spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), "../..");
const [program, folder] = process.argv.slice(2).map((argument) => path.resolve(argument));
const at = (name) => path.join(folder, name);
const layouts = ["seed_example", "BR15_077_ep", "BR8_009_ep", "unstable_BR2_007_bpjs"].map(
  (name) => `${root}/configs/layouts/${name}.txt`,
);

function screen(output, ...options) {
  const words = ["screen", "--quiet", "-c", `${root}/configs/demo.ini`, "-o", at(output), "--overwrite", ...options];
  const { status } = spawnSync(program, words, { stdio: "inherit" });
  if (status !== 0) throw new Error(`holdfast ${words.join(" ")} ended with ${status}`);
}

/** A part of a run that is killed when its first part is there. */
async function unfinished() {
  const parts = `${at("killed.h5")}.parts`;
  rmSync(parts, { recursive: true, force: true });
  const words = ["screen", "--quiet", "-c", `${root}/configs/demo.ini`, "--layouts", `${root}/configs/layouts`];
  const run = spawn(program, [...words, "--norm", "road", "--threads", "1", "-o", at("killed.h5"), "--overwrite"]);
  const ended = new Promise((resolve) => run.on("exit", resolve));
  while (run.exitCode === null && !existsSync(`${parts}/part-000001.h5`)) await new Promise((go) => setTimeout(go, 20));
  run.kill("SIGKILL");
  await ended;
  copyFileSync(`${parts}/part-000001.h5`, at("part.h5"));
  rmSync(parts, { recursive: true, force: true });
}

async function foreign() {
  const hdf5 = await import(`${root}/viewer/node_modules/h5wasm/dist/node/hdf5_hl.js`);
  await hdf5.ready;
  const file = new hdf5.File(at("foreign.h5"), "w");
  file.create_dataset({ name: "temperature", data: new Float64Array([1, 2, 3]) });
  file.close();
}

mkdirSync(folder, { recursive: true });
screen("demo.h5", "--layouts", ...layouts, "--norm", "road");
const analyses = ["--margins", "--walls", "en12642-xl", "--replicas", "27"];
screen("rich.h5", "--layouts", ...layouts.slice(0, 2), "--norm", "road", ...analyses);
screen("no-series.h5", "--layouts", ...layouts, "--norm", "road", "--no-series");
const { status } = spawnSync(program, ["view", at("demo.h5"), "--no-open", "-o", at("demo.html")], {
  stdio: "inherit",
});
if (status !== 0) throw new Error(`holdfast view ended with ${status}`);
const whole = readFileSync(at("demo.h5"));
writeFileSync(at("truncated.h5"), whole.subarray(0, whole.length / 2));
writeFileSync(at("text.h5"), "This is no HDF5 file.\n".repeat(100));
await foreign();
await unfinished();
