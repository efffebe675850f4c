import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";
import { PROGRAM, RESULTS } from "./places";

after(closeBrowser);

/** What a page asks the printer for: the text of each sheet, labels in drawings, and the number of sheets of paper. */
async function printed(
  page: Page,
  ask: () => Promise<void>,
): Promise<{ sheets: string[]; labels: string[]; papers: number }> {
  await page.evaluate(() => {
    Object.assign(window, { asked: 0, print: () => Object.assign(window, { asked: 1 }) });
  });
  await ask();
  await page.waitForFunction(() => (window as unknown as { asked: number }).asked > 0);
  const sheets = await page.$$eval(".report section", (all) => all.map((section) => section.textContent ?? ""));
  const labels = await page.$$eval(".report svg text", (all) => all.map((label) => label.textContent ?? ""));
  const pdf = await page.pdf({ preferCSSPageSize: true });
  const papers = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g)?.length ?? 0;
  return { sheets, labels, papers };
}

async function open(page: Page, hash: string): Promise<void> {
  await page.evaluate((to) => {
    location.hash = to;
  }, hash);
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
}

test("a load that fails has one page: what it is, what it stands, what goes first", async () => {
  const page = await openPage({ file: "rich.h5", dark: true });
  await open(page, "world=5");
  const first = /Box (\d+)/.exec(await page.innerText(".panel .link"))?.[1];
  const { sheets, papers } = await printed(page, () => page.keyboard.press("Control+p"));
  assert.equal(sheets.length, 1);
  assert.equal(papers, 1);
  const [text] = sheets;
  assert.match(text, /^BR15_077_ep\.txt81 boxes of \d+ kg, 67 % of the container's volume; fails under 4 of 4/);
  assert.match(text, /container5\.87 × 2\.33 × 2\.20 m/);
  assert.match(
    text,
    /It may lie from 2\.64 m to 3\.23 m from the front wall \(CTU Code 2014, Annex 7, 3\.1\.4\): it does\./,
  );
  assert.match(text, /road: EN 12195-1, road; Directive 2014\/47\/EU, Annex III/);
  assert.match(text, /friction.*box on box 0\.5/);
  assert.match(
    text,
    new RegExp(`road-front-0g8front 0.8 gfellbox ${first}, 0.\\d\\d s`),
    "the box that the page names",
  );
  assert.match(text, /pushed toin placewithin limitsneededgoes first above/);
  assert.match(text, /Force on the walls, limits of en12642-xl/);
  assert.match(text, /holdfast \d+\.\d+\.\d+\S*, native standard/);
  assert.match(text, /Hashes of the ends: road-front-0g8 [0-9a-f]{16}, /);
  // The paper is white, whatever the page is.
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
  assert.equal(await page.isVisible("#app"), false);
  await page.close();
});

test("all loads that the matrix shows are printed, also those that hold, and names stand in the drawings", async () => {
  const page = await openPage({ file: "loads.h5" });
  const { sheets, labels, papers } = await printed(page, () => page.click("header button:text-is('Print')"));
  assert.equal(sheets.length, 5, "a page before those of the four loads");
  assert.equal(papers, 5, "one page per load");
  assert.match(sheets[0], /^loads\.h5\d of 4 loads do not hold\./);
  const trailer = sheets.find((text) => text.startsWith("trailer.csv")) ?? "";
  assert.match(trailer, /trailer-curtain, 13\.60 × 2\.48 × 2\.70 m; left, right open/);
  assert.match(trailer, /Axle loads are not calculated\./);
  assert.match(trailer, /What is loaded.*Paper280 × 120 × 160840 to 855 kg1695 kg/);
  assert.ok(labels.includes("Pump"), labels.join());
  await page.close();
});

test("the page is that of the program's report: its tables, their columns and their numbers", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "holdfast-report-"));
  const file = path.join(folder, "report.html");
  try {
    execFileSync(PROGRAM, ["report", `${RESULTS}/rich.h5`, "-o", file]);
    const report = await openPage({ address: `file://${file}` });
    const page = await openPage({ file: "rich.h5" });
    await open(page, "world=5");
    await page.evaluate(() => {
      window.print = () => {};
    });
    await page.keyboard.press("Control+p");
    await page.waitForSelector(".report section", { state: "attached" });
    const told = (from: Page) =>
      from.evaluate(() => {
        const section = [...document.querySelectorAll(".report section")].find((one) =>
          /^BR15/.test(one.textContent ?? ""),
        );
        const rows = [...(section?.querySelectorAll("h3, tr") ?? [])];
        return rows.map((row) => [...(row.matches("h3") ? [row] : row.children)].map((cell) => cell.textContent ?? ""));
      });
    const [a, b] = [await told(report), await told(page)];
    const alike = (rows: string[][]) =>
      // The program also says what the replicas mean, has more digits of sizes, and another dash.
      rows.map((row) => row.map((cell) => cell.replace("fails: ", "").replace("2.20 m", "2.2 m").replace(/^-$/, "–")));
    assert.deepEqual(alike(b), alike(a));
    assert.ok(a.length > 25, `${a.length} rows`);
    await report.close();
    await page.close();
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("a load that holds has its page", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.fill("input[type=search]", "BR8_009");
  const { sheets, papers } = await printed(page, () => page.keyboard.press("Control+p"));
  assert.equal(sheets.length, 1, "what is filtered out is not printed");
  assert.equal(papers, 1);
  assert.match(sheets[0], /^BR8_009_ep\.txt.*; (holds under all 4|fails under \d of 4) accelerations\./);
  await page.close();
});

test("the browser's menu prints the overview", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.match((await page.textContent(".report")) ?? "", /demo\.h5.*of 4 loads do not hold.*seed_example\.txt/s);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await page.textContent(".report"), "");
  await page.close();
});
