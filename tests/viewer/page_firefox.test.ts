import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { test } from "node:test";
import { Firefox, whyNoDisplay, whyNoFirefox } from "./firefox";
import { ENGINE, PAGE } from "./places";
import { papersOf } from "./printed_paper";
import { palletRows, xlsxOf } from "./spreadsheets";

const noEngine = existsSync(ENGINE) ? false : "make viewer-engine has not built the engine";
/** As WebDriver codes it. */
const CONTROL = "\uE009";

/** Drops a spreadsheet on the page, takes the container that it advises, and screens under the norm of the road. */
async function screened(page: Firefox): Promise<void> {
  const bytes = Buffer.from(xlsxOf({ Pallets: palletRows() })).toString("base64");
  await page.evaluate(`fetch("data:;base64,${bytes}").then((answer) => answer.blob()).then((blob) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([blob], "pallets.xlsx"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  })`);
  await page.until(`document.querySelector("main.setup:not([aria-busy]) .file button.advice")`);
  assert.match(await page.text(".file"), /pallets\.xlsx\s+spreadsheet, 1 load, 20 boxes/);
  await page.click(".file button.advice");
  await page.until(`document.querySelector(".go button.primary:not([disabled])")`);
  await page.click(".go button.primary");
  await page.until(`/ in \\d/.test(document.querySelector(".progress")?.textContent)`);
  assert.match(await page.text(".progress"), /^4 worlds, margins of 1 load in/);
}

/** Asks the page to print, and checks what the printer gets: one sheet of paper with the load. */
async function printed(page: Firefox): Promise<void> {
  await page.evaluate("void (window.print = () => { window.asked = true; })");
  await page.press(CONTROL, "p");
  await page.until("window.asked");
  const sheet = await page.evaluate<string>(`document.querySelector(".report").textContent`);
  assert.match(sheet, /^pallets\.xlsx20 boxes of 10850 kg, .*; fails under 1 of 4 accelerations\./);
  assert.match(
    sheet,
    /from the rear.*from the front.*road-front-0g8front 0\.8 gmovedbox 19, Tinned food 19, 0\.\d\d s/,
  );
  assert.equal(papersOf(await page.print()), 1);
}

test("in Firefox, a spreadsheet is dropped and screened, a world is opened, and its load is printed", {
  skip: noEngine || whyNoFirefox || whyNoDisplay,
}, async () => {
  const page = await Firefox.open(`file://${PAGE}`, true);
  try {
    await screened(page);
    await page.press("n");
    await page.until(`document.querySelector("#app:not([aria-busy]) > main.world")`);
    assert.match(await page.text(".panel .top"), /moved[\s\S]*Of 20 boxes 2 moved\.[\s\S]*State hash [0-9a-f]{16}/);
    await printed(page);
    assert.deepEqual(page.faults, []);
  } finally {
    await page.close();
  }
});

test("without WebGL, in Firefox, the page says why it shows no world, and prints its load all the same", {
  skip: noEngine || whyNoFirefox,
}, async () => {
  const page = await Firefox.open(`file://${PAGE}`, false);
  try {
    await screened(page);
    await page.press("n");
    await page.until(`document.querySelector("header").textContent.includes("WebGL is switched off in this browser")`);
    await printed(page);
    assert.deepEqual(
      page.faults.filter((fault) => !fault.includes("WebGL")),
      [],
    );
  } finally {
    await page.close();
  }
});
