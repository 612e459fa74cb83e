import type { components } from "@/api/schema";
import { pluralIn } from "../language";
import type { AccessWords } from "../types";

type Role = components["schemas"]["Role"];
type KeyScope = components["schemas"]["Scope"];

const roles: Record<Role, { name: string; may: string }> = {
  viewer: { name: "Spectateur", may: "voit tout et peut arrêter le robot" },
  resident: { name: "Famille", may: "charge et débranche la voiture" },
  technician: {
    name: "Technicien",
    may: "charge, déplace à la main, étalonne et modifie les voitures",
  },
  owner: { name: "Propriétaire", may: "fait tout et décide qui peut faire quoi" },
};

const scopes: Record<KeyScope, string> = {
  read: "Lire l’état, les images et les enregistrements",
  operate: "Lancer et terminer des tâches, arrêter",
  "charge-point": "Piloter la charge, pour les gestionnaires d’énergie",
  service: "Déplacer à la main, étalonner, modifier les voitures",
  admin: "Décider qui peut faire quoi",
};

const plural = pluralIn("fr");

export const access: AccessWords = {
  roles,
  scopes,
  door: {
    opening: "Ouverture de la page du robot…",
    title: "Cet appareil n’est pas encore associé",
    how: "Seules les personnes que le robot connaît peuvent le voir et l’utiliser. Il vous faut une invitation, une seule fois\u00a0:",
    ways: [
      "Le propriétaire vous montre un code QR\u00a0: scannez-le avec l’appareil photo de ce téléphone.",
      "Quelqu’un vous a envoyé une adresse\u00a0: ouvrez-la sur cet appareil.",
      "Le robot n’appartient encore à personne\u00a0: ouvrez l’adresse affichée dans son terminal. «\u00a0plugpilot pair\u00a0» en affiche une nouvelle.",
    ],
    paste: "Adresse de l’invitation",
    use: "Associer cet appareil",
    passkey: "Utiliser ma clé d’accès",
    failedTitle: "Cela n’a pas marché",
    again: "Réessayer",
    replaceTitle: (name) => `Cet appareil est déjà associé à ${name}`,
    replace:
      "Une invitation ne sert qu’une fois, et cet appareil appartiendra ensuite à la personne invitée.",
    replaceYes: "Utiliser l’invitation ici",
    replaceNo: "Ne rien changer",
    screenTitle: "Scannez pour devenir propriétaire",
    screenHow:
      "Le premier téléphone qui scanne ce code devient celui du propriétaire. C’est lui qui invite ensuite les autres.",
    unreachable:
      "Les autres appareils n’atteignent pas cette adresse. Lancez PlugPilot avec --host 0.0.0.0.",
    kioskTitle: "Cet écran arrête le robot",
    kioskHow: "Tout le monde peut l’arrêter ici. Pour charger d’ici aussi, le propriétaire du robot associe une fois cet écran.",
    stop: "Arrêter le robot",
    stopped: "Le robot s’est arrêté.",
  },
  menu: "Personnes et appareils",
  tabs: { people: "Personnes", keys: "Clés", trail: "Activité", own: "Moi" },
  none: "Rien pour l’instant.",
  loading: "Chargement…",
  people: {
    invite: "Inviter quelqu’un",
    name: "Nom",
    role: "Ce que la personne peut faire",
    until: "Jusqu’à",
    forever: "sans limite",
    day: "pour un jour",
    week: "pour une semaine",
    month: "pour un mois",
    make: "Créer l’invitation",
    show: (name) => `Pour ${name}`,
    scan: "Scannez avec le téléphone à associer, ou envoyez l’adresse. Elle ne sert qu’une fois.",
    copy: "Copier l’adresse",
    copied: "Copiée",
    done: "Terminé",
    lastUsed: "dernière utilisation",
    now: "à l’instant",
    ends: "jusqu’au",
    remove: "Supprimer",
    removePerson: (name) => `Supprimer ${name}`,
    sure: "Vraiment supprimer\u00a0?",
    open: "Invitations ouvertes",
    withdraw: "Retirer",
    thisDevice: "cet appareil",
    noDevice: "aucun appareil pour l’instant",
    passkeys: (count) => plural(count, { one: "# clé d’accès", other: "# clés d’accès" }),
  },
  keys: {
    hint: "Pour les programmes\u00a0: Home Assistant, gestionnaires d’énergie, scripts. Une clé n’est montrée qu’une fois.",
    make: "Créer une clé",
    name: "À quoi sert-elle\u00a0?",
    once: "Copiez la clé maintenant. Elle n’est pas conservée et ne pourra plus être affichée.",
    never: "jamais utilisée",
    revoke: "Révoquer",
  },
  trail: {
    security: "Accès seulement",
    everything: "Tout",
    more: "Afficher plus ancien",
    download: "Tout télécharger",
    times: (count) => plural(count, { one: "# fois", other: "# fois" }),
  },
  push: {
    begin: "Me notifier sur cet appareil",
    stop: "Ne plus me notifier",
    off: "Cet appareil peut vous prévenir quand la voiture est chargée, quand quelque chose n’a pas marché et quand le robot a besoin de vous.",
    on: "Cet appareil vous prévient quand la voiture est chargée, quand quelque chose n’a pas marché et quand le robot a besoin de vous.",
    blocked: "Ce navigateur bloque les notifications de cette page. Ses réglages permettent de les autoriser.",
    impossible: "Les notifications demandent https et un navigateur qui les connaît. Sinon, cette page montre ce qui se passe tant qu’elle est ouverte.",
  },
  own: {
    you: (name, role) => `Vous êtes ${name} (${role.toLowerCase()}).`,
    another: "Associer un autre de mes appareils",
    passkey: "Ajouter une clé d’accès",
    passkeyHint:
      "Avec une clé d’accès, vous revenez sur n’importe lequel de vos appareils, sans invitation.",
    passkeyNeeds:
      "Les clés d’accès demandent https et un nom au lieu d’un numéro\u00a0: voir «\u00a0plugpilot serve --tls\u00a0».",
    signOut: "Déconnecter cet appareil",
  },
  language: "Langue",
  watching: "Vous pouvez regarder, et arrêter le robot à tout moment.",
};
