/** The texts of the document: a tab and an editor for each. */
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import {
  Annotation,
  EditorState,
  StateEffect,
  StateField,
  Transaction,
  type Extension,
  type TransactionSpec,
} from "@codemirror/state";
import {
  Decoration,
  drawSelection,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  highlightSpecialChars,
  keymap,
  lineNumbers,
  type DecorationSet,
} from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";
import type { Changes } from "../changes.js";
import { menuButton } from "../dialog.js";
import { h, iconButton, remember, remembered } from "../elements.js";
import type { CurvePoint, Problem, StudioDocument, TextFile } from "../protocol.js";
import { sideEditor, type SideEditor, type ViewEdit } from "../side/side.js";
import type { Studio } from "../state.js";
import { cpfg } from "./cpfg.js";
import { Disputes } from "./disputes.js";
import { completion, hoverHelp } from "./help.js";
import { newFileEntries } from "./new-file.js";
import { notation } from "./notation.js";
import { Agreement } from "./texts.js";
import { toml } from "./toml.js";

const transientAfter = 150; // milliseconds without typing
const lastingAfter = 1500;

const fromServer = Annotation.define<boolean>();
const markLines = StateEffect.define<number[]>();

const markedLines = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(marks, transaction) {
    marks = marks.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(markLines)) continue;
      const { doc } = transaction.state;
      const lines = [...new Set(effect.value)].filter((line) => line >= 1 && line <= doc.lines).sort((a, b) => a - b);
      marks = Decoration.set(lines.map((line) => Decoration.line({ class: "marked-line" }).range(doc.line(line).from)));
    }
    return marks;
  },
  provide: (field) => EditorView.decorations.from(field),
});

interface OpenText {
  file: TextFile;
  state: EditorState;
  agreement: Agreement;
}

const draftKey = "drafts";

export class Editor {
  readonly element: HTMLElement;
  private readonly tabs = h("div", "tabs", { role: "tablist", "aria-label": "Texts of the document" });
  private readonly view: EditorView;
  private readonly place = h("div", "editor-text");
  private readonly sideTools = h("div", "side-tools");
  private readonly texts = new Map<string, OpenText>();
  private side: SideEditor | null = null;
  private shown: string | null = null;
  private documentPath = "";
  private soon = 0;
  private later = 0;

  constructor(
    private readonly studio: Studio,
    private readonly changes: Changes,
    /** The texts are there to be read. */
    private readonly isLocked = false,
  ) {
    const { place } = this;
    this.view = new EditorView({ parent: place, state: EditorState.create({}) });
    const add = menuButton(
      iconButton("plus", "New side file: function, contour, surface, colours and more", () => undefined),
      () => newFileEntries(studio, this.fileHolder),
    );
    const disputes = new Disputes(studio, () => this.settle()).element;
    this.element = h("div", "editor", {}, h("div", "tab-row", {}, this.tabs, !isLocked && add), disputes, !isLocked && this.sideTools, place);
    this.view.contentDOM.addEventListener("blur", () => this.sendLasting());
    studio.on("document", (document) => this.hear(document));
    changes.onIdle(() => this.side?.reread?.());
    studio.on("problems", (problems) => this.underline(problems));
    studio.on("connection", (state) => {
      if (state === "open") this.resend();
      if (state === "lost") this.keepDrafts();
    });
  }

  /** A text that comes later is shown when it comes. */
  private readonly fileHolder = {
    show: (path: string) => {
      this.awaited = path;
      this.showAwaited();
    },
    replace: (path: string, content: string) => this.replace(path, content, true),
    contentOf: (path: string) => this.contentOf(path),
  };
  private awaited: string | null = null;

  private showAwaited(): void {
    if (this.awaited === null || !this.texts.has(this.awaited)) return;
    this.showText(this.awaited);
    this.awaited = null;
  }

  /** Shows a text and a line of it. */
  goTo(path: string, line: number, column: number): void {
    const key = this.keyOf(path);
    if (key === null) return;
    this.showText(key);
    const { doc } = this.view.state;
    const target = doc.line(Math.min(Math.max(1, line), doc.lines));
    const anchor = Math.min(target.to, target.from + Math.max(0, column - 1));
    this.view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
    this.view.focus();
  }

