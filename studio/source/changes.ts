/**
 * Sends changes of the document: one at a time, the newest transient one instead of those before it. A transient change that is
 * still open becomes lasting before a change of something else begins.
 */
import { errorText, type Studio } from "./state.js";
import type { ChangeRequest, GraphRequest, PointsRequest, ViewRequest } from "./protocol.js";

/** Asks for a change of the document. */
type Change = (more: { transient?: boolean }) => Promise<unknown>;

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
  private readonly idleListeners: (() => void)[] = [];

  constructor(private readonly studio: Studio) {
    studio.on("connection", (state) => {
      if (state !== "open") return;
      this.busy = false;
      this.pump();
    });
  }

  /** Whether the server has yet to be told of a change, or to answer. */
  get isBusy(): boolean {
    return this.busy || this.unsent || this.queue.length > 0;
  }

  /** Calls a listener whenever the server has answered everything. */
  onIdle(listener: () => void): void {
    this.idleListeners.push(listener);
  }

  /** `key` names what is changed: a slider, a text. */
  transient(key: string, fields: ChangeRequest, label: string): void {
    this.begin(key, (more) => this.studio.connection.request("change", { ...fields, label, ...more }));
  }

  lasting(key: string, fields: ChangeRequest, label: string): void {
    this.end(key, (more) => this.studio.connection.request("change", { ...fields, label, ...more }));
  }

  /** The same for an edit of a graph of components. */
  graph(key: string, fields: GraphRequest, lasting: boolean): void {
    this.add(key, (more) => this.studio.connection.request("graph", { ...fields, ...more }), lasting);
  }

  /** The same for the control points of a side file. */
  points(key: string, fields: PointsRequest, lasting: boolean): void {
    this.add(key, (more) => this.studio.connection.request("points", { ...fields, ...more }), lasting);
  }

  /** The same for a setting of a view file. */
  viewValue(key: string, fields: ViewRequest, lasting: boolean): void {
    this.add(key, (more) => this.studio.connection.request("view-value", { ...fields, ...more }), lasting);
  }

  /** Makes the open change lasting; done when the server has everything. */
  settle(): Promise<void> {
    this.close();
    this.pump();
    if (!this.isBusy) return Promise.resolve();
    return new Promise((done) => this.idle.push(done));
  }

  private add(key: string, change: Change, lasting: boolean): void {
    if (lasting) this.end(key, change);
    else this.begin(key, change);
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
      for (const listener of this.idleListeners) listener();
    }
  }

  private async send(change: Change, transient: boolean): Promise<void> {
    this.busy = true;
    try {
      await change(transient ? { transient } : {});
    } catch (error) {
      // What was not heard because the connection broke is sent again when it stands.
      if (this.studio.connection.state === "open") this.studio.tell("error", errorText(error));
      else if (transient) this.unsent = this.open !== null;
      else this.queue.unshift(change);
    }
    this.busy = false;
    this.pump();
  }
}
