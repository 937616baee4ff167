/** Highlighting of the notations whose lines begin with a name: graphs of components, skeleton descriptions. */
import { LanguageSupport, StreamLanguage, type StringStream } from "@codemirror/language";

interface State {
  comment: boolean;
  /** Words on this line so far. */
  words: number;
  indented: boolean;
}

function blockComment(stream: StringStream, state: State): string {
  state.comment = !stream.skipTo("*/");
  if (state.comment) stream.skipToEnd();
  else stream.match("*/");
  return "comment";
}

function word(stream: StringStream, state: State): string {
  const first = state.words++ === 0;
  if (first && !state.indented) return "keyword";
  if (first) return "propertyName";
  if (state.words === 2 && !state.indented) return "typeName";
  return stream.peek() === "(" ? "variableName" : "atom";
}

function token(stream: StringStream, state: State): string | null {
  if (stream.sol()) Object.assign(state, { words: 0, indented: /^\s/.test(stream.string) });
  if (state.comment) return blockComment(stream, state);
  if (stream.eatSpace()) return null;
  if (stream.match("/*")) return blockComment(stream, state);
  if (stream.match(/^\/\/.*/)) return "comment";
  if (stream.match(/^#\w+/)) return "meta";
  if (stream.match(/^"[^"]*"?/)) return "string";
  if (stream.match(/^(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/)) return "number";
  if (stream.match(/^[A-Za-z_]\w*/)) return word(stream, state);
  if (stream.match(/^(?:->|\.\.)/)) return "keyword";
  stream.next();
  return null;
}

const language = StreamLanguage.define<State>({
  name: "notation",
  startState: () => ({ comment: false, words: 0, indented: false }),
  copyState: (state) => ({ ...state }),
  token,
  languageData: { commentTokens: { line: "//", block: { open: "/*", close: "*/" } } },
});

export function notation(): LanguageSupport {
  return new LanguageSupport(language);
}
