// Plays a recording. The 3D client's player has no other handles than its field for the time and
// its button; it is hidden, and works. The page around this frame has a player of its own; a
// window of its own gets one here.
if (new URLSearchParams(location.search).has("playbackPath")) {
  const PERIOD_MS = 100;
  const put = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set;
  const field = () => document.querySelector("input.mantine-NumberInput-input");
  const bar = () => field()?.closest(".mantine-Paper-root") ?? null;
  const button = () => bar()?.querySelector("button") ?? null;
  const isPlaying = () => button()?.querySelector("[class*=player-pause]") != null;
  const lengthS = () => Number(bar()?.querySelector("[role=slider]")?.ariaValueMax ?? 0);

  const jump = (at) => {
    const input = field();
    if (input === null) return;
    put.call(input, at.toFixed(2));
    input.dispatchEvent(new Event("input", { bubbles: true }));
  };
  const play = (playing) => {
    if (playing !== isPlaying()) button()?.click();
  };

  /** Calls back with what is shown, whenever that changes. */
  const follow = (show) => {
    let said = "";
    setInterval(() => {
      const at = parseFloat(field()?.value ?? "");
      if (!Number.isFinite(at)) return;
      bar().style.display = "none";
      const word = JSON.stringify({ at, playing: isPlaying() });
      if (word === said) return;
      said = word;
      show(JSON.parse(word));
    }, PERIOD_MS);
  };

  if (parent !== window) {
    follow((playback) => parent.postMessage({ playback }, location.origin));
    // {player: {at: seconds}} jumps, {player: {playing: true or false}} starts or pauses.
    addEventListener("message", (event) => {
      if (event.origin !== location.origin || event.source !== parent) return;
      const { at, playing } = event.data?.player ?? {};
      if (typeof at === "number") jump(at);
      if (typeof playing === "boolean") play(playing);
    });
  } else {
    const clock = (s) => `${Math.floor(s / 60)}:${String(Math.floor(s % 60)).padStart(2, "0")}`;
    addEventListener("DOMContentLoaded", () => {
      const player = document.createElement("div");
      player.id = "twin-player";
      player.hidden = true;
      player.innerHTML =
        '<button type="button"></button><input type="range" min="0" step="0.1" value="0" ' +
        'aria-label="Time"><output></output>';
      const [start, time, words] = player.children;
      start.addEventListener("click", () => play(!isPlaying()));
      time.addEventListener("input", () => jump(Number(time.value)));
      follow(({ at, playing }) => {
        player.hidden = false;
        time.max = lengthS();
        time.value = at;
        time.style.setProperty("--done", `${(100 * at) / (lengthS() || 1)}%`);
        start.textContent = playing ? "Pause" : "Play";
        words.textContent = `${clock(at)} / ${clock(lengthS())}`;
      });
      document.querySelector("#twin-controls").append(player);
    });
  }
}
