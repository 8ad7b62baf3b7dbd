/** Runs the command in a module of its own for each call: a call that crashes leaves nothing behind. */
import { ConsoleStdout, File, OpenFile, PreopenDirectory, WASI } from "@bjorn3/browser_wasi_shim";
import type { Answer, Call, Message, Samples } from "./protocol";

const compiled = WebAssembly.compileStreaming(fetch("selfosc.wasm"));
// A failure is said by the first call.
compiled.catch(() => undefined);

/** Large parts change hands: the page does not wait for a copy. */
const say = (message: Message, handed: Transferable[] = []) => postMessage(message, handed);
const text = (bytes: Uint8Array) => new TextDecoder().decode(bytes);

async function run({ id, args, files }: Call): Promise<Answer> {
  const given = new Map(files.map(([name, bytes]) => [name, new File(bytes, { readonly: true })]));
  const folder = new Map(given);
  const out = new File([]);
  let err = "";
  const stage = (line: string) => {
    err += line + "\n";
    say({ id, kind: "stage", text: line });
  };
  const fds = [new OpenFile(new File([])), new OpenFile(out), ConsoleStdout.lineBuffered(stage), new PreopenDirectory("/", folder)];
  const wasi = new WASI(["selfosc", ...args], [], fds, { debug: false });
  const instance = await WebAssembly.instantiate(await compiled, { wasi_snapshot_preview1: wasi.wasiImport });
  const code = wasi.start(instance as Parameters<WASI["start"]>[0]);
  const written = [...folder].filter(([name]) => !given.has(name));
  const outputs = new Map(written.map(([name, file]) => [name, new Uint8Array(file.data)]));
  const csv = outputs.get("samples.csv");
  const answer = text(out.data);
  return { code, out: answer, document: document(answer), err, files: outputs, samples: csv ? columns(text(csv)) : [] };
}

function document(answer: string): unknown {
  try {
    return JSON.parse(answer);
  } catch {
    return null;
  }
}

function columns(csv: string): Samples[] {
  const [header = "", ...lines] = csv.trimEnd().split("\n");
  const names = header.split(",").slice(1);
  const records: number[][][] = [];
  for (const line of lines) {
    const [record, ...cells] = line.split(",");
    const rows = (records[Number(record) - 1] ??= names.map(() => []));
    cells.forEach((cell, column) => rows[column]!.push(cell === "" ? NaN : Number(cell)));
  }
  return records.map((rows) => Object.fromEntries(names.map((name, column) => [name, Float64Array.from(rows[column]!)])) as unknown as Samples);
}

addEventListener("message", ({ data }: MessageEvent<Call>) => {
  run(data).then(
    (answer) => say({ id: data.id, kind: "answer", answer }, [...answer.samples.flatMap(Object.values), ...answer.files.values()].map((part) => part.buffer)),
    (error: unknown) => say({ id: data.id, kind: "crash", text: String(error) }),
  );
});
