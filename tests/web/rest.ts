/** The REST API, played by the test. */
import { vi } from "vitest";

export interface Request {
  readonly what: string;
  readonly body: unknown;
  readonly headers: Record<string, string>;
}

type Answer = Response | Error;

const json = (status: number, body: unknown): Response =>
  new Response(JSON.stringify(body), { status });

/** Answers by "METHOD /path"; anything else is a 404 page without a problem document. */
export class FakeRest {
  readonly requests: Request[] = [];
  private readonly answers = new Map<string, Answer[]>();

  constructor() {
    vi.stubGlobal("fetch", (url: string, init: RequestInit) => this.fetch(url, init));
  }

  /** The answer from now on, or several in turn, of which the last one stays. */
  answer(what: string, ...answers: (readonly [number, unknown] | Error)[]): this {
    this.answers.set(
      what,
      answers.map((each) => (each instanceof Error ? each : json(...each))),
    );
    return this;
  }

  /** The requests other than reading, in order. */
  get commands(): string[] {
    return this.requests.map(({ what }) => what).filter((what) => !what.startsWith("GET"));
  }

  private fetch(url: string, init: RequestInit): Promise<Response> {
    const what = `${init.method ?? "GET"} ${url.replace(/^\/api\/v1/, "")}`;
    this.requests.push({
      what,
      body: typeof init.body === "string" ? JSON.parse(init.body) : undefined,
      headers: init.headers as Record<string, string>,
    });
    const known = this.answers.get(what);
    const next = known !== undefined && known.length > 1 ? known.shift() : known?.[0];
    if (next instanceof Error) return Promise.reject(next);
    return Promise.resolve(next?.clone() ?? new Response("<h1>Not found</h1>", { status: 404 }));
  }
}
