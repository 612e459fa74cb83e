// Lets the page around this frame show a recording with a player of its own. The 3D client's
// player has no other handles than its field for the time and its button; it is hidden, and works.
if (new URLSearchParams(location.search).has("playbackPath") && parent !== window) {
  const put = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set;
  const field = () => document.querySelector("input.mantine-NumberInput-input");
  const bar = () => field()?.closest(".mantine-Paper-root") ?? null;
  const button = () => bar()?.querySelector("button") ?? null;
  const isPlaying = () => button()?.querySelector("[class*=player-pause]") != null;

  let said = "";
  setInterval(() => {
    const at = parseFloat(field()?.value ?? "");
    if (!Number.isFinite(at)) return;
    bar().style.display = "none";
    const word = JSON.stringify({ at, playing: isPlaying() });
    if (word === said) return;
    said = word;
    parent.postMessage({ playback: JSON.parse(word) }, location.origin);
  }, 100);

  // {player: {at: seconds}} jumps, {player: {playing: true or false}} starts or pauses.
  addEventListener("message", (event) => {
    if (event.origin !== location.origin || event.source !== parent) return;
    const { at, playing } = event.data?.player ?? {};
    const input = field();
    if (input === null) return;
    if (typeof at === "number") {
      put.call(input, at.toFixed(2));
      input.dispatchEvent(new Event("input", { bubbles: true }));
    }
    if (typeof playing === "boolean" && playing !== isPlaying()) button()?.click();
  });
}
