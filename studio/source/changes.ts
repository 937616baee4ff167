/**
 * Sends changes of the document: one at a time, the newest transient one instead of those before it. A transient change that is
 * still open becomes lasting before a change of something else begins.
 */
import { errorText, type Studio } from "./state.js";
import type { ChangeRequest } from "./protocol.js";

interface Open {
  key: string;
  change: ChangeRequest;
  label: string;
}

export class Changes {
  private open: Open | null = null;
  private unsent = false;
  private busy = false;
  private readonly queue: ChangeRequest[] = [];
  private idle: (() => void)[] = [];

  constructor(private readonly studio: Studio) {
    studio.on("connection", (state) => {
      if (state !== "open") return;
      this.busy = false;
      this.pump();
    });
  }

  /** `key` names what is changed: a slider, a text. */
  transient(key: string, change: ChangeRequest, label: string): void {
    if (this.open && this.open.key !== key) this.close();
    this.open = { key, change, label };
    this.unsent = true;
    this.pump();
  }

  lasting(key: string, change: ChangeRequest, label: string): void {
    if (this.open && this.open.key !== key) this.close();
    this.open = null;
    this.unsent = false;
    this.queue.push({ ...change, label });
    this.pump();
  }

  /** Makes the open change lasting; done when the server has everything. */
  settle(): Promise<void> {
    this.close();
    this.pump();
    if (!this.busy && this.queue.length === 0) return Promise.resolve();
    return new Promise((done) => this.idle.push(done));
  }

  private close(): void {
    if (!this.open) return;
    this.queue.push({ ...this.open.change, label: this.open.label });
    this.open = null;
    this.unsent = false;
  }

  private pump(): void {
    if (this.busy || this.studio.connection.state !== "open") return;
    const next = this.queue.shift();
    if (next) void this.send(next);
    else if (this.unsent && this.open) {
      this.unsent = false;
      void this.send({ ...this.open.change, label: this.open.label, transient: true });
    } else {
      for (const done of this.idle) done();
      this.idle = [];
    }
  }

  private async send(change: ChangeRequest): Promise<void> {
    this.busy = true;
    try {
      await this.studio.connection.request("change", change);
    } catch (error) {
      // What was not heard because the connection broke is sent again when it stands.
      if (this.studio.connection.state === "open") this.studio.tell("error", errorText(error));
      else if (!change.transient) this.queue.unshift(change);
      else this.unsent = this.open !== null;
    }
    this.busy = false;
    this.pump();
  }
}
