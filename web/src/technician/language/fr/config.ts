import type { ConfigWords } from "../types";

export const config: ConfigWords = {
  title: "Configuration",
  hint: "Réglages, versions",
  loading: "Lecture des réglages…",
  notAllowed: "Seuls les propriétaires lisent et changent les réglages.",
  atOnce: "Prend effet aussitôt, sans redémarrage.",
  empty: "Vide\u00a0: comme au démarrage de PlugPilot.",
  limits: (least, most) => {
    if (least !== null && most !== null) return `De ${String(least)} à ${String(most)}.`;
    if (least !== null) return `Au moins ${String(least)}.`;
    return most === null ? "" : `Au plus ${String(most)}.`;
  },
  noNumber: "Ce n’est pas un nombre.",
  noJson: "Ce n’est pas du JSON, comme [1, 2] ou [\"a\"].",
  differences: "Ce qui changerait",
  none: "Rien n’a été changé.",
  wrong: "Corrigez d’abord les champs marqués.",
  save: "Enregistrer",
  saving: "Enregistrement…",
  saved: "Enregistré. C’est en vigueur.",
  discard: "Abandonner",
  nothing: "(vide)",
  versions: "Versions",
  start: "Comme au démarrage de PlugPilot",
  now: "en vigueur",
  back: "Y revenir",
  sure: "Appuyez encore",
  noChanges: "aucun changement",
  file: "Réglages qui demandent un redémarrage",
  fileHint:
    "Ils sont dans le fichier de configuration, car des mouvements, des forces ou des connexions en dépendent. Changez-les là, puis redémarrez PlugPilot.",
  find: "Chercher un réglage",
  name: "Réglage",
  value: "Valeur en vigueur",
  count: (shown, all) => `${String(shown)} réglages sur ${String(all)}`,
};
