/** Highlighting of TOML: scenes and species. */
import { LanguageSupport, StreamLanguage, type StringStream } from "@codemirror/language";

interface State {
  text: string | null;
  value: boolean;
}

function insideText(stream: StringStream, state: State): string {
  const end = state.text ?? "";
  if (stream.skipTo(end)) {
    stream.match(end);
    state.text = null;
  } else stream.skipToEnd();
  return "string";
}

function token(stream: StringStream, state: State): string | null {
  if (state.text) return insideText(stream, state);
  if (stream.sol()) state.value = false;
  if (stream.eatSpace()) return null;
  if (stream.match(/^#.*/)) return "comment";
  if (!state.value && stream.match(/^\[\[?[^\]]*\]\]?/)) return "heading";
  for (const quotes of ['"""', "'''"]) {
    if (!stream.match(quotes)) continue;
    state.text = quotes;
    return insideText(stream, state);
  }
  if (stream.match(/^"(?:[^"\\]|\\.)*"?/) || stream.match(/^'[^']*'?/)) return "string";
  if (stream.match(/^[-+]?\d[\d_]*(?:\.\d+)?(?:[eE][-+]?\d+)?/)) return "number";
  if (stream.match(/^(?:true|false|inf|nan)\b/)) return "atom";
  if (stream.match(/^[A-Za-z0-9_.-]+(?=\s*=)/)) return "propertyName";
  if (stream.next() === "=") state.value = true;
  return null;
}

const language = StreamLanguage.define<State>({
  name: "toml",
  startState: () => ({ text: null, value: false }),
  copyState: (state) => ({ ...state }),
  token,
  languageData: { commentTokens: { line: "#" } },
});

export function toml(): LanguageSupport {
  return new LanguageSupport(language);
}
