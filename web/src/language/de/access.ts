import type { components } from "@/api/schema";
import { pluralIn } from "../language";
import type { AccessWords } from "../types";

type Role = components["schemas"]["Role"];
type KeyScope = components["schemas"]["Scope"];

const roles: Record<Role, { name: string; may: string }> = {
  viewer: { name: "Zuschauer", may: "sieht alles und darf den Roboter anhalten" },
  resident: { name: "Familie", may: "lädt das Auto und steckt es aus" },
  technician: { name: "Techniker", may: "lädt, bewegt von Hand, kalibriert und ändert Autos" },
  owner: { name: "Besitzer", may: "darf alles und entscheidet, wer was darf" },
};

const scopes: Record<KeyScope, string> = {
  read: "Zustand, Bilder und Aufzeichnungen lesen",
  operate: "Aufträge starten und beenden, anhalten",
  "charge-point": "Laden steuern, für Energiemanager",
  service: "Von Hand bewegen, kalibrieren, Autos ändern",
  admin: "Entscheiden, wer was darf",
};

const plural = pluralIn("de");

export const access: AccessWords = {
  roles,
  scopes,
  door: {
    opening: "Die Seite des Roboters wird geöffnet …",
    title: "Dieses Gerät ist noch nicht gekoppelt",
    how: "Nur wer dem Roboter bekannt ist, kann ihn sehen und benutzen. Dafür brauchen Sie einmal eine Einladung:",
    ways: [
      "Der Besitzer zeigt Ihnen einen QR-Code: Scannen Sie ihn mit der Kamera dieses Handys.",
      "Jemand hat Ihnen eine Adresse geschickt: Öffnen Sie sie auf diesem Gerät.",
      "Der Roboter gehört noch niemandem: Öffnen Sie die Adresse, die sein Terminal zeigt. „plugpilot pair“ zeigt eine neue.",
    ],
    paste: "Adresse der Einladung",
    use: "Dieses Gerät koppeln",
    passkey: "Meinen Passkey verwenden",
    failedTitle: "Das hat nicht geklappt",
    again: "Noch einmal versuchen",
    replaceTitle: (name) => `Dieses Gerät ist schon als ${name} gekoppelt`,
    replace:
      "Eine Einladung gilt nur einmal, und dieses Gerät gehört danach der eingeladenen Person.",
    replaceYes: "Die Einladung hier verwenden",
    replaceNo: "Alles lassen, wie es ist",
    screenTitle: "Scannen und Besitzer werden",
    screenHow:
      "Das erste Handy, das diesen Code scannt, gehört dem Besitzer. Er lädt dann alle anderen ein.",
    unreachable:
      "Andere Geräte erreichen diese Adresse nicht. Starten Sie PlugPilot mit --host 0.0.0.0.",
    kioskTitle: "Dieser Bildschirm hält den Roboter an",
    kioskHow: "Hier darf ihn jeder anhalten. Damit man hier auch laden kann, koppelt der Besitzer des Roboters diesen Bildschirm einmal.",
    stop: "Roboter anhalten",
    stopped: "Der Roboter steht.",
  },
  menu: "Personen und Geräte",
  tabs: { people: "Personen", keys: "Schlüssel", trail: "Verlauf", own: "Ich" },
  none: "Noch nichts.",
  loading: "Wird geladen …",
  people: {
    invite: "Jemanden einladen",
    name: "Name",
    role: "Was die Person darf",
    until: "Bis",
    forever: "ohne Ende",
    day: "für einen Tag",
    week: "für eine Woche",
    month: "für einen Monat",
    make: "Einladung erstellen",
    show: (name) => `Für ${name}`,
    scan: "Scannen Sie den Code mit dem Handy, das gekoppelt werden soll, oder schicken Sie die Adresse. Sie gilt einmal.",
    copy: "Adresse kopieren",
    copied: "Kopiert",
    done: "Fertig",
    lastUsed: "zuletzt benutzt",
    now: "gerade eben",
    ends: "bis",
    remove: "Entfernen",
    removePerson: (name) => `${name} entfernen`,
    sure: "Wirklich entfernen?",
    open: "Offene Einladungen",
    withdraw: "Zurückziehen",
    thisDevice: "dieses Gerät",
    noDevice: "noch kein Gerät",
    passkeys: (count) => plural(count, { one: "# Passkey", other: "# Passkeys" }),
  },
  keys: {
    hint: "Für Programme: Home Assistant, Energiemanager, Skripte. Ein Schlüssel wird nur einmal gezeigt.",
    make: "Schlüssel erstellen",
    name: "Wofür ist er?",
    once: "Kopieren Sie den Schlüssel jetzt. Er wird nicht aufbewahrt und kann nicht noch einmal gezeigt werden.",
    never: "nie benutzt",
    revoke: "Sperren",
  },
  trail: {
    security: "Nur Zugang",
    everything: "Alles",
    more: "Ältere zeigen",
    download: "Alles herunterladen",
    times: (count) => plural(count, { one: "einmal", other: "#-mal" }),
  },
  push: {
    begin: "Auf diesem Gerät benachrichtigen",
    stop: "Nicht mehr benachrichtigen",
    off: "Dieses Gerät kann Ihnen melden, wenn das Auto geladen ist, wenn etwas nicht geklappt hat und wenn der Roboter Sie braucht.",
    on: "Dieses Gerät meldet Ihnen, wenn das Auto geladen ist, wenn etwas nicht geklappt hat und wenn der Roboter Sie braucht.",
    blocked: "Dieser Browser sperrt Benachrichtigungen dieser Seite. In seinen Einstellungen lassen sie sich wieder erlauben.",
    impossible: "Benachrichtigungen brauchen https und einen Browser, der das kann. Sonst zeigt diese Seite, was geschieht, solange sie offen ist.",
  },
  own: {
    you: (name, role) => `Sie sind ${name} (${role}).`,
    another: "Ein weiteres Gerät von mir koppeln",
    passkey: "Passkey hinzufügen",
    passkeyHint:
      "Mit einem Passkey kommen Sie auf jedem Ihrer Geräte ohne Einladung wieder hinein.",
    passkeyNeeds:
      "Passkeys brauchen https und einen Namen statt einer Zahl: siehe „plugpilot serve --tls“.",
    signOut: "Dieses Gerät abmelden",
  },
  language: "Sprache",
  watching: "Sie können zusehen und den Roboter jederzeit anhalten.",
};