  /** Marks lines of the texts, such as the production that made an organ. */
  mark(places: { file: string; line: number }[]): void {
    for (const key of this.texts.keys()) {
      const lines = places.filter(({ file }) => this.keyOf(file) === key).map(({ line }) => line);
      this.dispatchTo(key, { effects: markLines.of(lines) });
    }
    const first = places[0];
    if (!first) return;
    const key = this.keyOf(first.file);
    if (key === null || key !== this.shown) return;
    const { doc } = this.view.state;
    if (first.line <= doc.lines)
      this.view.dispatch({ effects: EditorView.scrollIntoView(doc.line(first.line).from, { y: "center" }) });
  }

  contentOf(path: string): string {
    return this.stateOf(path)?.doc.toString() ?? "";
  }

  /** One line of a text, without its indentation. */
  lineOf(file: string, line: number): string {
    const key = this.keyOf(file);
    const doc = key === null ? undefined : this.stateOf(key)?.doc;
    return doc && line >= 1 && line <= doc.lines ? doc.line(line).text.trim() : "";
  }

  /** Replaces a text from outside of the editor, as an editor of curves does. */
  replace(path: string, content: string, lasting: boolean): void {
    this.setContent(path, content);
    const label = `Edit ${shortName(path)}`;
    this.texts.get(path)?.agreement.send(content);
    const change = { texts: { [path]: content } };
    if (lasting) this.changes.lasting(`text ${path}`, change, label);
    else this.changes.transient(`text ${path}`, change, label);
  }

  /** Moves control points of a text, which follows. */
  private move(path: string, number: number, points: CurvePoint[], lasting: boolean): void {
    this.sendLasting();
    const label = `Edit ${shortName(path)}`;
    this.changes.points(`points ${number} of ${path}`, { path, number, points, label }, lasting);
  }

  /** Gives a setting of a view file another value: the text follows. */
  private setView(path: string, edit: ViewEdit, lasting: boolean): void {
    this.sendLasting();
    const key = `${edit.name} ${edit.number} ${edit.letter ?? ""} of ${path}`;
    this.changes.viewValue(key, { path, ...edit, label: `Edit ${shortName(path)}` }, lasting);
  }

  /** Sends what is typed; done before the document is saved or an undo is asked for. */
  sendLasting(): void {
    clearTimeout(this.soon);
    clearTimeout(this.later);
    for (const [path, text] of this.texts) {
      const content = this.stateOf(path)?.doc.toString() ?? "";
      if (!this.pending.has(path) && !text.agreement.ahead(content)) continue;
      this.setPending(path, false);
      text.agreement.send(content);
      this.changes.lasting(`text ${path}`, { texts: { [path]: content } }, `Edit ${shortName(path)}`);
    }
  }

  /** Done when the server has all that was typed. */
  private settle(): Promise<void> {
    this.sendLasting();
    return this.changes.settle();
  }

  /** Texts with changes that are not lasting yet. */
  private readonly pending = new Set<string>();

  private setPending(path: string, pending: boolean): void {
    if (pending) this.pending.add(path);
    else this.pending.delete(path);
    this.studio.emit("unsent", this.pending.size > 0);
  }

  private typed(): void {
    const path = this.shown;
    if (path === null) return;
    this.setPending(path, true);
    clearTimeout(this.soon);
    clearTimeout(this.later);
    this.soon = window.setTimeout(() => this.sendTransient(path), transientAfter);
    this.later = window.setTimeout(() => this.sendLasting(), lastingAfter);
    if (this.studio.connection.state !== "open") this.keepDrafts();
  }

  private sendTransient(path: string): void {
    const content = this.contentOf(path);
    this.texts.get(path)?.agreement.send(content);
    this.changes.transient(`text ${path}`, { texts: { [path]: content } }, `Edit ${shortName(path)}`);
  }

