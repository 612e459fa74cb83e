import { say } from "@/access/words";
import { LANGUAGE_NAMES, LANGUAGES, language } from "@/language/language";
import type { Language } from "@/language/language";
import { choose } from "@/language/start";

/** Which language the page speaks; each stands there in its own words. */
export function LanguagePicker() {
  return (
    <label class="language">
      <svg viewBox="0 0 24 24" aria-hidden="true">
        <circle cx="12" cy="12" r="9" />
        <path d="M3 12h18M12 3c5 5.500 5 12.500 0 18M12 3c-5 5.500-5 12.500 0 18" />
      </svg>
      <span class="unseen">{say.language}</span>
      <select
        value={language.value}
        onChange={(event) => {
          const { currentTarget } = event;
          void choose(currentTarget.value as Language).then((spoken) => {
            if (!spoken) currentTarget.value = language.value;
          });
        }}
      >
        {LANGUAGES.map((each) => (
          <option key={each} value={each} lang={each}>
            {LANGUAGE_NAMES[each]}
          </option>
        ))}
      </select>
    </label>
  );
}
