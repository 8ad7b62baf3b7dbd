/** The page: logs and settings in, the command's answers out. Nothing leaves it. */
import { Command, NoAnswer } from "./command";
import { copyable, download, h } from "./element";
import { Form } from "./form";
import { type Field, type Job, jobs, tune } from "./jobs";
import { loadStep, records } from "./plots";
import type { Answer } from "./protocol";
import { type Autotuned, autotuned, bounded, type Coded, type Identified, identified } from "./results";

type Log = [name: string, bytes: Uint8Array];

const command = new Command();
const byId = (id: string) => document.getElementById(id)!;
const [results, status, formPlace, logList] = ["results", "status", "form", "logs"].map(byId) as [HTMLElement, HTMLElement, HTMLElement, HTMLElement];
const busy = byId("busy");
const samples: [name: string, job: Job["name"], label: string][] = [
  ["heading.csv", "identify", "a vehicle's heading at a pool"],
  ["heater.csv", "autotune", "a heater under a relay"],
];

let job = jobs[0]!;
let logs: Log[] = [];
let form = new Form([], "", () => undefined);

/** The command's reason, without its name. */
const plain = (answer: Answer) => (answer.err.replace(/^selfosc: /, "") || answer.out).trim();

function choose(name: string, settings?: URLSearchParams): void {
  job = jobs.find((one) => one.name === name) ?? jobs[0]!;
  for (const tab of document.querySelectorAll<HTMLInputElement>("nav input")) tab.checked = tab.value === job.name;
  form = new Form(job.fields, job.name, remember);
  if (settings) form.restore(settings);
  byId("drop").hidden = !job.logs;
  const run = h("button", { type: "submit", class: "run" }, job.logs ? "Run again" : "Run");
  const fields = job.logs ? h("details", { open: form.settings.length > 0 }, h("summary", {}, "Settings"), form.element) : form.element;
  formPlace.replaceChildren(h("p", {}, job.about), h("form", { submit: (event) => (event.preventDefault(), void start()) }, fields, h("p", { class: "buttons" }, run, h("button", { type: "button", click: copyLink }, "Copy a link to these settings"))));
  results.replaceChildren();
  status.textContent = "";
  remember();
}

/** The settings stand in the address; the log never does. */
function remember(): void {
  history.replaceState(null, "", "#" + new URLSearchParams([["job", job.name], ...form.settings]).toString());
}

function copyLink(): void {
  remember();
  navigator.clipboard.writeText(location.href).then(
    () => (status.textContent = "The link is copied. It holds the settings, not the log."),
    () => (status.textContent = location.href),
  );
}

/** Runs the command and says how it goes; `null` where there is no answer. */
async function ask(args: string[], files: Log[] = logs): Promise<Answer | null> {
  const began = performance.now();
  let stage = "working";
  const tick = () => (status.textContent = `${stage}, ${((performance.now() - began) / 1000).toFixed(0)} s`);
  const timer = setInterval(tick, 1000);
  busy.hidden = false;
  results.setAttribute("aria-busy", "true");
  status.textContent = "working";
  try {
    const answer = await command.run(args, files, (text) => ((stage = text), tick()));
    status.textContent = `Done in ${((performance.now() - began) / 1000).toFixed(2)} s.`;
    return answer;
  } catch (error) {
    const cancelled = error instanceof NoAnswer && error.reason === "cancelled";
    status.textContent = cancelled ? "Cancelled." : "";
    if (!cancelled) results.replaceChildren(h("p", { class: "verdict doubtful", role: "alert" }, "The computation stopped and was started afresh: ", error instanceof Error ? error.message : String(error), ". Give a shorter part of the log (From, To), or use the command on a computer."));
    return null;
  } finally {
    clearInterval(timer);
    busy.hidden = true;
    results.removeAttribute("aria-busy");
  }
}

const paths = () => logs.map(([name]) => `/${name}`);
const json = (document: unknown) => JSON.stringify(document, null, 2);
const content = (answer: Answer, name: string) => answer.files.get(name) ?? new Uint8Array();

async function start(): Promise<void> {
  if (job.logs && logs.length === 0) {
    status.textContent = "Choose a log first.";
    return;
  }
  const made: Record<Job["name"], () => Promise<void>> = { identify, autotune, predict: printed, design: printed };
  await made[job.name]();
}

