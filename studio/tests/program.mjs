// Starts the real program on a folder of its own.
import { spawn } from "node:child_process";
import { mkdtempSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout } from "node:timers/promises";

/** The tree of the tests: settings with bounds, a switch, parameters with a history. */
export const tree = `/* A tree for tests

   Try: espalier studio tree.l */

#define ANGLE 32      /* angle of branches; 5..80; degrees */
#define RATIO 0.8     /* of lengths; 0.5..0.95 */
#define CURLY 0       /* whether branches curl; 0..1 whole */

module Apex(age, length), Internode(age, length);

lsystem: 1
derivation length: 8
axiom: Apex(0, 1)
Apex(age, length) --> Internode(0, length)
	[ &(ANGLE + CURLY * 30) Apex(0, length * RATIO) ] /(137.5 + ran(20)) [ &(ANGLE) Apex(0, length * RATIO) ] /(90) Apex(age + 1, length * RATIO)
Internode(age, length) --> Internode(age + 1, length * 1.02)

homomorphism
Internode(age, length) --> !(0.02 * (age + 1)) F(length)
endlsystem
`;

export function workFolder() {
  const base = mkdtempSync(join(tmpdir(), "espalier-studio-"));
  const folder = join(base, "plants");
  mkdirSync(folder);
  writeFileSync(join(folder, "tree.l"), tree);
  return { base, folder };
}

/** Until what the program keeps of its work, for a crash, has all these words. */
export async function keeps({ base }, ...words) {
  const folder = join(base, "state", "espalier");
  const kept = () => readdirSync(folder).map((name) => readFileSync(join(folder, name), "utf8"));
  for (let tries = 0; tries < 600; tries++) {
    if (kept().some((text) => words.every((word) => text.includes(word)))) return;
    await setTimeout(50);
  }
  throw new Error(`${words} is not kept`);
}

/** The running program and its address. */
export async function startProgram(path, { base, folder }, args = []) {
  const environment = { ...process.env, XDG_STATE_HOME: join(base, "state") };
  const program = spawn(path, ["studio", "--no-browser", "--folder", folder, ...args], { cwd: folder, env: environment });
  const address = await new Promise((found, failed) => {
    let text = "";
    const read = (data) => {
      text += data;
      const match = /http:\/\/\S+#token=\S+/.exec(text);
      if (match) found(match[0]);
    };
    program.stdout.on("data", read);
    program.stderr.on("data", read);
    program.on("exit", (code) => failed(new Error(`the program ended with ${code}:\n${text}`)));
  });
  const ended = new Promise((done) => program.on("exit", done));
  return {
    address,
    kill: async (signal = "SIGTERM") => {
      program.kill(signal);
      await ended;
    },
  };
}
