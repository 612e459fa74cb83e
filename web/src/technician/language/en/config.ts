/** Every sentence of the configuration's panel. */
export const config = {
  title: "Configuration",
  hint: "Settings, differences, versions",
  loading: "Reading the settings…",
  notAllowed: "Only an owner may read and change the settings.",
  atOnce: "Takes effect at once, without a restart.",
  empty: "Empty: as PlugPilot was started.",
  limits: (least: number | null, most: number | null): string => {
    if (least !== null && most !== null) return `${String(least)} to ${String(most)}.`;
    if (least !== null) return `At least ${String(least)}.`;
    return most === null ? "" : `At most ${String(most)}.`;
  },
  noNumber: "This is not a number.",
  noJson: "This is not JSON, such as [1, 2] or [\"a\"].",
  differences: "What would change",
  none: "Nothing has been changed.",
  wrong: "Correct the marked fields first.",
  save: "Save",
  saving: "Saving…",
  saved: "Saved. It is in force now.",
  discard: "Discard",
  nothing: "(empty)",
  versions: "Versions",
  start: "As PlugPilot was started",
  now: "in force",
  back: "Go back to this",
  sure: "Press again to go back",
  noChanges: "no changes",
  file: "Settings that need a restart",
  fileHint:
    "These stand in the configuration file, because motion, forces or connections depend on them. Change them there, then start PlugPilot again.",
  find: "Find a setting",
  name: "Setting",
  value: "Value in force",
  count: (shown: number, all: number): string => `${String(shown)} of ${String(all)} settings`,
};
