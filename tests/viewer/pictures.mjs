// Takes the pictures of docs/guide/viewer.md and README: node tests/viewer/pictures.mjs RESULTS FOLDER [live | screen]
//
// With `live` only those of a live world are taken, with `screen` those of loads that the page screens; both need the engine in the page, `make viewer-engine viewer`.
// RESULTS is a file with series, whose fleet is shown: in docs/ the layouts of configs/layouts and bench/layouts under the norm of the
// road, with margins and wall forces. The film is of one of its worlds, and needs img2webp, of Debian's package webp. Other pictures
// of worlds are of files in build/viewer/results, with which the tests compare them: tests/viewer/results.mjs makes these.
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), "../..");
const { chromium } = createRequire(`${root}/viewer/package.json`)("playwright-core");
const [results, folder] = process.argv.slice(2, 4).map((argument) => path.resolve(argument));
const liveOnly = process.argv[4] === "live";
const screenOnly = process.argv[4] === "screen";
if (!folder) throw new Error("usage: node tests/viewer/pictures.mjs RESULTS FOLDER");
mkdirSync(folder, { recursive: true });

const browser = await chromium.launch({
  executablePath: process.env.HOLDFAST_BROWSER ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});

const made = (name) => `${root}/build/viewer/results/${name}`;

async function open(colorScheme, file, width = 1440, height = 900) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme });
  await page.goto(`file://${root}/build/viewer/viewer.html`);
  await page.setInputFiles('input[aria-label="Files"]', file);
  await page.waitForSelector("#app:not([aria-busy]) > main.fleet");
  return page;
}

async function show(page, hash) {
  await page.evaluate((address) => {
    location.hash = address;
  }, hash);
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await settled(page);
}

const settled = (page) =>
  page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 200)))),
  );

async function save(page, name) {
  await settled(page);
  const png = path.join(folder, `${name}.png`);
  await page.screenshot({ path: png });
  console.log(`${png}: ${(statSync(png).size / 1e3).toFixed(0)} kB`);
}

/** The world of a layout under an acceleration: the first whose names contain both. */
async function worldOf(page, layout, acceleration) {
  await page.fill("input[type=search]", layout);
  await page.focus(".matrix");
  await page.keyboard.press("Home");
  for (let column = 0; column < 20; ++column) {
    const detail = await page.innerText(".detail");
    if (detail.includes(layout) && detail.includes(acceleration)) break;
    await page.keyboard.press("ArrowRight");
  }
  await page.keyboard.press("Enter");
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  return page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get("world"));
}

/** Loads of a spreadsheet that are set, screened and mended in the page. */
async function screen(scheme) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, colorScheme: scheme });
  await page.goto(`file://${root}/build/viewer/viewer.html`);
  await page.setInputFiles('input[aria-label="Files"]', `${root}/configs/loads/trailer.csv`);
  await page.waitForSelector("main.setup:not([aria-busy])");
  await page.selectOption(".choices label:has-text('on the floor') select", "timber-steel");
  await page.waitForSelector("main.setup:not([aria-busy]) .go button.primary:not([disabled])");
  await save(page, `setup-${scheme}`);
  await page.click(".go button.primary");
  await page.waitForFunction(() => / in \d/.test(document.querySelector(".progress")?.textContent ?? ""));
  await show(page, "world=2&time=1.2&box=19&mend=1");
  await page.click(".mend button:text-is('What would help?')");
  await page.waitForFunction(
    () => document.querySelector(".remedies li") && !/Trying/.test(document.querySelector(".mend").innerText),
  );
  await save(page, `mend-${scheme}`);
  await page.close();
}

