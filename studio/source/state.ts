/** What the page knows: the server's words, kept together, with a notice to whoever shows them. */
import { Connection, RequestError, type ConnectionState } from "./connection.js";
import { remember, remembered } from "./elements.js";
import { Frames } from "./frames.js";
import { sameTexts, withRows } from "./tables.js";
import type {
  AuthorView,
  FieldName,
  FitEnd,
  FitState,
  Growth,
  HandedFile,
  Help,
  MeasuredFile,
  Note,
  Problem,
  Progress,
  Requests,
  Said,
  Sky,
  SkyOfStep,
  Statistics,
  StudioDocument,
} from "./protocol.js";
import type { BinaryMessage, Column, Field, Limbs, Packet, PictureSource, Shape, Shapes } from "./view/index.js";

/** A note of the server's, or one of the page itself, which has a negative number. */
export type Message = Note;

const noteTime = 8000; // milliseconds
const firstSwept = 2 ** 31; // number of a growth

/** The last step of a plant of a sweep. */
export interface SweptPlant {
  growth: number;
  /** Why there is none; "" otherwise. */
  reason: string;
  packet: Packet | null;
  shapes: Shape[];
  statistics: Statistics | null;
}

const nothingSwept: SweptPlant = { growth: 0, reason: "", packet: null, shapes: [], statistics: null };

interface Events {
  connection: ConnectionState;
  document: StudioDocument;
  problems: Problem[];
  growth: Growth;
  statistics: Statistics;
  columns: string[];
  fields: FieldName[];
  messages: Message[];
  progress: Progress;
  /** The server has told a page that has greeted all that there is; the growth that it told. */
  told: number | null;
  /** Whether the server owes an answer. */
  asks: boolean;
  /** Whether a text that is being typed is no lasting change yet. */
  unsent: boolean;
  packet: Packet;
  shapes: Shapes;
  pictures: PictureSource[];
  limbs: Limbs;
  column: Column;
  field: Field;
  shown: Packet;
  view: AuthorView | null;
  help: Help;
  exported: HandedFile[];
  measured: MeasuredFile[];
  fitting: FitState;
  fitted: FitEnd;
  swept: SweptPlant;
  /** A growth was pinned or let go, or is looked at in another way. */
  compared: null;
  theme: "light" | "dark";
  /** Whether a slider of a setting is being moved. */
  sliding: boolean;
}

type Listener<Name extends keyof Events> = (event: Events[Name]) => void;

export class Studio {
  readonly connection: Connection;
  readonly frames: Frames;
  document: StudioDocument | null = null;
  /** Of the program, once it has greeted. */
  version = "";
  /** What the program had open when it greeted; "" if nothing. */
  opened = "";
  problems: Problem[] = [];
  growth: Growth | null = null;
  statistics: Statistics = { growth: 0, columns: [], units: {}, rows: [] };
  columns: string[] = [];
  fields: FieldName[] = [];
  help: Help | null = null;
  /** Whether the program can fit what is open to what was measured. */
  fits = false;
  measured: MeasuredFile[] = [];
  /** The shapes of the present growth, as they came. */
  shapeMessages: ArrayBuffer[] = [];
  /** What it wears. */
  pictures: PictureSource[] = [];
  /** The limbs with bark or skin that show; null while none do. */
  limbs: Limbs | null = null;
  /** Of the steps of one growth that came. */
  private skies = new Map<number, Sky>();
  private skiesOf = -1;
  private readonly handed = new Map<number, Promise<Blob>>();
  messages: Message[] = [];
  theme: "light" | "dark";
  private ownMessages = 0;
  private asksHelp = false;
  /** What has come so far of the plant that a sweep grows. */
  private swept: SweptPlant = nothingSwept;
  private readonly listeners: { [Name in keyof Events]?: Listener<Name>[] } = {};

