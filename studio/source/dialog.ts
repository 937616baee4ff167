/** A dialog over the page. Escape and the cross close it. */
import { h, iconButton } from "./elements.js";

export function openDialog(title: string, ...content: Node[]): HTMLDialogElement {
  const dialog: HTMLDialogElement = h(
    "dialog",
    "dialog",
    { "aria-label": title },
    h(
      "header",
      "",
      {},
      h("h2", "", {}, title),
      iconButton("close", "Close", () => dialog.close()),
    ),
    h("div", "dialog-body", {}, ...content),
  );
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

/** A menu below a button. */
export function menuButton(
  button: HTMLButtonElement,
  entries: () => { name: string; hint?: string; on?: boolean; run: () => void }[],
): HTMLElement {
  const list = h("div", "menu", { role: "menu", hidden: true });
  const close = () => {
    list.hidden = true;
    button.setAttribute("aria-expanded", "false");
  };
  const open = () => {
    list.replaceChildren(
      ...entries().map(({ name, hint, on, run }) =>
        h(
          "button",
          "menu-entry",
          {
            type: "button",
            role: on === undefined ? "menuitem" : "menuitemcheckbox",
            "aria-checked": on === undefined ? null : String(on),
            onclick: () => {
              close();
              run();
            },
          },
          h("span", "", {}, name),
          hint ? h("small", "", {}, hint) : null,
        ),
      ),
    );
    list.hidden = false;
    button.setAttribute("aria-expanded", "true");
    list.querySelector("button")?.focus();
  };
  button.setAttribute("aria-haspopup", "menu");
  button.addEventListener("click", () => (list.hidden ? open() : close()));
  const holder = h("div", "menu-holder", {}, button, list);
  holder.addEventListener("keydown", (event) => {
    if (event.key === "Escape") {
      close();
      button.focus();
    }
    const by = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (by === 0 || list.hidden) return;
    event.preventDefault();
    const buttons = [...list.querySelectorAll("button")];
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    buttons[(at + by + buttons.length) % buttons.length]?.focus();
  });
  document.addEventListener("pointerdown", (event) => {
    if (!holder.contains(event.target as Node)) close();
  });
  return holder;
}
