import type { ConfigWords } from "../types";

export const config: ConfigWords = {
  title: "Configurazione",
  hint: "Impostazioni, versioni",
  loading: "Lettura delle impostazioni…",
  notAllowed: "Solo i proprietari leggono e cambiano le impostazioni.",
  atOnce: "Vale subito, senza riavvio.",
  empty: "Vuoto: come all’avvio di PlugPilot.",
  limits: (least, most) => {
    if (least !== null && most !== null) return `Da ${String(least)} a ${String(most)}.`;
    if (least !== null) return `Almeno ${String(least)}.`;
    return most === null ? "" : `Al massimo ${String(most)}.`;
  },
  noNumber: "Questo non è un numero.",
  noJson: "Questo non è JSON, come [1, 2] o [\"a\"].",
  differences: "Che cosa cambierebbe",
  none: "Nulla è stato cambiato.",
  wrong: "Correggere prima i campi segnati.",
  save: "Salva",
  saving: "Salvataggio…",
  saved: "Salvato. Ora vale.",
  discard: "Scarta",
  nothing: "(vuoto)",
  versions: "Versioni",
  start: "Come all’avvio di PlugPilot",
  now: "in vigore",
  back: "Torna qui",
  sure: "Premere ancora",
  noChanges: "nessun cambiamento",
  file: "Impostazioni che richiedono un riavvio",
  fileHint:
    "Stanno nel file di configurazione, perché da loro dipendono movimenti, forze o connessioni. Cambiarle lì, poi riavviare PlugPilot.",
  find: "Cerca un’impostazione",
  name: "Impostazione",
  value: "Valore in vigore",
  count: (shown, all) => `${String(shown)} di ${String(all)} impostazioni`,
};
