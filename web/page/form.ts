/** A form for fields, its arguments for the command, and its state in the address. */
import { h } from "./element";
import type { Field } from "./jobs";

export class Form {
  readonly element = h("div", { class: "fields" });
  private inputs = new Map<string, HTMLInputElement | HTMLSelectElement>();

  constructor(
    private fields: Field[],
    prefix: string,
    changed: () => void,
  ) {
    for (const field of fields) {
      const id = `${prefix}-${field.flag}`;
      const input = control(field, id);
      input.addEventListener("change", changed);
      this.inputs.set(field.flag, input);
      const label = h("label", { for: id }, field.label, field.help && h("small", {}, ` (${field.help})`));
      this.element.append(h("div", { class: field.kind === "switch" ? "field switch" : "field" }, label, input));
    }
  }

  /** The flags that are set, as arguments. */
  get args(): string[] {
    return this.fields.flatMap((field) => {
      const value = this.value(field.flag);
      if (value === "" || value === false) return [];
      return value === true ? [`--${field.flag}`] : [`--${field.flag}=${value}`];
    });
  }

  /** What differs from the defaults, as a query. */
  get settings(): [string, string][] {
    const initial = (field: Field) => (field.kind === "switch" ? false : (field.value ?? ""));
    return this.fields.flatMap((field) => (this.value(field.flag) === initial(field) ? [] : [[field.flag, String(this.value(field.flag))] as [string, string]]));
  }

  restore(settings: URLSearchParams): void {
    for (const [flag, value] of settings) this.set(flag, value);
  }

  /** Whether the form has such a flag; of a switch it is set, of others focused. */
  offer(flag: string): boolean {
    const input = this.inputs.get(flag);
    if (!input) return false;
    if (input.type === "checkbox") (input as HTMLInputElement).checked = true;
    else {
      input.closest("details")?.setAttribute("open", "");
      input.focus();
    }
    return input.type === "checkbox";
  }

  has(flag: string): boolean {
    return this.inputs.has(flag);
  }

  private value(flag: string): string | boolean {
    const input = this.inputs.get(flag)!;
    return input.type === "checkbox" ? (input as HTMLInputElement).checked : input.value.trim();
  }

  private set(flag: string, value: string): void {
    const input = this.inputs.get(flag);
    if (input?.type === "checkbox") (input as HTMLInputElement).checked = value === "true";
    else if (input) input.value = value;
  }
}

function control(field: Field, id: string): HTMLInputElement | HTMLSelectElement {
  if (field.kind === "choice") return h("select", { id }, ...field.options.map(([value, label]) => h("option", { value, selected: value === field.value }, label)));
  if (field.kind === "switch") return h("input", { id, type: "checkbox" });
  return h("input", { id, type: "text", inputmode: field.kind === "number" ? "decimal" : undefined, value: field.value, required: field.required, autocomplete: "off", spellcheck: "false" });
}
