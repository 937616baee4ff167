/**
 * Sends changes of the document: one at a time, the newest transient one instead of those before it. A transient change that is
 * still open becomes lasting before a change of something else begins.
 */
import { errorText, type Studio } from "./state.js";
import type { ChangeRequest, GraphRequest } from "./protocol.js";

/** What changes the document. */
type Change = { name: "change"; fields: ChangeRequest } | { name: "graph"; fields: GraphRequest };

interface Open {
  key: string;
  change: Change;
}

export class Changes {
  private open: Open | null = null;
  private unsent = false;
  private busy = false;
  private readonly queue: Change[] = [];
  private idle: (() => void)[] = [];

  constructor(private readonly studio: Studio) {
    studio.on("connection", (state) => {
      if (state !== "open") return;
      this.busy = false;
      this.pump();
    });
  }

  /** `key` names what is changed: a slider, a text. */
  transient(key: string, fields: ChangeRequest, label: string): void {
    this.begin(key, { name: "change", fields: { ...fields, label } });
  }

  lasting(key: string, fields: ChangeRequest, label: string): void {
    this.end(key, { name: "change", fields: { ...fields, label } });
  }

  /** The same for an edit of a graph of components. */
  graph(key: string, fields: GraphRequest, lasting: boolean): void {
    if (lasting) this.end(key, { name: "graph", fields });
    else this.begin(key, { name: "graph", fields });
  }

  /** Makes the open change lasting; done when the server has everything. */
  settle(): Promise<void> {
    this.close();
    this.pump();
    if (!this.busy && this.queue.length === 0) return Promise.resolve();
    return new Promise((done) => this.idle.push(done));
  }

  private begin(key: string, change: Change): void {
    if (this.open && this.open.key !== key) this.close();
    this.open = { key, change };
    this.unsent = true;
    this.pump();
  }

  private end(key: string, change: Change): void {
    if (this.open && this.open.key !== key) this.close();
    this.open = null;
    this.unsent = false;
    this.queue.push(change);
    this.pump();
  }

  private close(): void {
    if (!this.open) return;
    this.queue.push(this.open.change);
    this.open = null;
    this.unsent = false;
  }

  private pump(): void {
    if (this.busy || this.studio.connection.state !== "open") return;
    const next = this.queue.shift();
    if (next) void this.send(next, false);
    else if (this.unsent && this.open) {
      this.unsent = false;
      void this.send(this.open.change, true);
    } else {
      for (const done of this.idle) done();
      this.idle = [];
    }
  }

  private async send(change: Change, transient: boolean): Promise<void> {
    this.busy = true;
    const { connection } = this.studio;
    const more = transient ? { transient } : {};
    try {
      if (change.name === "change") await connection.request("change", { ...change.fields, ...more });
      else await connection.request("graph", { ...change.fields, ...more });
    } catch (error) {
      // What was not heard because the connection broke is sent again when it stands.
      if (connection.state === "open") this.studio.tell("error", errorText(error));
      else if (transient) this.unsent = this.open !== null;
      else this.queue.unshift(change);
    }
    this.busy = false;
    this.pump();
  }
}
