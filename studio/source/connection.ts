/** The connection to the studio's session: requests with replies, and a new try after a loss. */
import { readMessage, type BinaryMessage } from "./view/index.js";
import type { Requests, Said } from "./protocol.js";
import { SocketTransport, type Transport, type TransportEvents } from "./transport.js";
import { hasOwnSession, WorkerTransport } from "./web/worker-transport.js";

export type ConnectionState = "connecting" | "open" | "lost" | "refused";

export class RequestError extends Error {}

interface Waiting {
  resolve: (reply: never) => void;
  reject: (reason: Error) => void;
}

export interface ConnectionEvents {
  greeted: (greeting: Requests["hello"]["get"]) => void;
  state: (state: ConnectionState, tryAgainIn: number) => void;
  said: (message: Said) => void;
  binary: (message: BinaryMessage) => void;
  /** Whether a reply is outstanding. */
  asks: (asks: boolean) => void;
  /** A binary message that cannot be understood. */
  broken: (why: string) => void;
}

const longestPause = 8; // seconds between two tries

export class Connection {
  state: ConnectionState = "connecting";
  /** Why the server refused this page. */
  why = "";
  /** What is wrong while it is lost. */
  lost = "";
  private transport: Transport | null = null;
  private next = 1;
  private pause = 0.5;
  private timer = 0;
  private readonly waiting = new Map<number, Waiting>();

  constructor(
    private token: string,
    private readonly events: ConnectionEvents,
  ) {}

  connect(): void {
    clearTimeout(this.timer);
    const here = (): boolean => this.transport === transport;
    const events: TransportEvents = {
      opened: () => void this.greet(),
      received: (data) => this.receive(data),
      closed: (refused, atOnce) => {
        if (here()) this.lose(refused, atOnce === true);
      },
    };
    const transport = hasOwnSession() ? new WorkerTransport(events) : new SocketTransport(this.token, events);
    this.transport = transport;
  }

  /** Tries again with another key. */
  connectWith(token: string): void {
    this.token = token;
    this.connect();
  }

  request<Name extends keyof Requests>(name: Name, fields: Requests[Name]["send"]): Promise<Requests[Name]["get"]> {
    const transport = this.transport;
    if (!transport?.isOpen) return Promise.reject(new RequestError("There is no connection to the studio's program."));
    const id = this.next++;
    transport.send(JSON.stringify({ ...fields, do: name, id }));
    const reply = new Promise<Requests[Name]["get"]>((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    this.events.asks(true);
    return reply;
  }

  /** A file that a reply named. */
  async file(number: number): Promise<Blob> {
    if (!this.transport) throw new RequestError("There is no connection to the studio's program.");
    return this.transport.file(number);
  }

  private async greet(): Promise<void> {
    try {
      const greeting = await this.request("hello", { token: this.token });
      this.pause = 0.5;
      this.events.greeted(greeting);
      this.become("open");
    } catch {
      // The transport closes, and says why.
    }
  }

  private lose(refused: string | null, atOnce: boolean): void {
    this.lost = this.transport?.lost ?? "";
    this.transport = null;
    for (const { reject } of this.waiting.values()) reject(new RequestError("The connection to the studio's program was lost."));
    this.waiting.clear();
    this.events.asks(false);
    if (refused !== null) {
      this.why = refused;
      this.become("refused");
      return;
    }
    this.become("lost");
    this.timer = window.setTimeout(() => this.connect(), atOnce ? 0 : this.pause * 1000);
    this.pause = Math.min(longestPause, this.pause * 1.6);
  }

  private become(state: ConnectionState): void {
    this.state = state;
    this.events.state(state, this.pause);
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.receiveBytes(data);
      return;
    }
    const message = JSON.parse(data) as Said | { reply: number; error?: string };
    if ("say" in message) this.events.said(message);
    else this.answer(message);
  }

  private receiveBytes(data: ArrayBuffer): void {
    try {
      this.events.binary(readMessage(data));
    } catch (error) {
      this.events.broken(error instanceof Error ? error.message : String(error));
    }
  }

  private answer(message: { reply: number; error?: string }): void {
    const waiting = this.waiting.get(message.reply);
    this.waiting.delete(message.reply);
    this.events.asks(this.waiting.size > 0);
    if (message.error !== undefined) waiting?.reject(new RequestError(message.error));
    else waiting?.resolve(message as never);
  }
}
