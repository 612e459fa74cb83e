/** A drawing for each step. The sentence beside it says the same: screen readers skip it. */
import type { ComponentChildren } from "preact";
import type { Step } from "./guides";
import {
  Arrow,
  At,
  Bolt,
  Car,
  Clock,
  Cross,
  Eye,
  Label,
  Lamp,
  Padlock,
  Person,
  Phone,
  Robot,
  Socket,
  Station,
  Tick,
  Turn,
  UsbPlug,
  Waves,
} from "./parts";

const CAR = (
  <At x={78} y={12}>
    <Car />
  </At>
);

/** Wall, robot and car, with the arm so far out, and a sign between them. */
function Garage({ reach, children }: { reach: number; children?: ComponentChildren }) {
  return (
    <>
      <Robot reach={reach} />
      {CAR}
      {children}
    </>
  );
}

const DRAWINGS: Readonly<Record<Step, () => ComponentChildren>> = {
  clear: () => (
    <>
      <Robot />
      <At x={66} y={50} size={0.9}>
        <Person />
      </At>
      <At x={86} y={44}>
        <Arrow to={[26, 0]} />
      </At>
    </>
  ),
  lookAtPlug: () => (
    <Garage reach={26}>
      <At x={64} y={18}>
        <Eye />
      </At>
    </Garage>
  ),
  plugIsOut: () => (
    <Garage reach={14}>
      <At x={62} y={22}>
        <Tick />
      </At>
    </Garage>
  ),
  plugIsIn: () => (
    <Garage reach={40}>
      <At x={74} y={22}>
        <Arrow to={[-30, 0]} />
      </At>
    </Garage>
  ),
  findReason: () => (
    <>
      <Robot reach={18} />
      <At x={92} y={46} size={1.6}>
        <Eye />
      </At>
    </>
  ),
  twistButton: () => (
    <At x={60} y={48}>
      <path class="paper" d="M-26 34h52V16h-52z" />
      <path class="bad-fill" d="M-22 12c0-14 8-20 22-20s22 6 22 20z" />
      <At x={0} y={-14}>
        <Turn />
      </At>
    </At>
  ),
  parkHere: () => (
    <>
      <Robot />
      <path class="dashed" d="M62 84h58" />
      <At x={78} y={14}>
        <Car />
      </At>
    </>
  ),
  parkStraight: () => (
    <>
      <path class="fill" d="M0 0h120v12H0z" />
      <rect class="ink" x="52" y="12" width="16" height="8" rx="3" />
      <path class="dashed" d="M34 26v60M86 26v60" />
      <path class="paper" d="M46 84V46c0-10 4-14 14-14s14 4 14 14v38z" />
      <path d="M50 58h20" />
      <At x={60} y={82}>
        <Arrow to={[0, -16]} />
      </At>
    </>
  ),
  openFlap: () => (
    <>
      <path class="fill" d="M-5-5h130v100H-5z" />
      <At x={46} y={46} size={1.4}>
        <Socket />
      </At>
      <path class="paper" d="M76 22l22-8v60l-22-6z" />
      <At x={62} y={80}>
        <Arrow to={[34, 0]} />
      </At>
    </>
  ),
  wipeLabel: () => (
    <>
      <At x={42} y={46} size={1.7}>
        <Label />
      </At>
      <path class="paper" d="M66 36c10-8 26-8 34 2s4 22-6 26-26 2-30-8 0-18 2-20z" />
      <path class="accent" d="M60 18q10-8 20 0t20 0" />
    </>
  ),
  switchLightOn: () => (
    <>
      <At x={60} y={38}>
        <Lamp />
      </At>
      <At x={60} y={74} size={0.8}>
        <Label />
      </At>
    </>
  ),
  checkLabel: () => (
    <>
      <path class="fill" d="M-5-5h130v100H-5z" />
      <At x={38} y={46} size={1.2}>
        <Socket />
      </At>
      <At x={86} y={46} size={1.2}>
        <Label />
      </At>
      <At x={106} y={24}>
        <Tick />
      </At>
    </>
  ),
  emptySocket: () => (
    <>
      <path class="fill" d="M-5-5h130v100H-5z" />
      <At x={46} y={46} size={1.5}>
        <Socket />
      </At>
      <At x={98} y={46} size={1.1}>
        <Eye />
      </At>
    </>
  ),
  freeCable: () => (
    <>
      <Robot reach={30} />
      <path class="accent" d="M54 58c-6 34-34 32-46 8" />
      <At x={94} y={46}>
        <Tick />
      </At>
    </>
  ),
  unlockCar: () => (
    <>
      {CAR}
      <At x={36} y={44} size={1.5}>
        <Padlock />
      </At>
    </>
  ),
  endCharge: () => (
    <>
      {CAR}
      <At x={38} y={46}>
        <Bolt />
      </At>
      <At x={38} y={46} size={2}>
        <Cross />
      </At>
    </>
  ),
  stationOff: () => (
    <>
      <At x={46} y={44}>
        <Station lamp={false} />
      </At>
      <At x={96} y={42} size={1.2}>
        <path class="bad" d="M-7-9a11 11 0 1 0 14 0M0-15v12" />
      </At>
    </>
  ),
  stationOn: () => (
    <>
      <At x={46} y={44}>
        <Station lamp={true} />
      </At>
      <At x={96} y={42}>
        <Tick />
      </At>
    </>
  ),
  stationNetwork: () => (
    <>
      <At x={40} y={44}>
        <Station lamp={true} />
      </At>
      <At x={94} y={48}>
        <Waves />
      </At>
    </>
  ),
  robotPower: () => (
    <>
      <Robot />
      <path d="M24 60c16 20 24 18 34 6" />
      <rect class="paper" x="60" y="36" width="34" height="34" rx="7" />
      <circle class="ink" cx="71" cy="53" r="2.500" />
      <circle class="ink" cx="83" cy="53" r="2.500" />
      <At x={108} y={32} size={0.9}>
        <Bolt />
      </At>
    </>
  ),
  usbCable: () => (
    <>
      <At x={46} y={46} size={1.3}>
        <UsbPlug />
      </At>
      <path class="fill" d="M92 18h28v56H92z" />
      <path class="paper" d="M92 38h12v16H92z" />
      <At x={56} y={74}>
        <Arrow to={[28, 0]} />
      </At>
    </>
  ),
  comesBack: () => (
    <>
      <Robot />
      <At x={78} y={46} size={1.4}>
        <Clock />
      </At>
    </>
  ),
  unblock: () => (
    <>
      <Robot reach={18} />
      <path class="paper" d="M66 70l4-22 14-8 16 6 6 24z" />
      <At x={86} y={32}>
        <Arrow to={[20, -20]} />
      </At>
    </>
  ),
  findsPosition: () => (
    <>
      <Robot reach={12} />
      <At x={60} y={24}>
        <Arrow to={[-24, 0]} />
      </At>
      <At x={92} y={48}>
        <Clock />
      </At>
    </>
  ),
  checkCamera: () => (
    <>
      <rect class="paper" x="26" y="26" width="44" height="36" rx="8" />
      <circle class="paper" cx="48" cy="44" r="12" />
      <circle class="ink" cx="48" cy="44" r="5" />
      <path class="accent" d="M26 50C8 52 12 78 0 80" />
      <At x={96} y={44}>
        <Eye />
      </At>
    </>
  ),
  carStandsStill: () => (
    <>
      <path class="dashed" d="M18 84h100" />
      <At x={34} y={14}>
        <Car />
      </At>
      <At x={52} y={16} size={0.9}>
        <Eye />
      </At>
    </>
  ),
  technician: () => (
    <>
      <At x={40} y={46} size={1.3}>
        <Phone />
      </At>
      <At x={90} y={54} size={1.1}>
        <Person />
      </At>
    </>
  ),
};

export function Drawing({ step }: { step: Step }) {
  return (
    <svg class="drawing" viewBox="0 0 120 90" aria-hidden="true">
      {DRAWINGS[step]()}
    </svg>
  );
}
