import { useComputed } from "@preact/signals";
import { store } from "@/live/page";
import { words } from "@/words";

/** Says in words where the robot and the model beside it have parted. */
export function TwinAlarm() {
  const found = useComputed(() => store.live.value?.twin?.divergences ?? []).value;
  return (
    <div role="status" class="twin-alarm" data-on={found.length > 0}>
      {found.length > 0 && (
        <section class="card">
          <h2>{words.twin.title}</h2>
          <p>{words.twin.remedy}</p>
          <ul>
            {found.map((each) => (
              <li key={each.quantity}>
                <strong>{each.title}.</strong> {each.message}
              </li>
            ))}
          </ul>
        </section>
      )}
    </div>
  );
}
