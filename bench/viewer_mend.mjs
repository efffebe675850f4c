// How long the page takes to answer for a load anew after an edit, under the norm of the road, in headless Chromium:
//   node bench/viewer_mend.mjs LAYOUT ...
//
// Of each load the first box is taken away, and put back. Prints the seconds until the world that is looked at, and until
// all worlds and margins are those of the edited load. Needs `make viewer-engine viewer`.
import { createRequire } from "node:module";
import path from "node:path";

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), "..");
const { chromium } = createRequire(`${root}/viewer/package.json`)("playwright-core");
const layouts = process.argv.slice(2).map((file) => path.resolve(file));
if (layouts.length === 0) throw new Error("usage: node bench/viewer_mend.mjs LAYOUT ...");

const browser = await chromium.launch({
  executablePath: process.env.HOLDFAST_BROWSER ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
for (const layout of layouts) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  await page.goto(`file://${root}/build/viewer/${process.env.PAGE ?? "viewer.html"}`);
  await page.setInputFiles('input[aria-label="Files"]', layout);
  await page.click(".go button.primary:not([disabled])");
  const shown = (condition) => page.waitForFunction(condition, undefined, { timeout: 0, polling: 5 });
  await shown(() => / in \d/.test(document.querySelector(".progress")?.textContent ?? ""));
  await page.focus(".matrix");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await page.evaluate(() => {
    location.hash += "&box=1";
  });
  await page.click("button:text-is('Mend')");
  const answered = () =>
    shown(() => !/…/.test(document.querySelector("#app:not([aria-busy]) .mend:not([aria-busy]) table")?.innerText ?? "…"));
  await answered();
  const said = () => page.innerText(".panel .top");
  const seconds = async (button) => {
    const before = await said();
    const begin = await page.evaluate((button) => {
      const begin = performance.now();
      [...document.querySelectorAll(".mend button")].find(({ textContent }) => textContent === button).click();
      return begin;
    }, button);
    await page.waitForFunction((before) => document.querySelector(".panel .top")?.innerText !== before, before, { polling: 5 });
    const first = await page.evaluate(() => performance.now());
    await answered();
    return [first - begin, (await page.evaluate(() => performance.now())) - begin].map((ms) => (ms / 1000).toFixed(2));
  };
  const edits = [await seconds("Take away"), await seconds("Undo")].map(([world, all]) => `world ${world} s, all ${all} s`);
  console.log(`${path.basename(layout)}: taken away: ${edits[0]}; put back: ${edits[1]}`);
  await page.close();
}
await browser.close();
