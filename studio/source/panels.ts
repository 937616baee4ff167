/** How the settings of a document stand in groups: by their headings, or as its author has laid them out. */
import type { Setting, StudioDocument } from "./protocol.js";

/** A setting as it shows; `step`: between values of its slider. */
export type ShownSetting = Setting & { step?: number };

export interface Group {
  title: string;
  /** How many stand side by side where there is room. */
  columns: number;
  open: boolean;
  settings: ShownSetting[];
}

export function byHeading(settings: readonly Setting[]): Group[] {
  const groups = new Map<string, Setting[]>();
  for (const setting of settings) groups.set(setting.group, [...(groups.get(setting.group) ?? []), setting]);
  return [...groups].map(([title, inside]) => ({ title, columns: 1, open: true, settings: inside }));
}

/** What a panel says of a slider replaces what the setting says of itself. */
export function asLaidOut({ panels, settings }: Pick<StudioDocument, "panels" | "settings">): Group[] {
  const known = new Map(settings.map((setting) => [setting.name, setting]));
  return panels.map(({ title, columns, open, sliders }) => ({
    title,
    columns,
    open,
    settings: sliders.flatMap((slider): ShownSetting[] => {
      const setting = known.get(slider.name);
      if (!setting) return [];
      return [
        {
          ...setting,
          label: slider.label ?? setting.label,
          unit: slider.unit ?? setting.unit,
          lowest: slider.lowest ?? setting.lowest,
          highest: slider.highest ?? setting.highest,
          ...(slider.step === null ? {} : { step: slider.step }),
        },
      ];
    }),
  }));
}

/** The text of panels with all settings of a model, as they stand. */
export function panelText(settings: readonly Setting[]): string {
  const tables = byHeading(settings).map(
    (group) => `[[panel]]\ntitle = ${JSON.stringify(group.title || "Settings")}\nsettings = [\n${group.settings.map(sliderText).join("")}]\n`,
  );
  return tables.join("\n");
}

function sliderText({ name, label, lowest, highest }: Setting): string {
  const ends = `${lowest === null ? "" : `, lowest = ${lowest}`}${highest === null ? "" : `, highest = ${highest}`}`;
  return `  { name = ${JSON.stringify(name)}, label = ${JSON.stringify(label)}${ends} },\n`;
}