for (const scheme of ["light", "dark"]) {
  if (!liveOnly && scheme === "light") await screen(scheme);
  if (screenOnly) continue;
  if (!liveOnly) {
    const fleet = await open(scheme, results);
    await fleet.hover(".matrix", { position: { x: 360, y: 100 } });
    await save(fleet, `fleet-${scheme}`);
    await fleet.close();
  }
  const page = await open(scheme, made("demo.h5"));
  const world = await worldOf(page, "BR15_077_ep", "front");
  await live(page, world, scheme);
  if (liveOnly) {
    await page.close();
    continue;
  }
  await show(page, `world=${world}&time=1.2&ghost=1&box=60`);
  await page.keyboard.press("1");
  await save(page, `world-${scheme}`);
  if (scheme === "light") {
    await show(page, `world=${world}&time=1.6&colouring=displacement&exploded=0.35`);
    await save(page, "apart-light");
    await show(page, `world=${world}&time=1.2`);
    await page.keyboard.press("x");
    await page.waitForSelector(".scene + .scene");
    await save(page, "compare-light");
  }
  await page.close();
}
if (!liveOnly && !screenOnly) {
  const trailer = await open("light", made("open.h5"));
  await show(trailer, `world=${await worldOf(trailer, "BR8_009_layer", "rear")}&time=2.2`);
  await trailer.keyboard.press("1");
  await save(trailer, "open-light");
  await trailer.close();
  const page = await open("light", results);
  const world = await worldOf(page, "BR8_009_layer", "front");
  await show(page, `world=${world}&time=0`);
  await film(page);
}
await browser.close();

/** In the light, a load that is driven and pulled at; in the dark, a replay. */
async function live(page, world, scheme) {
  await show(page, `world=${world}`);
  await page.keyboard.press("l");
  await page.waitForSelector("#app:not([aria-busy]) > main.live");
  await settled(page);
  if (scheme === "light") await pull(page);
  else {
    await page.keyboard.press("b");
    await page.waitForSelector(".bits.same", { timeout: 120_000 });
  }
  await save(page, `live-${scheme}`);
  await page.mouse.up();
  await page.keyboard.press("l");
  await page.waitForSelector("#app:not([aria-busy]) > main.world:not(.live)");
  await settled(page);
}

/** Brakes for a second, and pulls a box on top to the front. */
async function pull(page) {
  await page.keyboard.press("0");
  for (let press = 0; press < 6; ++press) await page.keyboard.press("ArrowLeft");
  await page.keyboard.press(" ");
  await page.waitForFunction(() => Number.parseFloat(document.querySelector(".readout").textContent) >= 0.8);
  await page.keyboard.press("0");
  const scene = await page.locator(".scene canvas").boundingBox();
  const at = { x: scene.x + 0.76 * scene.width, y: scene.y + 0.48 * scene.height };
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x - 190, at.y - 40, { steps: 4 });
  await page.waitForTimeout(1500);
}

/** The load while it is braked, from the right and the door, without the page around it, as an animated WebP. */
async function film(page) {
  const frames = mkdtempSync(path.join(tmpdir(), "film-"));
  const files = [];
  await page.setViewportSize({ width: 1100, height: 760 });
  await page.addStyleTag({ content: "aside, .time, .options, header, .views { display: none !important; }" });
  await settled(page);
  await page.keyboard.press("3");
  await page.waitForTimeout(1000);
  await page.mouse.move(550, 60);
  await page.mouse.down();
  await page.mouse.move(620, 95, { steps: 4 });
  await page.mouse.up();
  await page.mouse.wheel(0, 120);
  await page.waitForTimeout(1000);
  for (let frame = 0; frame <= 46; ++frame) {
    const time = 0.3 + 0.04 * frame;
    await page.evaluate((at) => {
      location.hash = `${location.hash.replace(/&?time=[^&]*/, "")}&time=${at}`;
    }, time.toFixed(2));
    await settled(page);
    const file = path.join(frames, `${String(frame).padStart(3, "0")}.png`);
    writeFileSync(file, await page.screenshot());
    files.push(file);
  }
  const webp = path.join(folder, "braking.webp");
  const pause = files.flatMap((file, index) => ["-d", index + 1 === files.length ? "1500" : "50", file]);
  const made = spawnSync("img2webp", ["-loop", "0", "-lossy", "-q", "70", ...pause, "-o", webp], { stdio: "inherit" });
  if (made.status !== 0) throw new Error("img2webp is missing, or failed");
  console.log(`${webp}: ${(statSync(webp).size / 1e3).toFixed(0)} kB`);
  rmSync(frames, { recursive: true });
}
