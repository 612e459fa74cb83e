import type { components } from "@/api/schema";
import { pluralIn } from "../language";
import type { AccessWords } from "../types";

type Role = components["schemas"]["Role"];
type KeyScope = components["schemas"]["Scope"];

const roles: Record<Role, { name: string; may: string }> = {
  viewer: { name: "Osservatore", may: "vede tutto e può fermare il robot" },
  resident: { name: "Famiglia", may: "ricarica e scollega l’auto" },
  technician: { name: "Tecnico", may: "ricarica, muove a mano, calibra e modifica le auto" },
  owner: { name: "Proprietario", may: "fa tutto e decide chi può fare che cosa" },
};

const scopes: Record<KeyScope, string> = {
  read: "Leggere stato, immagini e registrazioni",
  operate: "Avviare e terminare attività, fermare",
  "charge-point": "Comandare la ricarica, per i gestori di energia",
  service: "Muovere a mano, calibrare, modificare le auto",
  admin: "Decidere chi può fare che cosa",
};

const plural = pluralIn("it");

export const access: AccessWords = {
  roles,
  scopes,
  door: {
    opening: "Apertura della pagina del robot…",
    title: "Questo dispositivo non è ancora abbinato",
    how: "Solo le persone che il robot conosce possono vederlo e usarlo. Serve un invito, una volta sola:",
    ways: [
      "Il proprietario mostra un codice QR: inquadrarlo con la fotocamera di questo telefono.",
      "Qualcuno ha inviato un indirizzo: aprirlo su questo dispositivo.",
      "Il robot non è ancora di nessuno: aprire l’indirizzo mostrato nel suo terminale. «plugpilot pair» ne mostra uno nuovo.",
    ],
    paste: "Indirizzo dell’invito",
    use: "Abbina questo dispositivo",
    passkey: "Usa la mia passkey",
    failedTitle: "Non ha funzionato",
    again: "Riprova",
    replaceTitle: (name) => `Questo dispositivo è già abbinato a ${name}`,
    replace:
      "Un invito vale una volta sola; dopo, questo dispositivo apparterrà alla persona invitata.",
    replaceYes: "Usa l’invito qui",
    replaceNo: "Lascia tutto com’è",
    screenTitle: "Inquadrare per diventare proprietario",
    screenHow:
      "Il primo telefono che inquadra questo codice diventa quello del proprietario, che poi invita tutti gli altri.",
    unreachable:
      "Gli altri dispositivi non raggiungono questo indirizzo. Avviare PlugPilot con --host 0.0.0.0.",
    kioskTitle: "Questo schermo ferma il robot",
    kioskHow: "Chiunque può fermarlo qui. Per ricaricare anche da qui, il proprietario del robot abbina una volta questo schermo.",
    stop: "Ferma il robot",
    stopped: "Il robot si è fermato.",
  },
  menu: "Persone e dispositivi",
  tabs: { people: "Persone", keys: "Chiavi", trail: "Attività", own: "Io" },
  none: "Ancora nulla.",
  loading: "Caricamento…",
  people: {
    invite: "Invita qualcuno",
    name: "Nome",
    role: "Che cosa può fare",
    until: "Fino a",
    forever: "senza scadenza",
    day: "per un giorno",
    week: "per una settimana",
    month: "per un mese",
    make: "Crea l’invito",
    show: (name) => `Per ${name}`,
    scan: "Inquadrare con il telefono da abbinare, o inviare l’indirizzo. Vale una volta sola.",
    copy: "Copia l’indirizzo",
    copied: "Copiato",
    done: "Fatto",
    lastUsed: "ultimo uso",
    now: "proprio ora",
    ends: "fino al",
    remove: "Rimuovi",
    removePerson: (name) => `Rimuovi ${name}`,
    sure: "Rimuovere davvero?",
    open: "Inviti aperti",
    withdraw: "Ritira",
    thisDevice: "questo dispositivo",
    noDevice: "ancora nessun dispositivo",
    passkeys: (count) => plural(count, { one: "# passkey", other: "# passkey" }),
  },
  keys: {
    hint: "Per i programmi: Home Assistant, gestori di energia, script. Una chiave si vede una volta sola.",
    make: "Crea una chiave",
    name: "A che cosa serve?",
    once: "Copiare subito la chiave. Non viene conservata e non si potrà più mostrare.",
    never: "mai usata",
    revoke: "Revoca",
  },
  trail: {
    security: "Solo accessi",
    everything: "Tutto",
    more: "Mostra i precedenti",
    download: "Scarica tutto",
    times: (count) => plural(count, { one: "una volta", other: "# volte" }),
  },
  push: {
    begin: "Avvisami su questo dispositivo",
    stop: "Non avvisarmi più",
    off: "Questo dispositivo può avvisare quando l’auto è carica, quando qualcosa non ha funzionato e quando il robot ha bisogno di aiuto.",
    on: "Questo dispositivo avvisa quando l’auto è carica, quando qualcosa non ha funzionato e quando il robot ha bisogno di aiuto.",
    blocked: "Questo browser blocca le notifiche di questa pagina. Le sue impostazioni permettono di riattivarle.",
    impossible: "Le notifiche richiedono https e un browser che le conosca. Altrimenti questa pagina mostra che cosa succede finché è aperta.",
  },
  own: {
    you: (name, role) => `${name} (${role.toLowerCase()})`,
    another: "Abbina un altro mio dispositivo",
    passkey: "Aggiungi una passkey",
    passkeyHint:
      "Con una passkey si rientra da qualsiasi proprio dispositivo, senza invito.",
    passkeyNeeds:
      "Le passkey richiedono https e un nome, non un numero: vedere «plugpilot serve --tls».",
    signOut: "Esci da questo dispositivo",
  },
  language: "Lingua",
  watching: "Si può guardare, e fermare il robot in qualsiasi momento.",
};
