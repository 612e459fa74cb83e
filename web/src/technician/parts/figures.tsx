interface FiguresProps {
  readonly title: string;
  /** What is measured, and its value with the unit. */
  readonly lines: readonly (readonly [name: string, value: string])[];
}

/** Figures below each other, under a title; put several into a `.panel-figures`. */
export function Figures({ title, lines }: FiguresProps) {
  return (
    <div>
      <h3>{title}</h3>
      <dl class="list">
        {lines.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}
