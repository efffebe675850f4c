// How fast live worlds of the page go, in headless Chromium: node bench/viewer_live.mjs RESULTS [LAYOUT ...]
//
// RESULTS is a results file; each layout that is named (all when none is) runs under each acceleration at `screening`, as fast as
// the page lets it, four times real time. A load that is unstable is not accelerated, and is left out. Needs `make viewer-engine
// viewer`. WebGL is in software, which takes time from the engine.
import path from "node:path";
import { launched, root } from "./viewer_page.mjs";

const [results, ...layouts] = process.argv.slice(2);
if (!results) throw new Error("usage: node bench/viewer_live.mjs RESULTS [LAYOUT ...]");

const browser = await launched();
const page = await browser.newPage({ viewport: { width: 1000, height: 640 } });
await page.goto(`file://${root}/build/viewer/viewer.html`);
await page.setInputFiles('input[aria-label="Files"]', path.resolve(results));
await page.waitForSelector("#app:not([aria-busy]) > main.fleet");

const speed = () => page.innerText(".speed");
const says = (words) =>
  page.waitForFunction((source) => new RegExp(source).test(document.querySelector(".speed")?.textContent ?? ""), words, {
    timeout: 120_000,
    polling: 10,
  });
const leave = async () => {
  await page.keyboard.press("Escape");
  await page.waitForSelector("#app:not([aria-busy]) > main.world:not(.live)");
};
console.log("layout\tacceleration\tboxes\ttimes real time\tengine alone");
for (let world = 0; ; ++world) {
  await page.evaluate((index) => {
    location.hash = `world=${index}`;
  }, world);
  await page.waitForTimeout(200);
  await page.waitForSelector("#app:not([aria-busy])");
  if ((await page.$("main.world")) === null) break;
  const name = await page.innerText(".crumb");
  if (layouts.length > 0 && !layouts.some((layout) => name.includes(layout))) continue;
  await page.keyboard.press("l");
  await page.waitForSelector("#app:not([aria-busy]) > main.live");
  await page.selectOption(".drive select", "screening");
  await says("Stands at the start|not accelerated");
  if ((await speed()).includes("not accelerated")) {
    await leave();
    continue;
  }
  await page.waitForTimeout(500);
  await page.selectOption(".player select", "4");
  await page.evaluate(() => document.activeElement.blur());
  const began = performance.now();
  await page.keyboard.press(" ");
  await says("Paused at");
  const seconds = (performance.now() - began) / 1000;
  const said = await speed();
  const [, time] = /Paused at ([\d.]+) s/.exec(said);
  const [, alone] = /alone does ([\d.]+)/.exec(said);
  const boxes = await page.$$eval(".rows", ([rows]) => Math.round(rows.clientHeight / 24));
  console.log([...name.split(" · "), boxes, (Number(time) / seconds).toFixed(1), alone].join("\t"));
  await leave();
}
await browser.close();
