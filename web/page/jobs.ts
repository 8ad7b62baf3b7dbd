/** What the page can do: for each job the flags of the command that the form has. */

export type Field = { flag: string; label: string; help?: string } & (
  | { kind: "number" | "text"; value?: string; required?: boolean }
  | { kind: "switch" }
  | { kind: "choice"; options: [value: string, label: string][]; value: string }
);

export interface Job {
  name: "identify" | "autotune" | "predict" | "design";
  title: string;
  about: string;
  logs: boolean;
  fields: Field[];
}

const number = (flag: string, label: string, value?: string, required = false): Field => ({ flag, label, kind: "number", value, required });
const columns: Field[] = [
  { flag: "time", label: "Column of times", kind: "text" },
  { flag: "output", label: "Column of the measured value", kind: "text" },
  { flag: "input", label: "Column of the command", kind: "text" },
];
const cut: Field[] = [number("from", "From time (s)"), number("to", "To time (s)")];
const axis: Field[] = [
  number("alpha", "Inertia alpha", undefined, true),
  number("beta", "Linear drag beta"),
  number("beta-quadratic", "Quadratic drag"),
  number("delta", "Constant force delta"),
  number("delay", "Delay (s)"),
];
const skip: Field = { flag: "skip-bad-rows", label: "Leave out rows without three numbers", kind: "switch" };
const hold: Field = { flag: "hold-command", label: "A blank command holds the last one", kind: "switch" };

export const jobs: Job[] = [
  {
    name: "identify",
    title: "Identify a vehicle",
    about: "Inertia, drag, constant force and delay of one axis from logs of a relay experiment.",
    logs: true,
    fields: [
      { flag: "delay", label: "Delay (s)", kind: "text", help: "empty: estimated" },
      number("relay", "Relay level in physical units"),
      number("half-width", "Half-width of the hysteresis"),
      { flag: "drag", label: "Drag law", kind: "choice", value: "", options: [["", "found"], ["linear", "linear"], ["quadratic", "quadratic"], ["mixed", "mixed"]] },
      ...columns,
      number("neutral", "Neutral command"),
      ...cut,
      number("part", "Part of a log whose clock starts again"),
      { flag: "time-unit", label: "Unit of times", kind: "choice", value: "", options: [["", "by the column's name"], ["s", "s"], ["ms", "ms"], ["us", "us"], ["ns", "ns"]] },
      { flag: "degrees", label: "Output in degrees", kind: "switch" },
      { flag: "radians", label: "Output in radians", kind: "switch" },
      { flag: "wrap", label: "Output jumps by a turn", kind: "switch" },
      { flag: "invert", label: "Command logged with the opposite sign", kind: "switch" },
      { flag: "even-stamps", label: "Samples evenly spaced", kind: "switch" },
      skip,
      hold,
    ],
  },
  {
    name: "autotune",
    title: "Tune a process",
    about: "PI or PID gains for a heater, a tank, an axis: from one record of its relay, thermostat or on-off control.",
    logs: true,
    fields: [
      {
        flag: "form",
        label: "Gains for",
        kind: "choice",
        value: "parallel",
        options: [
          ["parallel", "Kp, Ki, Kd"],
          ["ideal", "ISA: K, Ti, Td"],
          ["series", "series"],
          ["klipper", "Klipper"],
          ["marlin", "Marlin"],
          ["reprap", "RepRapFirmware"],
          ["esphome", "ESPHome"],
        ],
      },
      number("ms", "Largest sensitivity", "1.4"),
      { flag: "pi", label: "Without derivative", kind: "switch" },
      number("interval", "Time between two commands (s)"),
      number("full-power", "Command at full power"),
      ...columns,
      ...cut,
      skip,
      hold,
    ],
  },
  {
    name: "predict",
    title: "Predict an oscillation",
    about: "Amplitude, period and bias that a relay makes of a known axis, exactly and with proof.",
    logs: false,
    fields: [...axis, number("relay", "Relay level", undefined, true), number("half-width", "Half-width of the hysteresis", undefined, true)],
  },
  {
    name: "design",
    title: "Design an experiment",
    about: "Relay level and half-width that determine the inertia best, from a rough model and a sensor.",
    logs: false,
    fields: [
      ...axis,
      number("level", "Largest relay level", undefined, true),
      number("time", "Length of a record (s)", undefined, true),
      number("rate", "Samples per second", "10"),
      number("quantum", "Step of the sensor"),
      number("noise", "Standard deviation of the noise"),
      number("largest-amplitude", "Largest amplitude"),
    ],
  },
];

/** The controller's form, shown under a model that can be trusted. */
export const tune: Field[] = [
  { flag: "structure", label: "Controller", kind: "choice", value: "pd", options: [["pd", "PD"], ["pid", "PID"], ["ipd", "I-PD"]] },
  number("ms", "Largest sensitivity", "1.8"),
  {
    flag: "format",
    label: "Gains for",
    kind: "choice",
    value: "text",
    options: [["text", "a person"], ["ardusub", "ArduSub"], ["px4", "PX4"], ["c", "C"]],
  },
  number("full-command", "Command at full output", "1"),
];
