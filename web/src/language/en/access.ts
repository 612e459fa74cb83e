/** Who may do what: the way in, people, devices and keys. */
import type { components } from "@/api/schema";
import { pluralIn } from "../language";

type Role = components["schemas"]["Role"];
type KeyScope = components["schemas"]["Scope"];

const roles: Record<Role, { name: string; may: string }> = {
  viewer: { name: "Viewer", may: "sees everything and may stop the robot" },
  resident: { name: "Family", may: "charges and unplugs the car" },
  technician: { name: "Technician", may: "charges, jogs, calibrates and changes cars" },
  owner: { name: "Owner", may: "does everything, and decides who may do what" },
};

const scopes: Record<KeyScope, string> = {
  read: "Read state, pictures and recordings",
  operate: "Start and end jobs, stop",
  "charge-point": "Steer charging, for energy managers",
  service: "Jog, calibrate, change cars",
  admin: "Decide who may do what",
};

const plural = pluralIn("en");

export const access = {
  roles,
  scopes,
  door: {
    opening: "Opening the robot’s page …",
    title: "This device is not paired yet",
    how: "Only people whom the robot knows can see and use it. You need an invitation, once:",
    ways: [
      "The owner shows you a QR code: scan it with this phone’s camera.",
      "Somebody sent you an address: open it on this device.",
      "Nobody owns the robot yet: open the address that its terminal shows. “plugpilot pair” shows a new one.",
    ],
    paste: "Invitation address",
    use: "Pair this device",
    passkey: "Use my passkey",
    failedTitle: "That did not work",
    again: "Try again",
    replaceTitle: (name: string): string => `This device is already paired as ${name}`,
    replace: "An invitation can be used once, and this device then belongs to the person who is invited.",
    replaceYes: "Use the invitation here",
    replaceNo: "Leave everything as it is",
    screenTitle: "Scan to own this robot",
    screenHow: "The first phone that scans this becomes the owner’s. The owner then invites everybody else.",
    unreachable: "Other devices cannot reach this address. Start PlugPilot with --host 0.0.0.0.",
    kioskTitle: "This screen stops the robot",
    kioskHow: "Anybody may stop it here. To charge from here, too, whoever owns the robot pairs this screen once.",
    stop: "Stop the robot",
    stopped: "The robot has stopped.",
  },
  menu: "People and devices",
  tabs: { people: "People", keys: "Keys", trail: "Activity", own: "Me" },
  none: "Nothing here yet.",
  loading: "Loading …",
  people: {
    invite: "Invite somebody",
    name: "Name",
    role: "What they may do",
    until: "Until",
    forever: "no end",
    day: "for a day",
    week: "for a week",
    month: "for a month",
    make: "Make the invitation",
    show: (name: string): string => `For ${name}`,
    scan: "Scan with the phone that is to be paired, or send the address. It works once.",
    copy: "Copy the address",
    copied: "Copied",
    done: "Done",
    lastUsed: "last used",
    now: "just now",
    ends: "until",
    remove: "Remove",
    removePerson: (name: string): string => `Remove ${name}`,
    sure: "Really remove?",
    open: "Open invitations",
    withdraw: "Withdraw",
    thisDevice: "this device",
    noDevice: "no device yet",
    passkeys: (count: number): string =>
      plural(count, { one: "# passkey", other: "# passkeys" }),
  },
  keys: {
    hint: "For programs: Home Assistant, energy managers, scripts. A key is shown once.",
    make: "Make a key",
    name: "What is it for?",
    once: "Copy the key now. It is not kept, so it cannot be shown again.",
    never: "never used",
    revoke: "Revoke",
  },
  trail: {
    security: "Only access",
    everything: "Everything",
    more: "Show older",
    download: "Download all",
    times: (count: number): string => plural(count, { one: "once", other: "# times" }),
  },
  push: {
    begin: "Notify me on this device",
    stop: "Do not notify me any more",
    off: "This device can tell you when the car is charged, when something did not work, and when the robot needs you.",
    on: "This device tells you when the car is charged, when something did not work, and when the robot needs you.",
    blocked: "This browser blocks notifications of this page. Its settings allow them again.",
    impossible: "Notifications need https and a browser that can. Without, this page shows what happens as long as it is open.",
  },
  own: {
    you: (name: string, role: string): string => `You are ${name} (${role.toLowerCase()}).`,
    another: "Pair another device of mine",
    passkey: "Add a passkey",
    passkeyHint: "With a passkey you get back in on any of your devices, without an invitation.",
    passkeyNeeds: "Passkeys need https and a name, not a number: see “plugpilot serve --tls”.",
    signOut: "Sign this device out",
  },
  language: "Language",
  watching: "You can watch, and stop the robot at any time.",
};
