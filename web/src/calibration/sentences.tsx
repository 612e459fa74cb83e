interface Props {
  readonly title: string;
  readonly sentences: readonly string[];
}

/** Sentences that say what to mend. */
export function Sentences({ title, sentences }: Props) {
  if (sentences.length === 0) return null;
  return (
    <div class="calibration-remarks">
      <h4>{title}</h4>
      <ul>
        {sentences.map((each) => (
          <li key={each}>{each}</li>
        ))}
      </ul>
    </div>
  );
}
