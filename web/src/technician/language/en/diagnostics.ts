/** Every sentence of the panel for diagnostics and versions. */
export const diagnostics = {
  title: "Diagnostics and versions",
  hint: "One file for whoever helps",
  explain:
    "State, settings, versions, the newest log, audit trail, jobs and a second of the link to the board, in one zip file. Passwords and keys are hidden; names of people and addresses in the home are not.",
  notAllowed: "Only an owner may download it.",
  download: "Download diagnostics",
  collecting: "Collecting, a second or two…",
  done: (kilobytes: number): string => `Downloaded, ${String(kilobytes)} kB.`,
  versions: "Versions",
  loading: "Reading the versions…",
  software: "PlugPilot",
  board: "Motion board",
  firmware: "Firmware",
  protocol: "Protocol",
  python: "Python",
  system: "System",
  unknown: "not known yet",
  libraries: "Libraries",
  unreachable: {
    code: "unreachable",
    title: "No answer",
    detail: "The robot did not send the file.",
    remedy: "Check the connection, then try again.",
  },
  file: "plugpilot-diagnostics.zip",
};
