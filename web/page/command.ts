/** The command `selfosc` in a worker. */
import type { Answer, Call, Message } from "./protocol";

/** A run that gave no answer: `crash` where the module stopped, `cancelled` where the user did. */
export class NoAnswer extends Error {
  constructor(
    readonly reason: "crash" | "cancelled",
    text: string,
  ) {
    super(text);
  }
}

export class Command {
  private worker = this.start();
  private last = 0;
  private waiting: { stage: (text: string) => void; done: (answer: Answer) => void; failed: (error: NoAnswer) => void } | null = null;

  /** Runs the command; a run that is under way is cancelled. */
  run(args: string[], files: Call["files"], stage: (text: string) => void): Promise<Answer> {
    if (this.waiting) this.cancel();
    const id = ++this.last;
    return new Promise((done, failed) => {
      this.waiting = { stage, done, failed };
      this.worker.postMessage({ id, args, files } satisfies Call);
    });
  }

  /** Ends the run under way. */
  cancel(): void {
    this.end("cancelled", "cancelled");
  }

  private end(reason: NoAnswer["reason"], text: string): void {
    this.worker.terminate();
    this.worker = this.start();
    const waiting = this.waiting;
    this.waiting = null;
    waiting?.failed(new NoAnswer(reason, text));
  }

  private start(): Worker {
    const worker = new Worker("worker.js");
    worker.onmessage = ({ data }: MessageEvent<Message>) => {
      if (data.id !== this.last || !this.waiting) return;
      if (data.kind === "stage") this.waiting.stage(data.text);
      else if (data.kind === "crash") this.end("crash", data.text);
      else {
        const waiting = this.waiting;
        this.waiting = null;
        waiting.done(data.answer);
      }
    };
    worker.onerror = (event) => {
      event.preventDefault();
      this.end("crash", event.message || "the worker stopped");
    };
    return worker;
  }
}
