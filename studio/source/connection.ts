/** The WebSocket to the server: requests with replies, and a new try after a loss. */
import { readMessage, type BinaryMessage } from "./view/index.js";
import type { Requests, Said } from "./protocol.js";

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
const refusal = 1008; // the server closes a socket so that did not show the right key

export class Connection {
  state: ConnectionState = "connecting";
  /** Why the server refused this page. */
  why = "";
  private socket: WebSocket | null = null;
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
    const socket = new WebSocket(`ws://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.addEventListener("open", () => void this.greet());
    socket.addEventListener("message", (event: MessageEvent<string | ArrayBuffer>) => this.receive(event.data));
    socket.addEventListener("close", ({ code, reason }) => {
      if (this.socket === socket) this.lose(code === refusal ? reason : null);
    });
  }

  /** Tries again with another key. */
  connectWith(token: string): void {
    this.token = token;
    this.connect();
  }

  request<Name extends keyof Requests>(name: Name, fields: Requests[Name]["send"]): Promise<Requests[Name]["get"]> {
    const socket = this.socket;
    if (!socket || socket.readyState !== WebSocket.OPEN)
      return Promise.reject(new RequestError("There is no connection to the studio's program."));
    const id = this.next++;
    socket.send(JSON.stringify({ ...fields, do: name, id }));
    const reply = new Promise<Requests[Name]["get"]>((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    this.events.asks(true);
    return reply;
  }

  /** A file that a reply named. */
  async file(number: number): Promise<Blob> {
    const response = await fetch(`/file/${number}`, { headers: { Authorization: `Bearer ${this.token}` } });
    if (!response.ok) throw new RequestError(`The file could not be read (${response.status}).`);
    return response.blob();
  }

  private async greet(): Promise<void> {
    try {
      const greeting = await this.request("hello", { token: this.token });
      this.pause = 0.5;
      this.events.greeted(greeting);
      this.become("open");
    } catch {
      // The socket closes, and says why.
    }
  }

  private lose(refused: string | null): void {
    this.socket = null;
    for (const { reject } of this.waiting.values()) reject(new RequestError("The connection to the studio's program was lost."));
    this.waiting.clear();
    this.events.asks(false);
    if (refused !== null) {
      this.why = refused;
      this.become("refused");
      return;
    }
    this.become("lost");
    this.timer = window.setTimeout(() => this.connect(), this.pause * 1000);
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
