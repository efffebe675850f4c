// How long the page takes to screen loads under the norm of the road, margins included, in headless Chromium:
//   node bench/viewer_screen.mjs LAYOUT ...
//
// Prints the seconds from the press of the button to the last margin, and those that `holdfast screen` takes for the same on
// as many threads. Needs `make viewer-engine viewer` and `make program`.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { launched, namedLayouts, openedPage, root, screened } from "./viewer_page.mjs";

const layouts = namedLayouts("viewer_screen.mjs");
const browser = await launched();
const page = await openedPage(browser, layouts);
const begin = performance.now();
await page.click(".go button.primary");
await screened(page);
const seconds = (performance.now() - begin) / 1000;
console.log(`page: ${seconds.toFixed(1)} s; it says "${await page.innerText(".progress")}"`);
await browser.close();

const folder = mkdtempSync(path.join(tmpdir(), "holdfast-screen-"));
const words = ["screen", "--norm", "road", "--margins", "--no-series", "--quiet", "-o", path.join(folder, "results.h5")];
const before = performance.now();
execFileSync(`${root}/build/release/bin/holdfast`, [...words, "--layouts", ...layouts]);
console.log(`program: ${((performance.now() - before) / 1000).toFixed(1)} s`);
rmSync(folder, { recursive: true });
