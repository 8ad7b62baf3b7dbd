/** Serves `dist/` on the loopback, the module packed as a server would, and drives the page in Debian's Chromium. */
import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname } from "node:path";
import { type Browser, type BrowserContextOptions, chromium, type Page } from "playwright-core";

/** The command that the page is compared with. */
export const selfosc = process.env.SELFOSC_COMMAND ?? new URL("../../target/release/selfosc", import.meta.url).pathname;

const dist = new URL("../dist/", import.meta.url).pathname;
const TYPES: Record<string, string> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
  ".csv": "text/csv",
  ".webmanifest": "application/manifest+json",
};

export interface Served {
  url: string;
  browser: Browser;
  /** The next request of the module gets one that is none. */
  breakModule(): void;
  open(options?: BrowserContextOptions): Promise<{ page: Page; foreign: string[]; faults: string[] }>;
  close(): Promise<void>;
}

export async function serve(): Promise<Served> {
  let broken = false;
  const server = createServer((request, response) => {
    const path = decodeURI(new URL(request.url ?? "/", "http://localhost").pathname);
    const file = dist + (path === "/" ? "index.html" : path.slice(1));
    if (path.includes("..") || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    if (broken && path === "/selfosc.wasm") {
      broken = false;
      response.writeHead(200, { "content-type": "application/wasm", "cache-control": "no-store" }).end("\0asm");
      return;
    }
    const packed = existsSync(`${file}.br`);
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", ...(packed && { "content-encoding": "br" }) });
    createReadStream(packed ? `${file}.br` : file).pipe(response);
  });
  await new Promise<void>((listening) => server.listen(0, "127.0.0.1", listening));
  const url = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  return {
    url,
    browser,
    breakModule: () => void (broken = true),
    async open(options) {
      const context = await browser.newContext(options);
      const page = await context.newPage();
      const foreign: string[] = [];
      const faults: string[] = [];
      page.on("request", (request) => {
        if (!request.url().startsWith(url) && !request.url().startsWith("blob:" + url)) foreign.push(request.url());
      });
      page.on("pageerror", (error) => faults.push(String(error)));
      page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
      page.on("dialog", (dialog) => (faults.push(`dialog: ${dialog.message()}`), void dialog.dismiss()));
      await page.goto(url);
      return { page, foreign, faults };
    },
    async close() {
      await browser.close();
      server.close();
    },
  };
}

/** Waits for the run under way to end. */
export async function ended(page: Page, timeout = 60_000): Promise<void> {
  await page.waitForFunction(() => document.getElementById("busy")!.hidden && document.getElementById("results")!.childElementCount > 0, null, { timeout });
}

/** Gives the page files as a person does. */
export async function give(page: Page, files: { name: string; buffer: Buffer }[], timeout?: number): Promise<void> {
  await page.evaluate(() => document.getElementById("results")!.replaceChildren());
  await page.setInputFiles("#file", files.map(({ name, buffer }) => ({ name, mimeType: "text/csv", buffer })));
  await ended(page, timeout);
}

export async function job(page: Page, name: string): Promise<void> {
  await page.check(`nav input[value=${name}]`);
}
