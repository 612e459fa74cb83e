interface VerdictProps {
  readonly tone: "good" | "ask" | "problem" | "calm";
  /** One or two words, and what to do. */
  readonly words: readonly [verdict: string, advice: string];
}

/** What the figures mean, for people; its place is kept, whatever it says. */
export function Verdict({ tone, words: [verdict, advice] }: VerdictProps) {
  return (
    <p class="panel-verdict" data-tone={tone} role="status">
      <strong>{verdict}.</strong> {advice}
    </p>
  );
}
