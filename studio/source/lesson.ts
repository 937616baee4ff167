/** A lesson beside the plant: a text, the sliders that its author chose, questions, and goals that are checked. */
import type { Changes } from "./changes.js";
import { h, short } from "./elements.js";
import type { Growth, Statistics } from "./protocol.js";
import { SettingsPanel } from "./settings.js";
import type { Studio } from "./state.js";

export interface Goal {
  text: string;
  /** Of the statistics. */
  column: string;
  /** "": the mean over all. */
  plant: string;
  least: number | null;
  most: number | null;
}

interface Question {
  text: string;
  choices: string[];
  right: number;
  why: string;
}

/** What `espalier lesson` writes into a page. */
export interface Lesson {
  title: string;
  html: string;
  texts: "hidden" | "locked" | "free";
  sliders: string[];
  charts: string[];
  goals: Goal[];
  questions: Question[];
  /** Settings that reach the goals, as texts write them. */
  answer: Record<string, string>;
  /** The page of the lesson that follows; "": none. */
  next: string;
}

export function lessonOfPage(): Lesson | null {
  const text = document.getElementById("lesson")?.textContent;
  return text ? (JSON.parse(text) as Lesson) : null;
}

/** The mean of a goal's column over its plants, at a step; null if it is not known. */
export function valueOfGoal(goal: Goal, { columns, rows }: Statistics, step: number): number | null {
  const [at, name] = [columns.indexOf(goal.column), columns.indexOf("name")];
  const values = rows
    .filter((row) => row[0] === step && (goal.plant === "" || row[name] === goal.plant))
    .map((row) => row[at])
    .filter((value) => typeof value === "number");
  return values.length === 0 ? null : values.reduce((sum, value) => sum + value, 0) / values.length;
}

export function isReached({ least, most }: Goal, value: number | null): boolean {
  return value !== null && !(least !== null && value < least) && !(most !== null && value > most);
}

function boundsOf({ least, most }: Goal): string {
  if (least !== null && most !== null) return `${short(least)} to ${short(most)}`;
  return least !== null ? `at least ${short(least)}` : `at most ${short(most ?? 0)}`;
}

export class LessonPanel {
  readonly element: HTMLElement;
  private readonly goals = h("ul", "goals");
  private readonly verdict = h("p", "verdict", { "aria-live": "polite" });

  constructor(
    private readonly studio: Studio,
    private readonly changes: Changes,
    private readonly lesson: Lesson,
  ) {
    const text = h("div", "lesson-text");
    text.innerHTML = lesson.html; // cmark has left out what is no Markdown
    for (const link of text.querySelectorAll("a")) Object.assign(link, { target: "_blank", rel: "noopener" });
    const sliders = lesson.sliders.length > 0 && new SettingsPanel(studio, changes, lesson.sliders).element;
    const goals = lesson.goals.length > 0 && h("section", "", { "aria-label": "Goals" }, h("h3", "", {}, "Goals"), this.goals, this.verdict);
    const questions = lesson.questions.map((question, number) => questionOf(question, number));
    this.element = h("div", "lesson", {}, text, sliders, goals, ...questions, this.end());
    studio.on("growth", () => this.check());
    studio.on("statistics", () => this.check());
    this.check();
  }

  private end(): HTMLElement {
    const { answer, next } = this.lesson;
    const again = () => this.set(Object.fromEntries(this.known().map((name) => [name, null])), "Start again");
    const show = () => this.set(answer, "Show an answer");
    return h(
      "div",
      "lesson-end",
      {},
      h("button", "button small", { type: "button", onclick: again }, "Start again"),
      Object.keys(answer).length > 0 && h("button", "button small", { type: "button", onclick: show }, "Show an answer"),
      next !== "" && h("a", "button small primary", { href: next }, "Next lesson"),
    );
  }

  /** Settings that the lesson speaks of and the text has. */
  private known(): string[] {
    const { sliders, answer } = this.lesson;
    const there = new Set(this.studio.document?.settings.map(({ name }) => name));
    return [...new Set([...sliders, ...Object.keys(answer)])].filter((name) => there.has(name));
  }

  private set(settings: Record<string, string | null>, label: string): void {
    this.changes.lasting("lesson", { settings }, label);
  }

  /** A goal holds at the last step alone. */
  private check(): void {
    const { growth, statistics } = this.studio;
    const done = growth !== null && growth.state === "done" && growth.growth === statistics.growth;
    const values = this.lesson.goals.map((goal) => (done ? valueOfGoal(goal, statistics, growth.step) : null));
    const reached = this.lesson.goals.map((goal, i) => isReached(goal, values[i] ?? null));
    this.goals.replaceChildren(
      ...this.lesson.goals.map((goal, i) => {
        const now = values[i] ?? null;
        const said = now === null ? waiting(growth) : `${goal.column.replaceAll("_", " ")} is ${short(now)}, ${boundsOf(goal)} is asked for`;
        const mark = h("span", "mark", { "aria-label": reached[i] ? "reached" : "not yet reached" }, reached[i] ? "✓" : "○");
        return h("li", reached[i] ? "reached" : "", {}, mark, h("span", "", {}, goal.text, h("small", "", {}, said)));
      }),
    );
    const all = reached.length > 0 && reached.every(Boolean);
    this.element.dataset.goals = String(reached.filter(Boolean).length);
    if (done) this.verdict.textContent = all ? "All goals are reached." : "";
  }
}

function waiting(growth: Growth | null): string {
  return growth?.state === "failed" ? "nothing has grown" : "it grows …";
}

function questionOf({ text, choices, right, why }: Question, number: number): HTMLElement {
  const verdict = h("p", "verdict", { "aria-live": "polite" });
  const choice = (words: string, i: number) => {
    const chosen = () => {
      verdict.textContent = i === right ? `Right. ${why}` : "Not quite: try again.";
      verdict.classList.toggle("wrong", i !== right);
    };
    return h("label", "choice", {}, h("input", "", { type: "radio", name: `question-${number}`, onchange: chosen }), words);
  };
  return h("fieldset", "question", {}, h("legend", "", {}, text), ...choices.map(choice), verdict);
}