  private resend(): void {
    const drafts = remembered<Record<string, string>>(draftKey, {});
    remember(draftKey, {});
    // The document arrives with the connection; what was typed meanwhile is sent after it.
    setTimeout(() => {
      for (const [path, content] of Object.entries(drafts)) this.restore(path, content);
      this.sendLasting();
    }, 300);
  }

  private restore(path: string, content: string): void {
    const key = path.startsWith(`${this.documentPath}\n`) ? path.slice(this.documentPath.length + 1) : null;
    if (key === null || !this.texts.has(key) || this.contentOf(key) === content) return;
    this.setContent(key, content);
    this.setPending(key, true);
    this.studio.tell("note", `Text of ${shortName(key)} that was typed while there was no connection is back.`);
  }

  private keepDrafts(): void {
    const drafts: Record<string, string> = {};
    for (const [path, text] of this.texts)
      if (text.agreement.ahead(this.contentOf(path))) drafts[`${this.documentPath}\n${path}`] = this.contentOf(path);
    if (Object.keys(drafts).length > 0) remember(draftKey, drafts);
  }

  private hear(document: StudioDocument): void {
    if (document.path !== this.documentPath) {
      this.documentPath = document.path;
      this.texts.clear();
      for (const path of this.pending) this.setPending(path, false);
      this.shown = null;
    }
    for (const path of this.texts.keys()) {
      if (document.texts.some((file) => file.path === path)) continue;
      this.texts.delete(path);
      this.setPending(path, false);
    }
    for (const file of document.texts) this.hearText(file);
    if (this.shown === null || !this.texts.has(this.shown)) this.showFirst(document);
    this.showAwaited();
    this.drawTabs();
    this.side?.reread?.();
  }

  private hearText(file: TextFile): void {
    const text = this.texts.get(file.path);
    if (!text) {
      this.texts.set(file.path, { file, state: this.newState(file), agreement: new Agreement(file.content) });
      return;
    }
    text.file = file;
    const content = text.agreement.hear(file.content, this.contentOf(file.path));
    if (content !== null) this.setContent(file.path, content);
  }

  private showFirst(document: StudioDocument): void {
    const first = document.texts.find(({ role }) => role === "main") ?? document.texts[0];
    const model = document.kind === "object" ? document.texts.find(({ role }) => role === "model") : undefined;
    const file = model ?? first;
    if (file) this.showText(file.path);
  }

  /** `opened`: the function of the text that is edited first, among several. */
  private showText(path: string, opened = 0): void {
    const text = this.texts.get(path);
    if (!text || path === this.shown) return;
    if (this.shown !== null) {
      const before = this.texts.get(this.shown);
      if (before) before.state = this.view.state;
    }
    this.shown = path;
    this.view.setState(text.state);
    this.drawTabs();
    const side = {
      path,
      content: () => this.contentOf(path),
      change: (content: string, lasting: boolean) => this.replace(path, content, lasting),
      curves: () => this.studio.document?.curves.filter((curve) => curve.path === path) ?? [],
      functions: () => this.studio.document?.curves.filter(({ kind }) => kind === "function") ?? [],
      opened,
      go: (other: string, number: number) => {
        this.showText(other, number);
        this.side?.focus?.();
      },
      move: (number: number, points: CurvePoint[], lasting: boolean) => this.move(path, number, points, lasting),
      viewEntries: () => this.studio.document?.view_entries.filter((entry) => entry.path === path) ?? [],
      setView: (edit: ViewEdit, lasting: boolean) => this.setView(path, edit, lasting),
      isAhead: () => this.changes.isBusy,
    };
    this.side = sideEditor(side, () => this.studio.help);
    this.sideTools.replaceChildren(...this.side.elements);
    // The bytes of colours are no text for people.
    this.place.hidden = text.file.language === "map" || text.file.language === "materials";
    this.underline(this.studio.problems);
  }

