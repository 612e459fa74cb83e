import { useSignal } from "@preact/signals";
import { may } from "@/access/session";
import { formatNumber } from "@/format";
import { questionOf } from "./asked";
import { answer, busy } from "./desk";
import { numberIn } from "./request";
import type { Question } from "./types";
import { say } from "./words";

/** What the routine waits for: something done, or a number that was read. Nothing moves until then. */
export function QuestionForm({ asks }: { asks: Question }) {
  const text = useSignal("");
  const { code, input } = asks;
  const value = input === null ? null : numberIn(text.value);
  const wrong = input !== null && (value === null || value < input.least || value > input.most);
  return (
    <form
      class="calibration-question"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        if (!wrong) void answer(code, value);
      }}
    >
      <p role="status">
        <strong>{questionOf(asks)}</strong>
      </p>
      {input !== null && (
        <label class="field">
          <span>{say.asking.number(input.unit)}</span>
          <input
            type="text"
            inputMode="decimal"
            autoComplete="off"
            value={text.value}
            aria-describedby="calibration-limits"
            aria-invalid={wrong && text.value !== ""}
            onInput={(event) => {
              text.value = event.currentTarget.value;
            }}
          />
          <small id="calibration-limits" class={wrong && text.value !== "" ? "calibration-wrong" : "soft"}>
            {say.asking.limits(short(input.least), short(input.most), input.unit)}
          </small>
        </label>
      )}
      <button type="submit" class="button primary" disabled={busy.value || wrong || !may("service")}>
        {input === null ? say.asking.confirm : say.asking.enter}
      </button>
      <p class="soft small">{say.asking.still}</p>
    </form>
  );
}

const short = (value: number): string => formatNumber(value, Number.isInteger(value) ? 0 : 1);
