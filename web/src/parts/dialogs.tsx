import { answerYes, chargeVehicle, choice, question } from "@/robot/actions";
import { words } from "@/words";
import { Modal } from "./modal";

/** What a person must have looked at before the robot may move again. */
export function QuestionDialog() {
  const asked = question.value;
  if (asked === null) return null;
  const { title, points, note, yes } = asked === "reset" ? words.confirmReset : words.confirmPlug;
  const close = (): void => {
    question.value = null;
  };
  return (
    <Modal key={asked} title={title} onClose={close}>
      <ul class="points">
        {points.map((point) => (
          <li key={point}>{point}</li>
        ))}
      </ul>
      <p class="soft">{note}</p>
      <button type="button" class="button big primary" onClick={answerYes}>
        {yes}
      </button>
      <button type="button" class="button big" onClick={close}>
        {words.action.back}
      </button>
    </Modal>
  );
}

/** Which car to charge, when there are several. */
export function ChoiceDialog() {
  const vehicles = choice.value;
  if (vehicles === null) return null;
  const close = (): void => {
    choice.value = null;
  };
  return (
    <Modal title={words.chooseCar.title} onClose={close}>
      {vehicles.map((vehicle) => (
        <button
          key={vehicle.id}
          type="button"
          class="button big"
          onClick={() => chargeVehicle(vehicle)}
        >
          {vehicle.name}
        </button>
      ))}
      <button type="button" class="button text" onClick={close}>
        {words.action.back}
      </button>
    </Modal>
  );
}
