// How long the page takes to screen loads under the norm of the road, margins included, in headless Chromium:
//   node bench/viewer_screen.mjs LAYOUT ...
//
// Prints the seconds from the press of the button to the last margin, and those that `holdfast screen` takes for the same on
// as many threads. Needs `make viewer-engine viewer` and `make program`.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), "..");
const { chromium } = createRequire(`${root}/viewer/package.json`)("playwright-core");
const layouts = process.argv.slice(2).map((file) => path.resolve(file));
if (layouts.length === 0) throw new Error("usage: node bench/viewer_screen.mjs LAYOUT ...");

const browser = await chromium.launch({
  executablePath: process.env.HOLDFAST_BROWSER ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
await page.goto(`file://${root}/build/viewer/viewer.html`);
await page.setInputFiles('input[aria-label="Files"]', layouts);
await page.waitForSelector(".go button.primary:not([disabled])");
const begin = performance.now();
await page.click(".go button.primary");
await page.waitForFunction(() => / in \d/.test(document.querySelector(".progress")?.textContent ?? ""), undefined, {
  timeout: 0,
});
const seconds = (performance.now() - begin) / 1000;
console.log(`page: ${seconds.toFixed(1)} s; it says "${await page.innerText(".progress")}"`);
await browser.close();

const folder = mkdtempSync(path.join(tmpdir(), "holdfast-screen-"));
const words = ["screen", "--norm", "road", "--margins", "--no-series", "--quiet", "-o", path.join(folder, "results.h5")];
const before = performance.now();
execFileSync(`${root}/build/release/bin/holdfast`, [...words, "--layouts", ...layouts]);
console.log(`program: ${((performance.now() - before) / 1000).toFixed(1)} s`);
rmSync(folder, { recursive: true });
