import { type ChildProcess, spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import type { Readable } from "node:stream";
import type { WebSocket } from "ws";
import { PACKAGES } from "./places";

const { WebSocket: Socket }: typeof import("ws") = createRequire(PACKAGES)("ws");

const PROGRAM = process.env.HOLDFAST_FIREFOX ?? "/usr/bin/firefox-esr";
const DISPLAY = "/usr/bin/Xvfb";
/** Milliseconds. */
const LONGEST_START = 60_000;
const LONGEST_WAIT = 60_000;

const whyNot = (program: string, debian: string) =>
  existsSync(program) ? false : `${program} is not installed: apt-get install ${debian}`;
/** Why there is no Firefox to test with; false: there is one. */
export const whyNoFirefox = whyNot(PROGRAM, "firefox-esr");
/** Why it would have no WebGL, for which it needs a display; false: it has. */
export const whyNoDisplay = whyNot(DISPLAY, "xvfb");

/** The first text like this that a program writes. */
function told(stream: Readable, pattern: RegExp): Promise<string> {
  return new Promise((found, fail) => {
    let text = "";
    setTimeout(() => fail(new Error(`nothing like ${pattern} in: ${text}`)), LONGEST_START).unref();
    stream.on("data", (part) => {
      text += part;
      const match = pattern.exec(text);
      if (match) found(match[1]);
    });
  });
}

/** An answer to a command, or an event. */
interface Message {
  id?: number;
  type: string;
  method?: string;
  params?: Record<string, unknown>;
  result?: Record<string, unknown>;
  message?: string;
}

/** A page in Debian's Firefox, driven by WebDriver BiDi (www.w3.org/TR/webdriver-bidi), which Firefox speaks itself. */
export class Firefox {
  private readonly waiting = new Map<
    number,
    { done: (result: Message["result"]) => void; fail: (why: Error) => void }
  >();
  private commands = 0;
  private context = "";
  /** What the page did that it may not: errors of its script, and requests to anybody. */
  readonly faults: string[] = [];

  private constructor(
    /** Firefox, and what it draws on. */
    private readonly processes: ChildProcess[],
    private readonly profile: string,
    private readonly socket: WebSocket,
    private readonly address: string,
  ) {
    socket.on("message", (data) => this.take(JSON.parse(String(data))));
  }

  /** @param webgl on a display that nobody sees, since it draws without one in two dimensions alone */
  static async open(address: string, webgl: boolean): Promise<Firefox> {
    const profile = mkdtempSync(path.join(tmpdir(), "holdfast-firefox-"));
    // In software: it does not trust drivers that it does not know.
    writeFileSync(path.join(profile, "user.js"), 'user_pref("webgl.force-enabled", true);\n');
    const processes: ChildProcess[] = [];
    const environment = { ...process.env };
    if (webgl) {
      const screen = ["-screen", "0", "1600x1000x24", "-nolisten", "tcp", "-displayfd", "1"];
      const display = spawn(DISPLAY, screen, { stdio: ["ignore", "pipe", "ignore"] });
      processes.push(display);
      environment.DISPLAY = `:${await told(display.stdout, /(\d+)\n/)}`;
    }
    const words = ["--no-remote", "--profile", profile, "--remote-debugging-port", "0"];
    const firefox = spawn(PROGRAM, webgl ? words : ["--headless", ...words], {
      env: environment,
      stdio: ["ignore", "ignore", "pipe"],
    });
    processes.unshift(firefox);
    const server = await told(firefox.stderr, /WebDriver BiDi listening on (ws:\S+)/);
    const socket = new Socket(`${server}/session`);
    await new Promise((opened, failed) => socket.on("open", opened).on("error", failed));
    const page = new Firefox(processes, profile, socket, address);
    await page.command("session.new", { capabilities: {} });
    const { contexts } = (await page.command("browsingContext.getTree", {})) as { contexts: { context: string }[] };
    page.context = contexts[0].context;
    const { context } = page;
    await page.command("session.subscribe", { events: ["log.entryAdded", "network.beforeRequestSent"] });
    await page.command("browsingContext.setViewport", { context, viewport: { width: 1440, height: 900 } });
    await page.command("browsingContext.navigate", { context, url: address, wait: "complete" });
    return page;
  }

  /** What an expression is worth in the page, as JSON has it. */
  async evaluate<T>(expression: string): Promise<T> {
    const found = await this.command("script.evaluate", {
      expression: `(async () => JSON.stringify(await (${expression})) ?? "null")()`,
      target: { context: this.context },
      awaitPromise: true,
    });
    const { type, result, exceptionDetails } = found as {
      type: string;
      result?: { value: string };
      exceptionDetails?: { text: string };
    };
    if (type !== "success" || !result) throw new Error(`${expression}: ${exceptionDetails?.text}`);
    return JSON.parse(result.value);
  }

  /** Waits until an expression is true. */
  async until(expression: string): Promise<void> {
    const end = Date.now() + LONGEST_WAIT;
    while (!(await this.evaluate(`Boolean(${expression})`))) {
      if (Date.now() > end) throw new Error(`it does not come true: ${expression}`);
      await new Promise((go) => setTimeout(go, 50));
    }
  }

  text = (selector: string) => this.evaluate<string>(`document.querySelector(${JSON.stringify(selector)})?.innerText`);

  /** Clicks the middle of what a selector finds first. */
  async click(selector: string): Promise<void> {
    const { context } = this;
    const locator = { type: "css", value: selector };
    const { nodes } = (await this.command("browsingContext.locateNodes", { context, locator, maxNodeCount: 1 })) as {
      nodes: { sharedId: string }[];
    };
    if (nodes.length === 0) throw new Error(`there is no ${selector}`);
    const origin = { type: "element", element: { sharedId: nodes[0].sharedId } };
    const actions = [
      { type: "pointerMove", x: 0, y: 0, origin },
      { type: "pointerDown", button: 0 },
      { type: "pointerUp", button: 0 },
    ];
    await this.command("input.performActions", { context, actions: [{ type: "pointer", id: "mouse", actions }] });
  }

  /** Presses keys at once; special ones as WebDriver codes them. */
  async press(...keys: string[]): Promise<void> {
    const actions = [
      ...keys.map((value) => ({ type: "keyDown", value })),
      ...keys.reverse().map((value) => ({ type: "keyUp", value })),
    ];
    await this.command("input.performActions", {
      context: this.context,
      actions: [{ type: "key", id: "keyboard", actions }],
    });
  }

  /** What a printer would get, as PDF. */
  async print(): Promise<Buffer> {
    const { data } = (await this.command("browsingContext.print", { context: this.context })) as { data: string };
    return Buffer.from(data, "base64");
  }

  async close(): Promise<void> {
    const [firefox, display] = this.processes;
    const ended = new Promise((end) => firefox.on("exit", end));
    await this.command("browser.close", {}).catch(() => firefox.kill());
    await ended;
    display?.kill();
    this.socket.close();
    rmSync(this.profile, { recursive: true, force: true });
  }

  private command(method: string, params: Record<string, unknown>): Promise<Message["result"]> {
    const id = ++this.commands;
    return new Promise((done, fail) => {
      this.waiting.set(id, { done, fail });
      this.socket.send(JSON.stringify({ id, method, params }));
    });
  }

  private take({ id, type, method, params, result, message }: Message): void {
    if (id !== undefined) {
      const waiting = this.waiting.get(id);
      this.waiting.delete(id);
      if (type === "success") waiting?.done(result);
      else waiting?.fail(new Error(message));
    } else if (method === "log.entryAdded" && params?.level === "error") this.faults.push(String(params.text));
    else if (method === "network.beforeRequestSent") {
      const { url } = (params as { request: { url: string } }).request;
      if (!/^(data|blob):/.test(url) && url.split("#")[0] !== this.address)
        this.faults.push(`the page asks for ${url}`);
    }
  }
}