  constructor(readonly token: string) {
    this.theme = remembered("theme", matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    this.connection = new Connection(token, {
      greeted: ({ version, opened, fits }) => Object.assign(this, { version, opened, fits }),
      state: (state) => this.connected(state),
      said: (message) => this.hear(message),
      binary: (message) => this.take(message),
      asks: (asks) => this.emit("asks", asks),
      broken: (why) => this.tell("error", `${why} Page and program are of different versions: load the page again.`),
    });
    this.frames = new Frames(this);
    this.on("shown", () => requestAnimationFrame(() => void this.askHelp()));
    this.on("problems", (problems) => {
      if (problems.length > 0) void this.askHelp();
    });
  }

  on<Name extends keyof Events>(name: Name, listener: Listener<Name>): void {
    const list = (this.listeners[name] ?? []) as Listener<Name>[];
    list.push(listener);
    (this.listeners as Record<Name, Listener<Name>[]>)[name] = list;
  }

  emit<Name extends keyof Events>(name: Name, event: Events[Name]): void {
    for (const listener of (this.listeners[name] ?? []) as Listener<Name>[]) listener(event);
  }

  /** Sends a request; an error becomes a message, and the result undefined. */
  async ask<Name extends keyof Requests>(name: Name, fields: Requests[Name]["send"]): Promise<Requests[Name]["get"] | undefined> {
    try {
      return await this.connection.request(name, fields);
    } catch (error) {
      // A lost connection has its own banner.
      if (this.connection.state === "open") this.tell("error", errorText(error));
      return undefined;
    }
  }

  /** The number of the message, to dismiss it. */
  tell(severity: Note["severity"], text: string): number {
    const known = this.messages.find((message) => message.text === text);
    if (known) return known.number;
    const number = --this.ownMessages;
    this.messages = [...this.messages, { number, severity, text }];
    this.emit("messages", this.messages);
    // What only confirms goes by itself.
    if (severity === "note") setTimeout(() => this.dismiss(number), noteTime);
    return number;
  }

  dismiss(number: number): void {
    this.messages = this.messages.filter((message) => message.number !== number);
    this.emit("messages", this.messages);
    if (number > 0) void this.ask("dismiss", { message: number });
  }

  setTheme(theme: "light" | "dark"): void {
    this.theme = theme;
    remember("theme", theme);
    this.emit("theme", theme);
  }

  private connected(state: ConnectionState): void {
    if (state === "open") this.frames.connected();
    this.emit("connection", state);
  }

  /** Once there is something to see, which help would delay. */
  private async askHelp(): Promise<void> {
    if (this.help || this.asksHelp) return;
    this.asksHelp = true;
    const help = await this.ask("help", {});
    this.asksHelp = false;
    if (!help) return;
    this.help = help;
    this.emit("help", help);
  }

  private hear(message: Said): void {
    switch (message.say) {
      case "document":
        return this.hearDocument(message);
      case "problems":
        this.problems = message.problems;
        return this.emit("problems", message.problems);
      case "growth":
        return this.hearGrowth(message);
      case "statistics":
        return this.hearStatistics(message);
      case "columns":
        this.columns = message.columns;
        return this.emit("columns", message.columns);
      case "fields":
        this.fields = message.fields;
        return this.emit("fields", message.fields);
      case "message":
        this.messages = [...this.messages.filter(({ number }) => number !== message.number), message];
        return this.emit("messages", this.messages);
      case "textures":
        return this.fetchPictures(message.files, message.reliefs);
      case "sky":
        return this.hearSky(message);
      case "view":
        return this.emit("view", message.view);
      case "exported":
        return this.emit("exported", message.files);
      case "measured":
        this.measured = message.files;
        return this.emit("measured", message.files);
      case "fitting":
        return this.emit("fitting", message);
      case "fitted":
        return this.emit("fitted", message);
      case "swept":
        this.emit("swept", { ...this.swept, growth: message.growth, reason: message.reason });
        this.swept = nothingSwept;
        return;
      case "progress":
        return this.emit("progress", message);
      case "told":
        return this.emit("told", message.growth);
    }
  }

  /** Nothing is open while the path is empty. */
  private hearDocument(document: StudioDocument): void {
    if (document.path === "") return;
    this.document = document;
    this.emit("document", document);
  }

  private hearGrowth(growth: Growth): void {
    if (growth.growth !== this.growth?.growth) this.shapeMessages = [];
    this.growth = growth;
    this.frames.grown(growth);
    this.emit("growth", growth);
  }

  private hearStatistics(more: Statistics): void {
    if (more.growth >= firstSwept) {
      this.swept = { ...this.swept, statistics: more };
      return;
    }
    const same = more.growth === this.statistics.growth && sameTexts(more.columns, this.statistics.columns);
    const rows = same ? withRows(this.statistics.rows, more.rows) : more.rows;
    this.statistics = { ...this.statistics, ...more, rows };
    this.emit("statistics", this.statistics);
  }

  private hearSky({ growth, step, sky }: SkyOfStep): void {
    if (growth !== this.skiesOf) this.skies = new Map();
    this.skiesOf = growth;
    this.skies.set(step, sky);
  }

  /** The light that fell on the plants of a packet; null if the scene has no sky. */
  skyOf({ growth, step }: Packet): Sky | null {
    return (growth === this.skiesOf && this.skies.get(step)) || null;
  }

  private take(message: BinaryMessage): void {
    if (message.growth >= firstSwept) {
      if (message.kind === "packet") this.swept = { ...this.swept, packet: message };
      if (message.kind === "shapes") this.swept = { ...this.swept, shapes: [...this.swept.shapes, ...message.shapes] };
    } else if (message.kind === "packet") {
      this.frames.arrived(message);
      this.emit("packet", message);
    } else if (message.kind === "shapes") this.learn(message);
    else if (message.kind === "column") this.emit("column", message);
    else if (message.kind === "limbs") this.emit("limbs", message);
    else this.emit("field", message);
  }

  private fetchPictures(files: (number | null)[], reliefs: (number | null)[]): void {
    this.pictures = files.map((file, i) => ({ colours: this.fileOf(file), normals: this.fileOf(reliefs[i] ?? null) }));
    this.emit("pictures", this.pictures);
  }

  /** A file is fetched once, however many growths use it. */
  private fileOf(number: number | null): Promise<Blob> | null {
    if (number === null) return null;
    const blob = this.handed.get(number) ?? this.connection.file(number);
    this.handed.set(number, blob);
    return blob;
  }

  private learn(shapes: Shapes): void {
    this.shapeMessages = [...this.shapeMessages.slice(-20), shapes.message];
    this.emit("shapes", shapes);
  }
}

export function errorText(error: unknown): string {
  if (error instanceof RequestError || error instanceof Error) return error.message;
  return String(error);
}