async function identify(): Promise<void> {
  const answer = await ask(["identify", ...paths(), "--json", "--progress", "--samples", "/samples.csv", ...form.args]);
  if (!answer) return;
  const found = answer.document as (Identified & { refused?: Coded }) | null;
  if (!found || found.refused || answer.code === 2) return refuse(answer, found?.refused);
  const angle = found.units.output === "rad";
  const more = h("section", { "aria-live": "polite" });
  const report = async () => {
    const written = await ask(["identify", ...paths(), "--report", "/report.html", ...form.args]);
    if (written) download("", "report.html", "text/html", content(written, "report.html")).click();
  };
  const enclose = async () => {
    const enclosed = await ask(["identify", ...paths(), "--method", "bounded", "--json", "--progress", ...form.args]);
    const document = enclosed?.document as (Identified & { refused?: Coded }) | null;
    if (document?.bounded) more.replaceChildren(...bounded(document.bounded));
    else if (enclosed) more.replaceChildren(h("p", { class: "verdict doubtful" }, document?.refused?.text ?? plain(enclosed)));
  };
  const model = new TextEncoder().encode(answer.out);
  results.replaceChildren(
    ...shown(identified(found)),
    h(
      "p",
      { class: "buttons" },
      h("button", { type: "button", click: () => void enclose() }, "Guaranteed bounds"),
      h("button", { type: "button", click: () => void report() }, "Report (HTML)"),
      download("Numbers (JSON)", "model.json", "application/json", json(found)),
      download("Samples (CSV)", "samples.csv", "text/csv", content(answer, "samples.csv")),
    ),
    more,
    ...records(answer.samples, found.records.map((record) => record.file.replace(/^\//, "")), angle),
    ...(found.reported && found.reported.trust !== "doubtful" ? [controller(model)] : []),
  );
}

/** The way from the model to a controller. */
function controller(model: Uint8Array): HTMLElement {
  const answers = h("div", { "aria-live": "polite" });
  const wanted = new Form(tune, "tune", () => undefined);
  const run = async () => {
    const answer = await ask(["tune", "--model", "/model.json", ...wanted.args], [["model.json", model]]);
    if (answer) answers.replaceChildren(answer.code === 0 ? copyable("Controller:", answer.out) : h("p", { class: "verdict doubtful" }, plain(answer)));
  };
  return h("section", {}, h("h2", {}, "A controller for this model"), h("form", { submit: (event) => (event.preventDefault(), void run()) }, wanted.element, h("p", { class: "buttons" }, h("button", { type: "submit" }, "Tune"))), answers);
}

async function autotune(): Promise<void> {
  const answer = await ask(["autotune", ...paths(), "--json", ...form.args]);
  if (!answer) return;
  const found = answer.document as (Autotuned & { refused?: Coded }) | null;
  if (!found || found.refused || answer.code === 2) return refuse(answer, found?.refused);
  const report = async () => {
    const written = await ask(["autotune", ...paths(), "--report", "/report.html", ...form.args]);
    if (written) download("", "report.html", "text/html", content(written, "report.html")).click();
  };
  results.replaceChildren(
    ...shown(autotuned(found)),
    h(
      "p",
      { class: "buttons" },
      h("button", { type: "button", click: () => void report() }, "Report (HTML)"),
      download("Numbers (JSON)", "gains.json", "application/json", json(found)),
    ),
    ...(found.curves ? [loadStep(found.curves)] : []),
  );
}

/** An answer that the command prints well itself. */
async function printed(): Promise<void> {
  const answer = await ask([job.name, ...form.args], []);
  if (!answer) return;
  if (answer.code !== 0) return refuse(answer);
  results.replaceChildren(copyable("Answer:", answer.out));
}

const shown = (parts: (HTMLElement | null)[]) => parts.filter((part) => part !== null);

/** A refusal with its remedies: each flag that it names is a button. */
function refuse(answer: Answer, refused?: Coded): void {
  const reason = refused?.text ?? plain(answer);
  const flags = [...new Set([...reason.matchAll(/--([a-z][a-z-]*)/g)].map((match) => match[1]!))].filter((flag) => form.has(flag));
  const label = (flag: string) => job.fields.find((field: Field) => field.flag === flag)!.label;
  const remedy = (flag: string) => {
    const again = () => {
      const ready = form.offer(flag);
      remember();
      if (ready) void start();
    };
    return h("button", { type: "button", click: again }, label(flag));
  };
  results.replaceChildren(
    h("p", { class: "verdict doubtful", role: "alert" }, reason.replaceAll(/(^|: )\//g, "$1")),
    h("p", { class: "buttons" }, ...flags.map(remedy)),
    refused ? h("p", {}, h("code", {}, refused.code)) : "",
  );
}

/** Names of files as paths of one folder. */
function named(files: Log[]): Log[] {
  const seen = new Set<string>();
  return files.map(([given, bytes]) => {
    let name = given.replaceAll(/[/\0]/g, "_") || "log.csv";
    if (name === "." || name === ".." || name === "samples.csv" || name === "report.html") name = `_${name}`;
    while (seen.has(name)) name = `_${name}`;
    seen.add(name);
    return [name, bytes];
  });
}

async function take(files: Iterable<File>): Promise<void> {
  const given = [...files];
  if (given.length === 0) return;
  const bytes = await Promise.all(given.map(async (file): Promise<Log> => [file.name, new Uint8Array(await file.arrayBuffer())]));
  use(named(bytes));
}

function use(given: Log[]): void {
  logs = given;
  logList.replaceChildren(...logs.map(([name, bytes]) => h("li", {}, `${name}, ${(bytes.length / 1024).toFixed(0)} KiB`)));
  void start();
}

function listen(): void {
  const drop = byId("drop");
  const input = byId("file") as HTMLInputElement;
  input.addEventListener("change", () => void take(input.files ?? []).finally(() => (input.value = "")));
  for (const kind of ["dragover", "dragenter"])
    document.addEventListener(kind, (event) => {
      event.preventDefault();
      drop.classList.add("over");
    });
  for (const kind of ["dragleave", "drop"]) document.addEventListener(kind, () => drop.classList.remove("over"));
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    void take(event.dataTransfer?.files ?? []);
  });
  byId("cancel").addEventListener("click", () => command.cancel());
  byId("jobs").append(...jobs.map((one) => h("label", {}, h("input", { type: "radio", name: "job", value: one.name, change: () => choose(one.name) }), one.title)));
  const sample = ([name, of, label]: (typeof samples)[number]) =>
    h(
      "button",
      {
        type: "button",
        click: async () => {
          if (job.name !== of) choose(of);
          use([[name, new Uint8Array(await (await fetch(name)).arrayBuffer())]]);
        },
      },
      label,
    );
  byId("samples").append("Try ", ...samples.flatMap((one, index) => [index > 0 ? " or " : "", sample(one)]));
  const settings = new URLSearchParams(location.hash.slice(1));
  choose(settings.get("job") ?? "identify", settings);
}

listen();
if ("serviceWorker" in navigator && location.protocol === "https:") void navigator.serviceWorker.register("offline.js");
