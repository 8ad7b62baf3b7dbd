/** What the page and its worker say to each other. */

/** Columns of `identify --samples` for one record, one array each; NaN where nothing is predicted. */
export interface Samples {
  time_s: Float64Array;
  output: Float64Array;
  input: Float64Array;
  model: Float64Array;
  residual: Float64Array;
}

/** A run of the command: its arguments, and its files by name in the folder `/`. */
export interface Call {
  id: number;
  args: string[];
  files: [name: string, bytes: Uint8Array][];
}

/** How a run ended: exit status, standard output and error, and the files that it wrote. */
export interface Answer {
  code: number;
  out: string;
  /** Standard output where it is a JSON document. */
  document: unknown;
  err: string;
  files: Map<string, Uint8Array<ArrayBuffer>>;
  /** The file `samples.csv` as numbers, record by record. */
  samples: Samples[];
}

export type Message =
  | { id: number; kind: "stage"; text: string }
  | { id: number; kind: "answer"; answer: Answer }
  | { id: number; kind: "crash"; text: string };
