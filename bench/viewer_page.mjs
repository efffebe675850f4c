// What the measurements of the page share: files named on the command line, and headless Chromium.
import { createRequire } from "node:module";
import path from "node:path";

export const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), "..");
const { chromium } = createRequire(`${root}/viewer/package.json`)("playwright-core");

/** Absolute paths of the layouts that the command line names. */
export function namedLayouts(script) {
  const layouts = process.argv.slice(2).map((file) => path.resolve(file));
  if (layouts.length === 0) throw new Error(`usage: node bench/${script} LAYOUT ...`);
  return layouts;
}

export const launched = () =>
  chromium.launch({
    executablePath: process.env.HOLDFAST_BROWSER ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });

/** The page in a window of its own, as it is built, with files dropped on it; nothing is screened yet. */
export async function openedPage(browser, files) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  await page.goto(`file://${root}/build/viewer/viewer.html`);
  await page.setInputFiles('input[aria-label="Files"]', files);
  await page.waitForSelector(".go button.primary:not([disabled])");
  return page;
}

/** Waits until all worlds and margins are there. */
export const screened = (page) =>
  page.waitForFunction(() => / in \d/.test(document.querySelector(".progress")?.textContent ?? ""), undefined, { timeout: 0 });
