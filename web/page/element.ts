/** Elements from tags, attributes and children. Text is always text: no string becomes markup. */

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | boolean | number | EventListener | undefined>;

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return element;
}

/** A table with a caption; the first cell of a row heads it. */
export function table(caption: string, head: string[], rows: Child[][]): HTMLElement {
  const cell = (child: Child, index: number) => (index === 0 ? h("th", { scope: "row" }, child) : h("td", {}, child));
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    h(
      "table",
      {},
      h("caption", {}, caption),
      h("thead", {}, h("tr", {}, ...head.map((name) => h("th", { scope: "col" }, name)))),
      h("tbody", {}, ...rows.map((row) => h("tr", {}, ...row.map(cell)))),
    ),
  );
}

/** Text with a button that copies it. */
export function copyable(title: string, text: string): HTMLElement {
  const done = h("span", { role: "status" });
  const copy = () => {
    navigator.clipboard.writeText(text).then(
      () => (done.textContent = " copied"),
      () => (done.textContent = " not copied: select the text"),
    );
  };
  return h("figure", { class: "copyable" }, h("figcaption", {}, title, " ", h("button", { type: "button", click: copy }, "Copy"), done), h("pre", { tabindex: 0 }, text));
}

/** A link that saves bytes as a file. */
export function download(label: string, name: string, type: string, bytes: BlobPart): HTMLElement {
  const save = () => {
    const url = URL.createObjectURL(new Blob([bytes], { type }));
    h("a", { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60_000);
  };
  return h("button", { type: "button", click: save }, label);
}
