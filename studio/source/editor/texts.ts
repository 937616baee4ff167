/** Keeps a text of the page and the server's copy in agreement without ever losing what is typed. */
export class Agreement {
  /** The last text that both sides have had. */
  private agreed: string;
  private sent: string[] = [];

  constructor(content: string) {
    this.agreed = content;
  }

  send(content: string): void {
    this.sent = [...this.sent.slice(-50), content];
  }

  /** Whether the page has text that the server may not know. */
  ahead(local: string): boolean {
    return local !== this.agreed;
  }

  /** What to show when the server says `remote`: that text, or null to keep the present one, which is newer. */
  hear(remote: string, local: string): string | null {
    const typed = local !== this.agreed;
    // An answer to what was sent before is old news while later text is on its way.
    const old = this.sent.includes(remote) && this.sent.at(-1) !== remote;
    this.agreed = remote;
    if (remote === local) this.sent = [];
    return remote === local || typed || old ? null : remote;
  }
}
