/** What carries requests to the studio's session and brings what it says. */

export interface TransportEvents {
  /** Requests are heard from now on. */
  opened: () => void;
  received: (data: string | ArrayBuffer) => void;
  /** `refused`: why this page is not let in; null: it may try again, `atOnce` or after a while. */
  closed: (refused: string | null, atOnce?: boolean) => void;
}

export interface Transport {
  readonly isOpen: boolean;
  /** What people are told while it is lost. */
  readonly lost: string;
  send(text: string): void;
  /** A file that a reply named. Throws what went wrong. */
  file(number: number): Promise<Blob>;
}

const refusal = 1008; // the server closes a socket so that did not show the right key

/** To a program on this machine. */
export class SocketTransport implements Transport {
  readonly lost =
    "There is no connection to the program. Your texts are kept on this page, and it tries again. " +
    "If the program has ended, start espalier studio again.";
  private readonly socket = new WebSocket(`ws://${location.host}/socket`);

  constructor(
    private readonly token: string,
    events: TransportEvents,
  ) {
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("open", events.opened);
    this.socket.addEventListener("message", (event: MessageEvent<string | ArrayBuffer>) => events.received(event.data));
    this.socket.addEventListener("close", ({ code, reason }) => events.closed(code === refusal ? reason : null));
  }

  get isOpen(): boolean {
    return this.socket.readyState === WebSocket.OPEN;
  }

  send(text: string): void {
    this.socket.send(text);
  }

  async file(number: number): Promise<Blob> {
    const response = await fetch(`/file/${number}`, { headers: { Authorization: `Bearer ${this.token}` } });
    if (!response.ok) throw new Error(`The file could not be read (${response.status}).`);
    return response.blob();
  }
}
