/** What a notification says. It comes while no page is open, so its words are here. */
import type { Language } from "@/language/language";

/** As server/push/messages.py makes it. */
interface Message {
  readonly kind: "charged" | "ended" | "failed" | "needs_person";
  readonly language: Language;
  /** In English only. */
  readonly detail: string;
  readonly energy_wh: number | null;
}

export interface Notice {
  readonly title: string;
  readonly body: string;
  readonly lang: Language;
  /** It stays until somebody has seen it. */
  readonly stays: boolean;
}

interface Words {
  readonly charged: (energy: string) => string;
  readonly ended: string;
  readonly failed: string;
  readonly needs_person: string;
  readonly drive: string;
  readonly look: string;
  readonly news: string;
}

const WORDS: Readonly<Record<Language, Words>> = {
  en: {
    charged: (energy) => `The car is charged: ${energy}`,
    ended: "The robot is done",
    failed: "That did not work",
    needs_person: "The robot needs you",
    drive: "The plug is out of the car.",
    look: "Touch to see what to do.",
    news: "Touch to see how it is.",
  },
  fr: {
    charged: (energy) => `La voiture est chargée\u00a0: ${energy}`,
    ended: "Le robot a terminé",
    failed: "Cela n’a pas marché",
    needs_person: "Le robot a besoin de vous",
    drive: "Le connecteur est sorti de la voiture.",
    look: "Touchez pour voir que faire.",
    news: "Touchez pour voir ce qu’il en est.",
  },
  de: {
    charged: (energy) => `Das Auto ist geladen: ${energy}`,
    ended: "Der Roboter ist fertig",
    failed: "Das hat nicht geklappt",
    needs_person: "Der Roboter braucht Sie",
    drive: "Der Stecker ist aus dem Auto.",
    look: "Tippen Sie darauf, um zu sehen, was zu tun ist.",
    news: "Tippen Sie darauf, um zu sehen, wie es steht.",
  },
  it: {
    charged: (energy) => `L’auto è carica: ${energy}`,
    ended: "Il robot ha finito",
    failed: "Non ha funzionato",
    needs_person: "Il robot ha bisogno di aiuto",
    drive: "La spina è fuori dall’auto.",
    look: "Toccare per vedere che cosa fare.",
    news: "Toccare per vedere come va.",
  },
};

/** What to show for a message; also one that makes no sense is shown, as browsers demand. */
export function noticeOf(text: string): Notice {
  const { kind, language, detail, energy_wh } = parse(text);
  const say = WORDS[language];
  const base = { lang: language, stays: false };
  switch (kind) {
    case "charged":
      return { ...base, title: say.charged(energyIn(language, energy_wh ?? 0)), body: say.drive };
    case "failed":
    case "needs_person": {
      const body = detail === "" ? say.look : `${detail}. ${say.look}`;
      return { ...base, title: say[kind], body, stays: true };
    }
    case "ended":
      return { ...base, title: say.ended, body: say.news };
    default:
      return { ...base, title: "PlugPilot", body: say.news };
  }
}

function parse(text: string): Partial<Message> & Pick<Message, "language" | "detail"> {
  let found: Partial<Message> = {};
  try {
    found = (JSON.parse(text) as Partial<Message> | null) ?? {};
  } catch {
    // From a newer server, perhaps: there is news, and the page knows which.
  }
  const { language, detail } = found;
  const spoken = language !== undefined && Object.hasOwn(WORDS, language) ? language : "en";
  return { ...found, language: spoken, detail: typeof detail === "string" ? detail : "" };
}

function energyIn(language: Language, energy_wh: number): string {
  const digits = { minimumFractionDigits: 1, maximumFractionDigits: 1 };
  return `${new Intl.NumberFormat(language, digits).format(energy_wh / 1000)}\u00a0kWh`;
}
