import assert from "node:assert/strict";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";

after(closeBrowser);

/** Answers to everybody, and counts what it is asked. */
async function listening(work: (address: string, asked: string[]) => Promise<void>): Promise<void> {
  const asked: string[] = [];
  const server = createServer((request, answer) => {
    asked.push(request.url ?? "");
    answer.writeHead(200, { "Access-Control-Allow-Origin": "*", "Content-Type": "text/javascript" });
    answer.end();
  });
  await new Promise<void>((ready) => server.listen(0, "127.0.0.1", ready));
  try {
    await work(`http://127.0.0.1:${(server.address() as AddressInfo).port}`, asked);
  } finally {
    server.closeAllConnections();
    server.close();
  }
}

/** Tries each way by which a page can ask another machine for something, in the page and in a worker of it. */
const askEverywhere = (page: Page, address: string) =>
  page.evaluate(async (to) => {
    const ways: Record<string, () => unknown> = {
      fetch: () => fetch(`${to}/fetch`),
      beacon: () => navigator.sendBeacon(`${to}/beacon`, "text"),
      image: () => Object.assign(new Image(), { src: `${to}/image` }),
      socket: () => new WebSocket(`${to.replace("http", "ws")}/socket`),
      style: () =>
        document.head.append(Object.assign(document.createElement("link"), { rel: "stylesheet", href: `${to}/style` })),
      script: () => document.head.append(Object.assign(document.createElement("script"), { src: `${to}/script` })),
      frame: () => document.body.append(Object.assign(document.createElement("iframe"), { src: `${to}/frame` })),
      form: () => {
        const form = Object.assign(document.createElement("form"), { action: `${to}/form`, target: "frame" });
        document.body.append(form);
        form.submit();
      },
      worker: () =>
        new Worker(URL.createObjectURL(new Blob([`importScripts("${to}/imported"); fetch("${to}/worker")`]))),
    };
    for (const way of Object.values(ways))
      await Promise.resolve()
        .then(way)
        .catch(() => {});
    const inline = document.createElement("script");
    inline.textContent = "window.injected = true";
    document.body.append(inline);
    await new Promise((done) => setTimeout(done, 500));
    return "injected" in window;
  }, address);

test("the page can ask nobody for anything, and runs no script but its own", async () => {
  await listening(async (address, asked) => {
    const page = await openPage();
    page.removeAllListeners("request");
    page.removeAllListeners("pageerror");
    assert.equal(await askEverywhere(page, address), false, "a script that is put into the page does not run");
    assert.equal(asked.join(), "");
    // Each of these ways is one that works where nothing forbids it.
    const other = await openPage({ address });
    other.removeAllListeners("request");
    other.removeAllListeners("pageerror");
    asked.splice(0);
    await askEverywhere(other, address);
    for (const way of ["fetch", "beacon", "image", "socket", "style", "script", "frame", "imported", "worker"])
      assert.ok(asked.includes(`/${way}`), `${way} is tried`);
    await page.close();
  });
});

test("a name is text, whatever it says: in the matrix, beside the load, in lists and on paper", async () => {
  const page = await openPage({ file: "hostile.h5" });
  await page.evaluate(() => {
    window.print = () => {};
    location.hash = "world=1";
  });
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await page.focus(".scroller");
  await page.keyboard.press("ArrowDown");
  assert.match(await page.innerText("aside.panel .box"), /<img src=x onerror=|<\/script><script>/i);
  await page.keyboard.press("Control+p");
  await page.waitForSelector(".report section", { state: "attached" });
  assert.match((await page.textContent(".report")) ?? "", /<img src=x onerror=.*<script>/s);
  assert.match((await page.textContent("header")) ?? "", /<script>/);
  const made = await page.evaluate(() => [
    document.querySelectorAll("img, #app script, .report script").length,
    "hacked" in window,
  ]);
  assert.deepEqual(made, [0, false]);
  await page.close();
});
