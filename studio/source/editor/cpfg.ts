/** Highlighting of the model language (docs/language.md). */
import { LanguageSupport, StreamLanguage, type StringStream } from "@codemirror/language";
import { tags } from "@lezer/highlight";

interface State {
  comment: boolean;
  directive: boolean;
  /** Depth of braces: inside them stand statements. */
  braces: number;
}

const headers =
  /^(?:derivation length|maximum depth|time step|ageing|ring L-system|production|seed|axiom|ignore|consider|define|external|StartEach|EndEach|Start|End|lsystem|environment|module|const|field|include)\s*:/;
const sections = /^(?:decomposition|homomorphism|interpretation|timed|endlsystem|endgroup|warnings|no warnings|group)\b/;
const declarations = /^(?:module|const|field|environment|array)\b/;
const statements = new Set([
  "if",
  "else",
  "while",
  "do",
  "for",
  "break",
  "nproduce",
  "produce",
  "array",
  "const",
  "float",
  "int",
]);

function blockComment(stream: StringStream, state: State): string {
  state.comment = !stream.skipTo("*/");
  if (state.comment) stream.skipToEnd();
  else stream.match("*/");
  return "comment";
}

function lineStart(stream: StringStream, state: State): string | null {
  if (stream.match(/^#\s*(?:define|undef|include|if|ifdef|ifndef|elif|else|endif|error|line|pragma)\b/)) {
    state.directive = true;
    return "meta";
  }
  if (stream.match(headers)) return "keyword";
  if (stream.match(sections)) return "keyword";
  if (stream.match(declarations)) return "keyword";
  return null;
}

function word(stream: StringStream, state: State): string {
  const text = stream.current();
  if (state.braces > 0 && statements.has(text)) return "controlKeyword";
  if (stream.peek() !== "(") return state.braces > 0 || state.directive ? "variableName" : "typeName";
  return state.braces > 0 || /^[a-z]{2,}$/.test(text) ? "function" : "typeName";
}

function token(stream: StringStream, state: State): string | null {
  if (state.comment) return blockComment(stream, state);
  if (stream.sol()) {
    state.directive = false;
    if (stream.eatSpace()) return null;
    const start = lineStart(stream, state);
    if (start) return start;
  }
  if (stream.eatSpace()) return null;
  if (stream.match("/*")) return blockComment(stream, state);
  if (stream.match("//")) {
    stream.skipToEnd();
    return "comment";
  }
  if (stream.match(/^(?:-->|=>|\?->)/)) return "arrow";
  if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return "string";
  if (stream.match(/^(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/)) return "number";
  if (stream.match(/^@[A-Za-z]{1,2}/)) return "symbol";
  if (stream.match(/^[A-Za-z_][A-Za-z0-9_]*/)) return word(stream, state);
  const sign = stream.next();
  if (sign === "{") state.braces++;
  if (sign === "}") state.braces = Math.max(0, state.braces - 1);
  if (sign && "[]".includes(sign)) return "squareBracket";
  if (sign && "+-&^/\\|!#;,~$%?".includes(sign) && state.braces === 0) return "symbol";
  return null;
}

const language = StreamLanguage.define<State>({
  name: "cpfg",
  startState: () => ({ comment: false, directive: false, braces: 0 }),
  copyState: (state) => ({ ...state }),
  token,
  tokenTable: {
    arrow: tags.definitionKeyword,
    symbol: tags.operator,
    function: tags.function(tags.variableName),
    controlKeyword: tags.controlKeyword,
  },
  languageData: { commentTokens: { block: { open: "/*", close: "*/" } }, closeBrackets: { brackets: ["(", "[", "{"] } },
});

export function cpfg(): LanguageSupport {
  return new LanguageSupport(language);
}
