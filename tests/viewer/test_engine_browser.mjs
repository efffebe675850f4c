// The engine in a worker of a page that is opened from a file, in headless Chromium: the bits of the program.
//   node --test tests/viewer/test_engine_browser.mjs      after `make viewer-engine` and `make program`
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { accelerations, config, ENGINE, layouts, root, screenedByProgram, settings } from "./engine_worlds.mjs";

const { chromium } = createRequire(path.join(root, "viewer/package.json"))("playwright-core");
const BROWSER = process.env.HOLDFAST_BROWSER ?? "/usr/bin/chromium";

/** Runs in the worker, behind the engine's module. */
async function screenAll({ worlds, layouts, accelerations, config, settings }) {
  const engine = await loadEngine();
  const textOf = (all, name) => all.find((one) => one.name === name).text;
  return worlds.map(({ layout, acceleration }) => {
    const boxes = engine.readLayout(textOf(layouts, layout), { config, settings });
    const segments = engine.readAcceleration(textOf(accelerations, acceleration));
    return engine.screen({ boxes, segments, config, settings }).stateHash;
  });
}

/** A page that shows what its worker makes of the inputs. */
function page(inputs) {
  // On file:// a worker cannot be a module: as a bundler does, the engine becomes a script.
  const worker = `${readFileSync(ENGINE, "utf8").replaceAll(/^export /gm, "")}
${screenAll}
onmessage = ({ data }) => screenAll(data).then(postMessage, (error) => postMessage(String(error)));`;
  const text = (value) => JSON.stringify(value).replaceAll("</", "<\\/");
  return `<!doctype html><meta charset="utf-8"><pre id="hashes">nothing yet</pre><script>
const worker = new Worker(URL.createObjectURL(new Blob([${text(worker)}], { type: "text/javascript" })));
const show = (value) => {
  const place = document.getElementById("hashes");
  place.textContent = JSON.stringify(value);
  place.className = "here";
};
worker.onmessage = ({ data }) => show(data);
worker.onerror = (error) => show(error.message);
worker.postMessage(${text(inputs)});
</script>`;
}

test("in a browser every bundled layout ends in the bits of the program", async (t) => {
  const worlds = screenedByProgram();
  const folder = mkdtempSync(path.join(tmpdir(), "holdfast-browser-"));
  const browser = await chromium.launch({ executablePath: BROWSER, args: ["--no-sandbox", "--disable-gpu"] });
  try {
    const file = path.join(folder, "engine.html");
    writeFileSync(file, page({ worlds, layouts, accelerations, config, settings }));
    const tab = await browser.newPage();
    await tab.goto(`file://${file}`);
    await tab.waitForSelector("#hashes.here", { timeout: 600000 });
    const shown = JSON.parse(await tab.textContent("#hashes"));
    assert.deepEqual(
      shown,
      worlds.map((world) => world.state_hash),
    );
    t.diagnostic(`${shown.length} state hashes compared in ${browser.version()}`);
  } finally {
    await browser.close();
    rmSync(folder, { recursive: true });
  }
});