  private drawTabs(): void {
    const wrong = new Set(
      this.studio.problems.filter(({ severity }) => severity === "error").map(({ file }) => this.keyOf(file)),
    );
    this.tabs.replaceChildren(
      ...[...this.texts.values()].map(({ file }) =>
        h(
          "button",
          `tab${wrong.has(file.path) ? " wrong" : ""}`,
          {
            role: "tab",
            type: "button",
            "aria-selected": String(file.path === this.shown),
            title: file.path,
            onclick: () => this.showText(file.path),
          },
          shortName(file.path),
          file.changed ? h("span", "dot", { title: "Not saved" }, "●") : null,
        ),
      ),
    );
    this.tabs.querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  private stateOf(path: string): EditorState | undefined {
    return path === this.shown ? this.view.state : this.texts.get(path)?.state;
  }

  private dispatchTo(path: string, specification: TransactionSpec): void {
    if (path === this.shown) {
      this.view.dispatch(specification);
      return;
    }
    const text = this.texts.get(path);
    if (text) text.state = text.state.update(specification).state;
  }

  /** Replaces what differs, so that cursor and marks stay where they are. */
  private setContent(path: string, content: string): void {
    const before = this.contentOf(path);
    let from = 0;
    const shorter = Math.min(before.length, content.length);
    while (from < shorter && before[from] === content[from]) from++;
    let end = 0;
    while (end < shorter - from && before[before.length - 1 - end] === content[content.length - 1 - end]) end++;
    this.dispatchTo(path, {
      changes: { from, to: before.length - end, insert: content.slice(from, content.length - end) },
      annotations: [fromServer.of(true), Transaction.addToHistory.of(false)],
    });
  }

  private keyOf(file: string): string | null {
    if (this.texts.has(file)) return file;
    for (const path of this.texts.keys()) if (path.endsWith(`/${file}`) || file.endsWith(`/${path}`)) return path;
    return null;
  }

  private underline(problems: Problem[]): void {
    this.drawTabs();
    if (this.shown === null) return;
    const { doc } = this.view.state;
    const diagnostics: Diagnostic[] = problems
      .filter(({ file }) => this.keyOf(file) === this.shown)
      .map((problem) => {
        const line = doc.line(Math.min(Math.max(1, problem.line), doc.lines));
        const from = Math.min(line.to, line.from + Math.max(0, problem.column - 1));
        const word = /^\s*[\w@.]+|^\s*\S/.exec(doc.sliceString(from, line.to));
        const to = Math.min(line.to, from + Math.max(1, word?.[0].length ?? 1));
        return { from, to, severity: problem.severity, message: problem.message };
      });
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }

  private newState(file: TextFile): EditorState {
    return EditorState.create({ doc: file.content, extensions: [this.extensions(), this.languageOf(file)] });
  }

  private languageOf(file: TextFile): Extension {
    const { language } = file;
    if (language === "map" || language === "materials" || language === "plain") return [];
    const help = () => this.studio.help;
    const highlighting = language === "cpfg" ? cpfg() : language === "toml" ? toml() : notation();
    return [highlighting, autocompletion({ override: [completion(language, help)] }), hoverHelp(language, help)];
  }

  private extensions(): Extension {
    return [
      lineNumbers(),
      highlightActiveLineGutter(),
      highlightSpecialChars(),
      history(),
      drawSelection(),
      bracketMatching(),
      closeBrackets(),
      highlightActiveLine(),
      highlightSelectionMatches(),
      search({ top: true }),
      lintGutter(),
      markedLines,
      indentUnit.of("\t"),
      EditorState.tabSize.of(4),
      syntaxHighlighting(classHighlighter),
      keymap.of([
        ...closeBracketsKeymap,
        ...defaultKeymap,
        ...searchKeymap,
        ...historyKeymap,
        ...completionKeymap,
        indentWithTab,
      ]),
      EditorState.readOnly.of(this.isLocked),
      EditorView.lineWrapping,
      EditorView.contentAttributes.of({ "aria-label": "Text of the model", tabindex: "0" }),
      EditorView.updateListener.of((update) => {
        const own = update.transactions.some((one) => one.docChanged && !one.annotation(fromServer));
        if (update.docChanged && own) this.typed();
        if (update.docChanged) this.side?.refresh?.();
      }),
    ];
  }
}

export function shortName(path: string): string {
  return path.slice(path.lastIndexOf("/") + 1);
}
