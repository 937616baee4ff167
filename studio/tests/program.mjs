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

/** A herb in the light of a measured day, one step an hour; writes its scene, day.toml. */
export function writeDay(folder) {
  const hours = Array.from({ length: 26 }, (_, hour) => [hour, Math.max(0, 800 - 115 * Math.abs(hour - 12))]);
  const rows = hours.map(([hour, light]) => `${hour},${light},${0.2 * light}\n`);
  writeFileSync(join(folder, "day.csv"), ["time (h),global (W m-2),diffuse (W m-2)\n", ...rows].join(""));
  writeFileSync(
    join(folder, "herb.l"),
    "lsystem: 1\nderivation length: 20\naxiom: !(0.01) A\nA --> F(0.1) L /(137.5) A\nhomomorphism\n" +
      "L --> [ &(70) { . f(0.2) . +(90) f(0.1) . +(90) f(0.2) . } ]\nendlsystem\n",
  );
  writeFileSync(
    join(folder, "day.toml"),
    `[simulation]\nsteps = 20\ndt = ${1 / 24}\n[[plant]]\nmodel = "herb.l"\n[environment.light]\nprocess = "canopy-light"\n` +
      'voxel = 0.1\nsky = { series = "day.csv", latitude = 45, day = 172 }\n[timeline]\n',
  );
}

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
