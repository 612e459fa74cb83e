/** What a person does, step by step, when the robot cannot go on alone. */
import type { Step } from "@/guides/guides";

const steps: Record<Step, string> = {
  clear: "Make sure that nobody is near the plug or the arm and that nothing is in the way.",
  lookAtPlug: "Go to the car and look at the plug and the socket.",
  plugIsOut: "Is the plug completely out of the socket? Then say so below.",
  plugIsIn: "Is it still in, even a little? Then choose the other button. The robot pulls it straight out.",
  findReason: "Find out why the robot was stopped, and put that right.",
  twistButton: "Was the red button on the robot pressed? Turn it until it comes out.",
  parkHere: "Is the car at its place in front of the robot? If not, park it there.",
  parkStraight: "Park again: straight, and close to the middle of the place.",
  openFlap: "Open the flap of the car’s socket all the way.",
  wipeLabel: "Wipe the label beside the socket and the robot’s camera with a soft cloth.",
  switchLightOn: "Switch a light on if it is dark, or off if it dazzles the camera.",
  checkLabel: "See whether the label is whole, flat and still at its place beside the socket.",
  emptySocket: "Look into the socket and at the plug. There may be no cap, no dirt and no ice.",
  freeCable: "See whether the cable hangs freely and pulls at nothing.",
  unlockCar: "Unlock the car with its key or its app. Many cars hold the plug while they are locked.",
  endCharge: "End charging in the car or in its app, and wait a minute.",
  stationOff: "If the current still flows, switch the charging station off.",
  stationOn: "See whether the charging station is on and shows no fault.",
  stationNetwork: "See whether the charging station is connected to the network.",
  robotPower: "See whether the robot and its computer have power.",
  usbCable: "See whether the USB cable of the robot is in firmly at both ends.",
  comesBack: "Wait a moment. The robot comes back by itself, and this page shows it.",
  unblock: "Look for whatever blocks, brakes or pushes the arm, and take it away.",
  findsPosition: "Release the fault below. The robot then finds its position slowly by itself.",
  checkCamera: "See whether the camera’s cable is in and nothing covers the camera.",
  carStandsStill: "See whether the car still stands where it stood.",
  technician: "If it does not help or comes back, call whoever looks after the robot.",
};

export const guides = {
  steps,
  back: "Close",
  waits: "There is nothing to press. This closes when the robot is back.",
};
