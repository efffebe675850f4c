import { createRequire } from "node:module";
import type { Browser, Page } from "playwright-core";
import { PACKAGES, PAGE, RESULTS } from "./places";

const { chromium }: typeof import("playwright-core") = createRequire(PACKAGES)("playwright-core");

let browser: Browser | undefined;

/** A page in Debian's Chromium, with WebGL in software; an error of the script ends the test, and so does any request that it makes. */
export async function openPage(
  options: { file?: string; width?: number; height?: number; dark?: boolean; address?: string } = {},
) {
  browser ??= await chromium.launch({
    executablePath: process.env.HOLDFAST_BROWSER ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const page = await browser.newPage({
    viewport: { width: options.width ?? 1440, height: options.height ?? 900 },
    colorScheme: options.dark ? "dark" : "light",
  });
  page.on("pageerror", (error) => {
    throw error;
  });
  const address = options.address ?? `file://${PAGE}`;
  page.on("request", (request) => {
    const { protocol, origin } = new URL(request.url());
    const served = protocol === "http:" && origin === new URL(address).origin;
    if (!["data:", "blob:"].includes(protocol) && !served && request.url().split("#")[0] !== address.split("#")[0])
      throw new Error(`the page asks for ${request.url()}`);
  });
  await page.goto(address);
  if (options.file) await choose(page, options.file);
  return page;
}

/** Opens a file of the tests, and waits until the page shows it or says why not. */
export async function choose(page: Page, file: string): Promise<void> {
  await page.setInputFiles('input[aria-label="Files"]', file.startsWith("/") ? file : `${RESULTS}/${file}`);
  await page.waitForSelector("#app:not([aria-busy]) > main:not(.landing), #app:not([aria-busy]) .problem");
}

export async function closeBrowser(): Promise<void> {
  await browser?.close();
  browser = undefined;
}
